// What callers may hand over that no file could hold.
#include <gtest/gtest.h>

#include <limits>

#include "laterna/measure.h"
#include "reference/shapes.h"

namespace laterna {
namespace {

LayeredImage picture_of(std::size_t values) {
  LayeredImage image;
  image.width = image.height = 4;
  for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, std::vector<float>(values)});
  return image;
}

TEST(HostileCallers, PicturesWithTooFewValuesAreRefused) {
  const LayeredImage good = picture_of(16);
  const LayeredImage bad = picture_of(3);
  const Result<Comparison> comparison = compare_images(good, bad, {});
  ASSERT_FALSE(comparison.has_value());
  EXPECT_EQ(to_string(comparison.error()), "channel \"R\" has 3 values; the picture is 4 x 4");
  EXPECT_FALSE(difference_picture(good, bad, 1).has_value());
  LayeredImage uneven = picture_of(16);
  uneven.channels[1].values.resize(2);
  EXPECT_EQ(automatic_exposure(uneven), 1);
}

TEST(HostileCallers, NumbersThatAreNoEnumeratorsAreRefused) {
  Scene scene;
  reference::add_object(scene, "floor", reference::floor(1));
  const Renderer renderer = reference::make_renderer(scene);
  RenderSettings settings = reference::test_settings(8, 8);
  const View view = reference::look({0, 1, 1}, {0, 0, 0}, 60, 1);
  settings.shadows = static_cast<ShadowTechnique>(42);
  EXPECT_FALSE(renderer.render(view, settings).has_value());
  settings = reference::test_settings(8, 8);
  settings.shading = static_cast<ShadingModel>(99);
  EXPECT_FALSE(renderer.render(view, settings).has_value());
  scene.lights.emplace_back().shadow.filter = static_cast<ShadowFilter>(7);
  const std::vector<Diagnostic> faults = validate(scene);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(to_string(faults[0]),
            "lights[0].shadow.filter: 7 is no value of the enumeration, which ends at 4");
}

TEST(HostileCallers, PointsAreInspectedOnlyWhereTheyAre) {
  Scene scene;
  Light light;
  light.name = "beam";
  light.type = LightType::projector;
  light.projection = Projection::orthographic(1, 1, 0, 10);
  reference::add_object(scene, "floor", reference::floor(1));
  reference::add_light(scene, light, {0, 3, 0}, {0, 0, 0}, {0, 0, -1});
  const Renderer renderer = reference::make_renderer(scene);
  const View view = reference::look({0, 1, 1}, {0, 0, 0}, 60, 1);
  EXPECT_TRUE(inspect_point(renderer, view, 8, 8, "beam", {0, 1, 0})->is_inside);
  EXPECT_FALSE(inspect_point(renderer, view, 8, 8, "beam", {0, 4, 0})->is_inside);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(inspect_point(renderer, view, 8, 8, "beam", {0, nan, 0}).has_value());
  EXPECT_FALSE(inspect_point(renderer, view, 0, 8, "beam", {0, 1, 0}).has_value());
}

}  // namespace
}  // namespace laterna
