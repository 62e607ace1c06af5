// MIT lecture 20, light maps: rows 71 and 72.
#include "laterna/bake.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "laterna/probes.h"
#include "laterna/quake_surfaces.h"
#include "reference/projector_scenes.h"

namespace laterna {
namespace {

using namespace reference;

struct Luxel {
  glm::vec3 irradiance;
  glm::dvec3 position_ws, normal_ws;
};

/// The luxels whose middles lie on surfaces, found again from the baked meshes alone. Nodes have no transforms.
std::vector<Luxel> luxels_of(const Scene& scene) {
  std::vector<Luxel> luxels;
  for (const Node& node : scene.nodes) {
    if (node.mesh < 0) continue;
    for (const Primitive& p : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      const Material& material = scene.materials[static_cast<std::size_t>(p.material)];
      if (!material.light_map.front.is_set()) continue;
      const Image& map = *scene.pictures[static_cast<std::size_t>(material.light_map.front.picture)].pixels;
      for (std::size_t t = 0; t + 2 < p.indices.size(); t += 3) {
        glm::dvec3 at[3];
        glm::dvec2 uv[3];
        for (std::size_t k = 0; k < 3; ++k) {
          at[k] = p.positions[p.indices[t + k]];
          uv[k] = glm::dvec2(p.uv[1][p.indices[t + k]]) * glm::dvec2(map.width(), map.height());
        }
        const glm::dvec2 u = uv[1] - uv[0], v = uv[2] - uv[0];
        const double area = u.x * v.y - u.y * v.x;
        const glm::dvec2 low = glm::min(uv[0], glm::min(uv[1], uv[2])),
                         high = glm::max(uv[0], glm::max(uv[1], uv[2]));
        for (int y = static_cast<int>(low.y); y <= static_cast<int>(high.y) && y < map.height(); ++y) {
          for (int x = static_cast<int>(low.x); x <= static_cast<int>(high.x) && x < map.width(); ++x) {
            const glm::dvec2 d = glm::dvec2(x + 0.5, y + 0.5) - uv[0];
            const double b = (d.x * v.y - d.y * v.x) / area, c = (u.x * d.y - u.y * d.x) / area;
            if (!(b >= 0 && c >= 0 && b + c <= 1)) continue;
            luxels.push_back({{map.value(x, y, 0), map.value(x, y, 1), map.value(x, y, 2)},
                              at[0] + b * (at[1] - at[0]) + c * (at[2] - at[0]),
                              glm::normalize(glm::cross(at[1] - at[0], at[2] - at[0]))});
          }
        }
      }
    }
  }
  return luxels;
}

/// A box seen from within, `half` metres from its middle to each side.
Primitive room(glm::vec3 centre, glm::vec3 half) {
  Primitive walls = box(centre, half);
  for (glm::vec3& n : walls.normals) n = -n;
  for (std::size_t i = 0; i + 2 < walls.indices.size(); i += 3)
    std::swap(walls.indices[i], walls.indices[i + 1]);
  for (std::size_t i = 0; walls.indices.empty() && i + 2 < walls.positions.size(); i += 3)
    std::swap(walls.positions[i], walls.positions[i + 1]);
  return walls;
}

Light lamp(LightType type, double candela) {
  Light light;
  light.name = "lamp";
  light.type = type;
  light.intensity = candela;
  return light;
}

/// A room of 4 × 3 × 4 m with a table, a lamp, a spot and a slide on a wall.
Scene furnished_room() {
  Scene scene;
  add_object(scene, "room", room({0, 1.5F, 0}, {2, 1.5F, 2}), {0.7F, 0.6F, 0.5F});
  add_object(scene, "table", box({0.5F, 0.4F, 0.3F}, {0.5F, 0.4F, 0.4F}), {0.3F, 0.5F, 0.7F});
  add_light(scene, lamp(LightType::point, 80), {-0.9, 2.6, -0.4}, {0, 0, 0});
  Light spot = lamp(LightType::spot, 150);
  spot.name = "spot";
  spot.color = {1, 0.8F, 0.5F};
  spot.inner_cone = Angle::degrees(15);
  spot.outer_cone = Angle::degrees(35);
  add_light(scene, spot, {1.5, 2.7, 1.5}, {-0.5, 0, -1});
  const int slide = add_linear_picture(scene, 16, 16, [](int x, int y) {
    return glm::vec3(0.2F + 0.05F * float(x), 0.5F, 0.1F + 0.05F * float(y));
  });
  Light beamer = projector("beamer", 0.4, 0.3, slide);
  beamer.intensity = 60;
  add_light(scene, beamer, {-1.5, 1.5, 1.2}, {1, 1.2, -1.9});
  for (Light& light : scene.lights) light.shadow.technique = ShadowTechnique::map;
  return scene;
}

double luminance(const glm::vec3& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

// Row 71: baked light equals what light meters read at the luxels' middles within 1 %, wherever the light does not change by more
// than 2 % within 5 mm.
TEST(LightMaps, BakedLightIsTheLiveLightAtLuxelCentres) {
  const Scene scene = furnished_room();
  BakeSettings settings;
  settings.density = 12;
  settings.samples = 1;
  const Result<BakedScene> baked = bake_light(scene, settings);
  ASSERT_TRUE(baked);
  const std::vector<Luxel> luxels = luxels_of(baked->scene);
  constexpr std::size_t kProbesEach = 5;
  std::vector<Probe> probes;
  for (const Luxel& luxel : luxels) {
    const glm::dvec3 side = std::abs(luxel.normal_ws.y) > 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::cross(luxel.normal_ws, side), v = glm::cross(luxel.normal_ws, u);
    for (const glm::dvec3& beside : {glm::dvec3(0), u, -u, v, -v})
      probes.push_back({luxel.position_ws + 0.005 * beside, luxel.normal_ws, 0});
  }
  const Result<ProbeReport> live = make_renderer(scene).measure_probes(probes, {});
  ASSERT_TRUE(live);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < luxels.size(); ++i) {
    const double here = live->readings[kProbesEach * i].lux;
    bool is_even = true;
    for (std::size_t k = 1; k < kProbesEach; ++k)
      is_even &= std::abs(live->readings[kProbesEach * i + k].lux - here) <= 0.02 * here;
    if (!is_even) continue;
    ++compared;
    EXPECT_NEAR(luminance(luxels[i].irradiance), here, 0.01 * here) << i;
  }
  EXPECT_GT(luxels.size(), 8000U);
  EXPECT_GT(static_cast<double>(compared), 0.85 * static_cast<double>(luxels.size()));
}

// Row 71: density is luxels per metre, in every direction, and what oblique triangles of a chart lose is bounded.
TEST(LightMaps, DensityIsWhatWasAskedFor) {
  for (const double density : {5.0, 20.0}) {
    Scene scene;
    add_object(scene, "ball", sphere({0, 0, 0}, 1, 24));
    add_object(scene, "ring", torus({4, 0, 0}, 1, 0.3F, 24));
    add_object(scene, "floor", floor(3, -2));
    add_light(scene, lamp(LightType::point, 10), {0, 3, 0}, {1, 0, 0});
    BakeSettings settings;
    settings.density = density;
    settings.samples = 1;
    const Result<BakedScene> baked = bake_light(scene, settings);
    ASSERT_TRUE(baked);
    EXPECT_GE(baked->report.least_density, 0.866 * density);
    EXPECT_LE(baked->report.greatest_density, 2 * density);
    EXPECT_GT(baked->report.used, density > 10 ? 0.4 : 0.2);
  }
}

// No look-up reads a luxel of another surface or one without light: in a closed room without shadows the baked picture is the
// live one, corners and edges of charts included.
TEST(LightMaps, BakedRoomsHaveNoSeams) {
  Scene scene;
  add_object(scene, "room", room({0, 1.5F, 0}, {2, 1.5F, 2}));
  scene.phong = PhongHighlight{};
  add_light(scene, lamp(LightType::point, 80), {-0.4, 1.6, 0.3}, {0, 0, 0});
  BakeSettings settings;
  settings.density = 32;
  const Result<BakedScene> baked = bake_light(scene, settings);
  ASSERT_TRUE(baked);
  const Renderer live = make_renderer(scene), kept = make_renderer(baked->scene);
  RenderSettings picture = test_settings(160, 120);
  for (const glm::dvec3& target : {glm::dvec3(1.9, 0.1, -1.9), glm::dvec3(-1.9, 2.9, 1.9)}) {
    const View view = look({-0.2, 1.5, -0.1}, target, 80, 160.0 / 120);
    const LayeredImage a = render(live, view, picture), b = render(kept, view, picture);
    for (int y = 0; y < 120; ++y) {
      for (int x = 0; x < 160; ++x)
        ASSERT_NEAR(at(b, "G", x, y), at(a, "G", x, y), 0.01F * at(a, "G", x, y)) << x << ' ' << y;
    }
  }
}

// Two rooms on one floor, a wall of 1 cm between them: where it is dark not a single luxel has any light, however many places
// in a luxel are looked at.
TEST(LightMaps, NoLightLeaksThroughWalls) {
  Scene scene;
  Mesher shell;
  shell.primitive = room({0, 1, 0}, {2, 1, 1});
  add_object(scene, "shell", shell.primitive);
  add_object(scene, "wall", box({0, 1, 0}, {0.005F, 1, 1}));
  add_light(scene, lamp(LightType::point, 50), {1.2, 1.3, 0.2}, {0, 0, 0});
  for (const int samples : {1, 4}) {
    BakeSettings settings;
    settings.density = 9.7;
    settings.samples = samples;
    const Result<BakedScene> baked = bake_light(scene, settings);
    ASSERT_TRUE(baked);
    std::size_t dark = 0, lit = 0;
    for (const Luxel& luxel : luxels_of(baked->scene)) {
      const double x = luxel.position_ws.x;
      if (x < -0.004) {
        ++dark;
        EXPECT_EQ(luminance(luxel.irradiance), 0)
            << x << ' ' << luxel.position_ws.y << ' ' << luxel.position_ws.z;
      } else if (x > 0.02) {
        ++lit;
        EXPECT_GT(luminance(luxel.irradiance), 0.1)
            << x << ' ' << luxel.position_ws.y << ' ' << luxel.position_ws.z;
      }
    }
    EXPECT_GT(dark, 1000U);
    EXPECT_GT(lit, 1000U);
  }
}

// Ambient light before a wall of height h, seen from d before it: the wall hides ½ (1 − d / √(d² + h²)).
TEST(LightMaps, OcclusionBeforeAWallIsItsFormFactor) {
  Scene scene;
  Mesher mesher;
  mesher.quad({-1, 0, 2}, {1, 0, 2}, {1, 0, 0}, {-1, 0, 0});
  add_object(scene, "floor", mesher.primitive);
  add_object(scene, "wall", wall(400, 1.5F, 0));
  scene.materials[1].unlit = true;
  scene.ambient = glm::vec3(0.5F);
  scene.ambient_is_set = true;
  BakeSettings settings;
  settings.density = 4;
  settings.samples = 1;
  settings.max_size = 4096;
  settings.occlusion_rays = 2000;
  settings.lights = {};
  const Result<BakedScene> baked = bake_light(scene, settings);
  ASSERT_TRUE(baked);
  const Material& material = baked->scene.materials[0];
  const Image& map =
      *baked->scene.pictures[static_cast<std::size_t>(material.occlusion_texture.picture)].pixels;
  ASSERT_EQ(material.occlusion_texture.uv_set, 1);
  for (const Luxel& luxel : luxels_of(baked->scene)) {
    if (luxel.normal_ws.y < 0.5 || luxel.position_ws.z < 0.2) continue;
    EXPECT_EQ(luminance(luxel.irradiance), 0);
  }
  const Primitive& p = baked->scene.meshes[0].primitives[0];
  for (std::size_t i = 0; i < p.positions.size(); ++i) {
    const double d = p.positions[i].z;
    if (d < 0.2) continue;
    const glm::vec2 uv = p.uv[1][i];
    const float open = map.value(static_cast<int>(uv.x * static_cast<float>(map.width())),
                                 static_cast<int>(uv.y * static_cast<float>(map.height())), 0);
    EXPECT_NEAR(open, 1 - 0.5 * (1 - d / std::hypot(d, 1.5)), 0.01);
  }
}

std::vector<std::uint8_t> bytes_of(const Image& image) {
  const std::span<const std::uint8_t> values = image.values<std::uint8_t>();
  return {values.begin(), values.end()};
}

// Row 72: on a walk more than 95 % of the surfaces are in the cache, and pictures are those that are drawn without one, and with
// one that is too small for them.
TEST(QuakeSurfaces, AWalkFindsItsSurfacesInTheCache) {
  Scene scene = furnished_room();
  BakeSettings baking;
  baking.density = 2;
  const Result<BakedScene> baked = bake_light(std::move(scene), baking);
  ASSERT_TRUE(baked);
  QuakeSettings settings{.width = 64, .height = 40};
  Result<QuakeWalk> walk = QuakeWalk::create(baked->scene, settings);
  settings.cache_bytes = 0;
  Result<QuakeWalk> without = QuakeWalk::create(baked->scene, settings);
  ASSERT_TRUE(walk && without);
  constexpr int kPictures = 100;
  const auto view = [](int i) {
    const double t = static_cast<double>(i) / kPictures;
    return look({-1.5 + t, 1.6, 1.5 - t}, {1.5 - 2 * t, 1, -1.5}, 70, 1.6);
  };
  for (int i = 0; i < kPictures; ++i) {
    const std::vector<std::uint8_t> picture = bytes_of(walk->draw(view(i)));
    if (i % 10 == 0) {
      EXPECT_EQ(picture, bytes_of(without->draw(view(i))));
    }
  }
  settings.cache_bytes = walk->statistics().most_bytes / 2;
  Result<QuakeWalk> small = QuakeWalk::create(baked->scene, settings);
  ASSERT_TRUE(small);
  for (int i = 0; i < kPictures; i += 10)
    EXPECT_EQ(bytes_of(small->draw(view(i))), bytes_of(walk->draw(view(i))));
  EXPECT_EQ(walk->statistics().pictures, static_cast<std::size_t>(kPictures + kPictures / 10));
  EXPECT_GT(walk->statistics().asked, 500U);
  EXPECT_GT(walk->statistics().hit_rate(), 0.95);
  EXPECT_EQ(without->statistics().found, 0U);
  EXPECT_GT(small->statistics().dropped, 0U);
  EXPECT_LE(small->statistics().most_bytes, settings.cache_bytes);
}

// Row 71: a surface shows its colour times its intensity, a byte of the greatest in the scene, in steps of no more than that
// and the display's codes.
TEST(QuakeSurfaces, AProductIsTextureTimesLightMap) {
  Scene scene;
  add_object(scene, "floor", floor(2), {0.25F, 0.5F, 1});
  scene.materials[0].metallic = 0;
  Light sun = lamp(LightType::directional, 1000);
  add_light(scene, sun, {0, 5, 0}, {0, 0, 0}, {0, 0, -1});
  const Result<BakedScene> baked = bake_light(scene, {});
  ASSERT_TRUE(baked);
  const auto middle = [&](double white_lux, QuakePicture picture) {
    Result<QuakeWalk> walk =
        QuakeWalk::create(baked->scene, {.width = 9, .height = 9, .white_lux = white_lux});
    const Image image = walk->draw(look({0, 3, 0}, {0, 0, 0}, 40, 1, {0, 0, -1}), picture);
    return glm::ivec3(image.value(4, 4, 0) * 255.0F + 0.5F, image.value(4, 4, 1) * 255.0F + 0.5F,
                      image.value(4, 4, 2) * 255.0F + 0.5F);
  };
  EXPECT_EQ(middle(0, QuakePicture::texture), glm::ivec3(137, 188, 255));
  EXPECT_EQ(middle(0, QuakePicture::product), glm::ivec3(137, 188, 255));
  // 1000 lx of 5000 are the byte 51 of 255, 0.2.
  EXPECT_EQ(middle(5000, QuakePicture::light_map), glm::ivec3(124));
  EXPECT_EQ(middle(5000, QuakePicture::product), glm::ivec3(63, 89, 124));
}

}  // namespace
}  // namespace laterna
