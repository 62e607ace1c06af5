// Where shadow maps of point and spot lights begin and end.
#include <gtest/gtest.h>

#include "reference/shapes.h"

namespace laterna {
namespace {

using reference::add_light;
using reference::add_object;
using reference::at;

Light lamp(LightType type) {
  Light light;
  light.name = "lamp";
  light.type = type;
  light.intensity = 100;
  light.outer_cone = Angle::degrees(40);
  return light;
}

// A lamp above a floor, a small plate between them; everything `scale` times as large.
Scene plate_under_lamp(Light light, float scale) {
  Scene scene;
  add_object(scene, "floor", reference::floor(10 * scale));
  add_object(scene, "plate",
             reference::box(glm::vec3(0, 2 * scale, 0), glm::vec3(0.5F, 0.02F, 0.5F) * scale));
  light.intensity *= static_cast<double>(scale) * scale;
  add_light(scene, std::move(light), glm::dvec3(0, 4, 0) * static_cast<double>(scale), {0, 0, 0}, {0, 0, -1});
  return scene;
}

// Light on the floor under the plate, and beside it.
std::pair<float, float> shadow_and_light(Scene scene, float scale) {
  const Renderer renderer = reference::make_renderer(std::move(scene));
  RenderSettings settings = reference::test_settings(65, 65);
  const double s = scale;
  const View below = reference::look(glm::dvec3(0, 1.5, 0) * s, {0, 0, 0}, 60, 1, {0, 0, -1}, 0.01 * s);
  const View beside =
      reference::look(glm::dvec3(2.5, 1.5, 0) * s, glm::dvec3(2.5, 0, 0) * s, 60, 1, {0, 0, -1}, 0.01 * s);
  return {at(reference::render(renderer, below, settings), "R", 32, 32),
          at(reference::render(renderer, beside, settings), "R", 32, 32)};
}

TEST(ShadowMapLimits, RangeDoesNotEndTheShadowsOfALightThatDoesNotFadeByIt) {
  for (const LightType type : {LightType::point, LightType::spot}) {
    Light light = lamp(type);
    light.range = 3;  // the floor is 4 m away
    light.attenuation = Attenuation::inverse_square;
    const auto [shadow, lit] = shadow_and_light(plate_under_lamp(light, 1), 1);
    EXPECT_EQ(shadow, 0);
    EXPECT_GT(lit, 0.1F);
  }
}

TEST(ShadowMapLimits, ModelsOfMillimetresCastShadows) {
  for (const LightType type : {LightType::point, LightType::spot}) {
    const auto [shadow, lit] = shadow_and_light(plate_under_lamp(lamp(type), 1e-3F), 1e-3F);
    EXPECT_EQ(shadow, 0);
    EXPECT_GT(lit, 0.1F);
  }
}

TEST(ShadowMapLimits, TheDepthMapShownIsTheOneUsed) {
  Light light = lamp(LightType::spot);
  const auto depth_above_plate = [&](CasterFaces faces) {
    light.shadow.caster_faces = faces;
    light.shadow.resolution = 128;
    const Renderer renderer = reference::make_renderer(plate_under_lamp(light, 1));
    return at(*renderer.depth_map("lamp"), "Z", 64, 64);
  };
  EXPECT_NEAR(depth_above_plate(CasterFaces::both), 1.98F, 1e-4F);
  EXPECT_NEAR(depth_above_plate(CasterFaces::back_only), 2.02F, 1e-4F);
}

TEST(ShadowMapLimits, ProgressAndCancelReachTheDrawingOfMaps) {
  Light light = lamp(LightType::point);
  light.shadow.resolution = 1024;
  const Renderer renderer = reference::make_renderer(plate_under_lamp(light, 1), 1);
  const View view = reference::look({0, 1.5, 0}, {0, 0, 0}, 60, 1, {0, 0, -1});
  const RenderSettings settings = reference::test_settings(64, 64);
  int calls = 0;
  const Result<LayeredImage> cancelled = renderer.render(view, settings, [&](double) { return ++calls < 3; });
  ASSERT_FALSE(cancelled.has_value());
  EXPECT_EQ(cancelled.error().failure, Failure::cancelled);
  EXPECT_EQ(calls, 3);
  // Tiles that were drawn until then are kept, and the others drawn.
  RenderStatistics statistics;
  const Result<LayeredImage> whole = renderer.render(view, settings, {}, &statistics);
  ASSERT_TRUE(whole.has_value());
  EXPECT_EQ(statistics.maps_drawn, 0);
  EXPECT_EQ(at(*whole, "R", 32, 32), 0);
}

}  // namespace
}  // namespace laterna
