// How dark shadows are shown: see-through black (Chen and Tung), the ambient factor and the dim fill (Wikipedia, Shadow
// mapping).
#include <gtest/gtest.h>

#include <cmath>

#include "reference/picture_probes.h"
#include "reference/shapes.h"

namespace laterna {
namespace {

using namespace reference;

// A board over a textured floor in a sun from above; the left half of the picture is in its shadow.
LayeredImage board_over_floor(const ShadowSettings& shadow, ShadingModel model) {
  Scene scene;
  const int floor_node = add_object(scene, "floor", floor(2), {0.8F, 0.5F, 0.25F});
  Material& material = scene.materials[static_cast<std::size_t>(
      scene.meshes[static_cast<std::size_t>(scene.nodes[static_cast<std::size_t>(floor_node)].mesh)]
          .primitives[0]
          .material)];
  material.base_color_texture.picture = add_picture(scene, 8, 8, [](int x, int y) {
    return (x + y) % 2 == 0 ? glm::u8vec3(255, 200, 90) : glm::u8vec3(70, 180, 250);
  });
  const int board = add_object(scene, "board", box({-1, 1, 0}, {1, 0.05F, 2}));
  scene.nodes[static_cast<std::size_t>(board)].visible = false;
  Light sun;
  sun.name = "sun";
  sun.type = LightType::directional;
  sun.intensity = 2;
  sun.shadow = shadow;
  add_light(scene, sun, {0, 5, 0}, {0, 0, 0}, {0, 0, -1});
  scene.ambient = glm::vec3(0.125F);
  scene.ambient_is_set = true;
  RenderSettings settings = test_settings(64, 64);
  settings.shading = model;
  settings.layers = {Layer::light, Layer::visibility, Layer::lux};
  const View camera = look({0, 3, 0}, {0, 0, 0}, 30, 1, {0, 0, -1});
  return render(make_renderer(std::move(scene)), camera, settings);
}

ShadowSettings no_shadow() {
  ShadowSettings settings;
  settings.technique = ShadowTechnique::none;
  return settings;
}

constexpr int kShaded = 10, kLit = 50, kRow = 20;  // pixels

// Row 34: pixel = lit · (1 − opacity (1 − color)); the receiver's own texture stays visible.
TEST(ShadowDarkness, SeeThroughBlackLeavesTheReceiversTexture) {
  const LayeredImage lit = board_over_floor(no_shadow(), ShadingModel::phong);
  ShadowSettings shadow;
  shadow.opacity = 0.75F;
  shadow.color = {0.5F, 0, 0.25F};
  const LayeredImage seen = board_over_floor(shadow, ShadingModel::phong);
  const char* channels[] = {"light.sun.R", "light.sun.G", "light.sun.B"};
  for (int k = 0; k < 3; ++k) {
    const float factor = 1 - shadow.opacity * (1 - shadow.color[k]);
    for (const int x : {kShaded, kShaded + 7, kShaded + 13}) {
      EXPECT_FLOAT_EQ(at(seen, channels[k], x, kRow), at(lit, channels[k], x, kRow) * factor) << k;
    }
    EXPECT_EQ(at(seen, channels[k], kLit, kRow), at(lit, channels[k], kLit, kRow));
  }
  // The texture is there: neighbouring fields keep their ratio.
  EXPECT_NE(at(seen, "light.sun.R", kShaded, kRow), at(seen, "light.sun.R", kShaded + 7, kRow));
  // What is measured stays what arrives.
  EXPECT_EQ(at(seen, "visibility.sun", kShaded, kRow), 0);
  EXPECT_EQ(at(seen, "lux.Y", kShaded, kRow), 0);
  EXPECT_FLOAT_EQ(at(seen, "lux.Y", kLit, kRow), 2);
}

TEST(ShadowDarkness, ByDefaultNothingArrivesInFullShadow) {
  const LayeredImage seen = board_over_floor({}, ShadingModel::pbr);
  EXPECT_EQ(at(seen, "light.sun.G", kShaded, kRow), 0);
  EXPECT_GT(at(seen, "light.sun.G", kLit, kRow), 0.1F);
}

// Row 91: the value that a failed test returns.
TEST(ShadowDarkness, TheAmbientFactorIsWhatTheFailedTestReturns) {
  const LayeredImage lit = board_over_floor(no_shadow(), ShadingModel::papers);
  for (const float ambient : {0.0F, 0.25F, 1.0F}) {
    ShadowSettings shadow;
    shadow.ambient = ambient;
    const LayeredImage seen = board_over_floor(shadow, ShadingModel::papers);
    EXPECT_FLOAT_EQ(at(seen, "light.sun.R", kShaded, kRow), ambient * at(lit, "light.sun.R", kShaded, kRow));
    EXPECT_EQ(at(seen, "light.sun.R", kLit, kRow), at(lit, "light.sun.R", kLit, kRow));
  }
}

// Row 90: a ball in full shadow is flat without the fill, and shaded by n·l with it.
TEST(ShadowDarkness, TheDimFillShowsCurvesInShadow) {
  const auto ball_in_shadow = [](float fill) {
    Scene scene;
    add_object(scene, "ball", sphere({0, 0, 0}, 1, 48));
    const int roof = add_object(scene, "roof", box({0, 4, 0}, {3, 0.05F, 3}));
    scene.nodes[static_cast<std::size_t>(roof)].visible = false;
    Light sun;
    sun.name = "sun";
    sun.type = LightType::directional;
    sun.shadow.fill = fill;
    add_light(scene, sun, {0, 5, 0}, {0, 0, 0}, {0, 0, -1});
    RenderSettings settings = test_settings(64, 64);
    settings.layers = {Layer::light};
    return render(make_renderer(std::move(scene)), look({0, 0, 5}, {0, 0, 0}, 25, 1), settings);
  };
  const LayeredImage flat = ball_in_shadow(0), filled = ball_in_shadow(0.25F);
  for (const int y : {12, 20, 28}) {
    EXPECT_EQ(at(flat, "light.sun.R", 32, y), 0);
    // The pixel's ray from the eye at (0, 0, 5) meets the unit ball at this height, which is n·l there.
    const double slope = std::tan(Angle::degrees(12.5).in_radians()) * (32 - (y + 0.5)) / 32;
    const double along = (5 - std::sqrt(25 - 24 * (1 + slope * slope))) / (1 + slope * slope);
    EXPECT_NEAR(at(filled, "light.sun.R", 32, y), 0.25 * slope * along, 0.002);
  }
}

}  // namespace
}  // namespace laterna
