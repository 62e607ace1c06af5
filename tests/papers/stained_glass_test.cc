// Light through blended surfaces: what falls on the floor is slide × transmittance, channel by channel, whatever technique
// finds the shadows.
#include <gtest/gtest.h>

#include <algorithm>

#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"
#include "reference/shapes.h"

namespace laterna {
namespace {

using namespace reference;

std::string_view name_of(ShadowTechnique technique) {
  const auto all = list_techniques();
  return std::find_if(all.begin(), all.end(), [&](const auto& known) { return known.technique == technique; })
      ->name;
}

// Cascades are a sun's.
bool serves(ShadowTechnique technique, LightType type) {
  return technique != ShadowTechnique::cascades || type == LightType::directional;
}

LightType single_light(ShadowTechnique technique) {
  return serves(technique, LightType::point) ? LightType::point : LightType::directional;
}

class StainedGlass : public testing::TestWithParam<ShadowTechnique> {};

int add_pane(Scene& scene, float z, glm::vec4 color) {
  const int node = add_object(scene, "pane", wall(1, 1, z));
  scene.nodes[static_cast<std::size_t>(node)].visible = false;
  scene.materials.back().base_color = color;
  scene.materials.back().alpha_mode = AlphaMode::blend;
  return node;
}

// Soft shadows need a light with a size, and ground shadows a plane to fall on.
void suit(Light& light, ShadowTechnique technique) {
  if (technique == ShadowTechnique::ground) light.shadow.planes = {{{0, 0, 1}, -4}};
  if (technique != ShadowTechnique::pcss) return;
  if (light.type == LightType::directional) {
    light.source.angular_diameter = Angle::degrees(0.5);
  } else {
    light.source.radius = 0.02;
  }
}

// A slide of four colours on a wall 4 m away, with panes between.
LayeredImage slide_through(std::span<const glm::vec4> panes, ShadowTechnique technique, LightType type,
                           glm::dvec3 place = {0.05, 0.02, 0}) {
  Scene scene;
  add_object(scene, "wall", wall(2, 2, -4));
  float z = -1;
  for (const glm::vec4& color : panes) {
    add_pane(scene, z, color);
    z -= 0.75F;
  }
  Light light = type == LightType::projector ? projector("light", 0.5, 0.5) : Light();
  light.name = "light";
  light.type = type;
  suit(light, technique);
  if (type == LightType::projector) {
    light.slide = add_picture(scene, 2, 2, [](int x, int y) {
      return x == 0 ? (y == 0 ? glm::u8vec3(255, 128, 64) : glm::u8vec3(90, 200, 255))
                    : glm::u8vec3(230, 240, 60);
    });
  }
  add_light(scene, light, place, place + glm::dvec3(0, 0, -1));
  RenderSettings settings = papers_settings(64, 64);
  settings.shadows = technique;
  settings.layers = {Layer::light, Layer::visibility, Layer::lux};
  return render(make_renderer(std::move(scene)), look({0, 0, 1}, {0, 0, -1}, 20, 1), settings);
}

const glm::vec4 kRed = {0.9F, 0.1F, 0.05F, 0.8F}, kGreen = {0.2F, 0.8F, 0.3F, 0.5F},
                kBlue = {0.3F, 0.4F, 1, 0.7F};

float transmittance(const glm::vec4& pane, int channel) { return 1 - pane.a * (1 - pane[channel]); }

TEST_P(StainedGlass, ThreePanesGiveTheirProductPerChannel) {
  const glm::vec4 panes[] = {kRed, kGreen, kBlue};
  const char* channels[] = {"light.light.R", "light.light.G", "light.light.B"};
  for (const LightType type : {LightType::projector, LightType::point, LightType::directional}) {
    if (!serves(GetParam(), type)) continue;
    const LayeredImage bare = slide_through({}, GetParam(), type);
    const LayeredImage tinted = slide_through(panes, GetParam(), type);
    for (int k = 0; k < 3; ++k) {
      const float expected = transmittance(kRed, k) * transmittance(kGreen, k) * transmittance(kBlue, k);
      for (int y = 4; y < 64; y += 9) {
        for (int x = 4; x < 64; x += 9) {
          EXPECT_NEAR(at(tinted, channels[k], x, y), at(bare, channels[k], x, y) * expected, 1.0 / 255)
              << static_cast<int>(type) << " " << k << " at " << x << ", " << y;
        }
      }
    }
    EXPECT_GT(at(bare, "light.light.R", 32, 32), 0.05F);
  }
}

// Every place has each pane once: neither twice nor not at all along the diagonal of the square, nor anywhere else.
TEST_P(StainedGlass, ADiagonalOfASquareDoesNotShow) {
  const glm::vec4 panes[] = {kGreen};
  // Camera and light on the axis: the diagonal's rays pass exactly through the edge that two triangles share.
  const LayeredImage image = slide_through(panes, GetParam(), single_light(GetParam()), {0, 0, 0});
  for (const float visibility : values_of(image, "visibility.light")) {
    ASSERT_NEAR(visibility,
                (transmittance(kGreen, 0) + transmittance(kGreen, 1) + transmittance(kGreen, 2)) / 3, 1e-5);
  }
}

// What is drawn opaque casts a full shadow, and what is clear none.
TEST_P(StainedGlass, AlphaOneBlocksAndAlphaNoughtDoesNot) {
  const glm::vec4 opaque[] = {{1, 1, 1, 1}}, clear[] = {{0, 0, 0, 0}};
  const LightType type = single_light(GetParam());
  EXPECT_EQ(at(slide_through(opaque, GetParam(), type), "visibility.light", 20, 30), 0);
  EXPECT_EQ(at(slide_through(clear, GetParam(), type), "visibility.light", 20, 30), 1);
}

// A painted pane: its left half red glass, its right half a hole in the paint.
TEST_P(StainedGlass, ThePanesTextureIsThrownOnTheWall) {
  Scene scene;
  add_object(scene, "wall", wall(2, 2, -4));
  add_pane(scene, -2, {1, 1, 1, 1});
  auto paint = std::make_shared<Image>(2, 1, 4, PixelType::u8, Transfer::linear);
  const std::uint8_t texels[] = {255, 0, 0, 128, 0, 0, 0, 0};
  std::copy(std::begin(texels), std::end(texels), paint->values<std::uint8_t>().begin());
  Texture& texture = scene.materials.back().base_color_texture;
  texture.picture = static_cast<int>(scene.pictures.size());
  texture.sampler.magnify = Filter::nearest;
  texture.sampler.wrap_u = texture.sampler.wrap_v = Wrap::clamp;
  scene.pictures.emplace_back().pixels = paint;
  Light lamp;
  lamp.name = "light";
  lamp.type = single_light(GetParam());
  suit(lamp, GetParam());
  add_light(scene, lamp, {0, 0, 0}, {0, 0, -1});
  RenderSettings settings = papers_settings(64, 64);
  settings.shadows = GetParam();
  settings.layers = {Layer::light};
  const LayeredImage image =
      render(make_renderer(std::move(scene)), look({0, 0, 1}, {0, 0, -1}, 20, 1), settings);
  const double half = 128.0 / 255;
  EXPECT_NEAR(at(image, "light.light.R", 10, 30), at(image, "light.light.R", 53, 30), 1e-6) << "red passes";
  EXPECT_NEAR(at(image, "light.light.G", 10, 30), (1 - half) * at(image, "light.light.G", 53, 30), 1e-6);
  EXPECT_NEAR(at(image, "light.light.B", 10, 30), (1 - half) * at(image, "light.light.B", 53, 30), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Techniques, StainedGlass,
                         testing::Values(ShadowTechnique::map, ShadowTechnique::exact,
                                         ShadowTechnique::raytraced, ShadowTechnique::pcss,
                                         ShadowTechnique::variance, ShadowTechnique::cascades,
                                         ShadowTechnique::volume, ShadowTechnique::ground,
                                         ShadowTechnique::silhouette),
                         [](const auto& instance) { return std::string(name_of(instance.param)); });

}  // namespace
}  // namespace laterna
