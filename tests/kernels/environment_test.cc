// Light from all around on every instruction set, against plain loops in double.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <random>

#include "image/environment_chart.h"
#include "image/environment_map.h"
#include "reference/shapes.h"
#include "shade/split_sum.h"

namespace laterna {
namespace {

using namespace reference;

std::vector<glm::vec3> random_texels(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0, 2);
  std::vector<glm::vec3> texels(static_cast<std::size_t>(count));
  for (glm::vec3& texel : texels) texel = {uniform(random), uniform(random), uniform(random)};
  return texels;
}

// Bilinear in a level, between the texels that a picture of that chart has there.
glm::dvec3 look_up(const image::OctahedralLevels& map, std::size_t level, const glm::dvec3& direction) {
  const int side = map.levels[level].side;
  std::vector<glm::vec3> texels;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const std::size_t at = map.index(level, x, y);
      texels.emplace_back(map.r[at], map.g[at], map.b[at]);
    }
  }
  return image::EnvironmentPicture(EnvironmentChart::octahedral, side, side, texels).look_up(direction);
}

TEST(Prefilter, IsTheSameOnEveryInstructionSetAndTheWeightedMean) {
  constexpr int kSide = 32, kOut = 9;  // no multiple of any number of lanes
  const image::OctahedralLevels source =
      image::make_octahedral_pyramid(kSide, random_texels(kSide * kSide, 1));
  const std::vector<image::LobeSample> lobe = image::sample_lobe(0.5, 24, kSide);
  image::OctahedralLevels scalar;
  scalar.add_level(kOut);
  for (int y = 0; y < kOut; ++y) image::prefilter_row_for(InstructionSet::scalar)(source, lobe, 0, y, scalar);
  for (const InstructionSet set : supported_instruction_sets()) {
    image::OctahedralLevels out;
    out.add_level(kOut);
    for (int y = 0; y < kOut; ++y) image::prefilter_row_for(set)(source, lobe, 0, y, out);
    EXPECT_EQ(std::memcmp(out.r.data(), scalar.r.data(), out.r.size() * sizeof(float)), 0) << name_of(set);
    EXPECT_EQ(std::memcmp(out.b.data(), scalar.b.data(), out.b.size() * sizeof(float)), 0) << name_of(set);
  }
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(4, 4), std::pair(8, 3), std::pair(2, 7)}) {
    const glm::dvec3 n =
        *direction_from_image(EnvironmentChart::octahedral, {(x + 0.5) / kOut, (y + 0.5) / kOut});
    const double sign = n.z < 0 ? -1 : 1, a = -1 / (sign + n.z), b = n.x * n.y * a;
    const glm::dvec3 t(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), s(b, sign + n.y * n.y * a, -n.y);
    glm::dvec3 sum(0);
    for (const image::LobeSample& one : lobe) {
      const glm::dvec3 d = t * double{one.x} + s * double{one.y} + n * double{one.z};
      const glm::dvec3 fine = look_up(source, one.level, d);
      const glm::dvec3 coarse = one.blend > 0 ? look_up(source, one.level + 1, d) : fine;
      sum += (fine + (coarse - fine) * double{one.blend}) * double{one.weight};
    }
    EXPECT_NEAR(scalar.r[scalar.index(0, x, y)], sum.x, 1e-4);
    EXPECT_NEAR(scalar.g[scalar.index(0, x, y)], sum.y, 1e-4);
  }
}

Scene lit_scene(float metallic, float roughness) {
  Scene scene;
  add_object(scene, "ball", sphere({0, 0, 0}, 1, 48), {0.9F, 0.5F, 0.2F});
  add_object(scene, "ring", torus({0, -0.4F, 0}, 1.6F, 0.2F, 24));
  for (Material& material : scene.materials) {
    material.metallic = metallic;
    material.roughness = roughness;
  }
  auto sky = std::make_shared<Image>(16, 8, 3, PixelType::f32, Transfer::linear);
  const auto values = sky->values<float>();
  const std::vector<glm::vec3> texels = random_texels(16 * 8, 5);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) values[3 * i + k] = texels[i][static_cast<int>(k)];
  }
  scene.pictures.push_back({});
  scene.pictures[0].pixels = sky;
  scene.environment.emplace();
  scene.environment->picture = 0;
  scene.environment->intensity = 1.5;
  scene.environment->world_from_environment = {{0.6, 0, -0.8}, {0, 1, 0}, {0.8, 0, 0.6}};
  return scene;
}

const View kView = look({0.5, 1.5, 4}, {0, 0, 0}, 45, 1);

TEST(EnvironmentLight, IsTheSameOnEveryInstructionSetAndNumberOfThreads) {
  for (const EnvironmentDistance distance :
       {EnvironmentDistance::infinite, EnvironmentDistance::box, EnvironmentDistance::sphere}) {
    for (const ShadingModel model : {ShadingModel::papers, ShadingModel::phong, ShadingModel::pbr}) {
      Scene scene = lit_scene(0.6F, 0.37F);
      scene.environment->distance = distance;
      scene.environment->box_low_ws = glm::dvec3(-3);
      scene.environment->box_high_ws = glm::dvec3(3);
      scene.environment->radius = 3;
      RenderSettings settings = test_settings(70, 70);
      settings.shading = model;
      settings.samples = 2;
      const LayeredImage scalar =
          reference::render(make_renderer(scene, 1, InstructionSet::scalar), kView, settings);
      for (const InstructionSet set : supported_instruction_sets()) {
        const LayeredImage image = reference::render(make_renderer(scene, 3, set), kView, settings);
        for (const char* name : {"R", "G", "B", "A"})
          EXPECT_EQ(image.find(name)->values, scalar.find(name)->values) << name_of(set) << " " << name;
      }
    }
  }
}

// The split sum with light reflected several times, written out.
TEST(EnvironmentLight, IsTheSplitSum) {
  constexpr double kMetallic = 0.6, kRoughness = 0.37;
  const Scene scene = lit_scene(0.6F, 0.37F);
  RenderSettings settings = test_settings(64, 64);
  settings.shading = ShadingModel::pbr;
  settings.layers = {Layer::position, Layer::normal, Layer::object};
  const LayeredImage picture = reference::render(make_renderer(scene), kView, settings);
  const Image& sky = *scene.pictures[0].pixels;
  std::vector<glm::vec3> texels;
  for (std::size_t i = 0; i < sky.values<float>().size(); i += 3)
    texels.emplace_back(sky.values<float>()[i], sky.values<float>()[i + 1], sky.values<float>()[i + 2]);
  const TaskPool pool(1);
  const image::EnvironmentMap map = image::make_environment_map({EnvironmentChart::latlong, 16, 8, texels},
                                                                pool, best_instruction_set(), {});
  const glm::dmat3 environment_from_world = glm::transpose(scene.environment->world_from_environment);
  const glm::dvec3 base(0.9F, 0.5F, 0.2F);
  int count = 0;
  for (int y = 0; y < 64; y += 3) {
    for (int x = 0; x < 64; x += 3) {
      if (at(picture, "id.object", x, y) != 0) continue;
      const auto vector = [&](const std::string& name) {
        return glm::dvec3(at(picture, name + ".X", x, y), at(picture, name + ".Y", x, y),
                          at(picture, name + ".Z", x, y));
      };
      const glm::dvec3 n = glm::normalize(vector("N")),
                       v = glm::normalize(kView.pose.position_ws - vector("P"));
      const double n_v = glm::dot(n, v);
      if (n_v < 0.15) continue;  // where the table bends
      const glm::dvec3 along = environment_from_world * (n * (2 * n_v) - v);
      const double level = kRoughness * 12;
      const glm::dvec3 sharp = look_up(map.mirrored, 4, along), rough = look_up(map.mirrored, 5, along);
      const glm::dvec3 mirrored = (sharp + (rough - sharp) * (level - 4)) * 1.5;
      glm::dvec3 matt(0);
      const auto basis = image::spherical_harmonics(environment_from_world * n);
      for (std::size_t i = 0; i < 9; ++i) matt += map.irradiance[i] * basis[i] * 1.5 / 3.14159265358979;
      const shade::ScaleAndBias entry = shade::integrate_reflectance(n_v, kRoughness, 4096);
      const double missing = 1 - entry.scale - entry.bias;
      for (int k = 0; k < 3; ++k) {
        const double f0 = 0.04 + (base[k] - 0.04) * kMetallic, once = f0 * entry.scale + entry.bias;
        const double mean = f0 + (1 - f0) / 21, again = missing * once * mean / (1 - mean * missing);
        const double expected =
            once * mirrored[k] + (again + base[k] * (1 - kMetallic) * (1 - once - again)) * matt[k];
        EXPECT_NEAR(at(picture, std::string(1, "RGB"[k]), x, y), expected, 6e-3 * (1 + expected));
      }
      ++count;
    }
  }
  EXPECT_GT(count, 30);
}

}  // namespace
}  // namespace laterna
