// Wikipedia, Shadow mapping (2010): how accurate shadow maps are is a matter of their resolution.
#include <gtest/gtest.h>

#include "laterna/accuracy.h"
#include "reference/shadow_scenes.h"

namespace laterna {
namespace {

using namespace reference;

constexpr int kWidth = 200, kHeight = 4, kSubpixels = 4;  // pixels of 1 cm

// The straight edge of a sheet over a floor, in a sun at the zenith whose map is 2 m wide.
ShadowAccuracy measure_edge(double edge_x, int resolution, ShadowTechnique technique) {
  Scene scene;
  add_object(scene, "floor", floor(5));
  Mesher sheet;
  const auto x = static_cast<float>(edge_x);
  sheet.quad({-4, 1, 4}, {x, 1, 4}, {x, 1, -4}, {-4, 1, -4});
  add_object(scene, "sheet", sheet.primitive);
  Light light = sun("light");
  light.fit = false;
  light.projection = Projection::orthographic(1, 1, 0, 20);
  light.shadow.filter = ShadowFilter::nearest;
  light.shadow.constant_bias = 0.01;
  light.shadow.resolution = resolution;
  add_light(scene, light, {0, 10, 0}, {0, 0, 0}, {0, 0, -1});
  View camera = look({0, 0.5, 0}, {0, 0, 0}, 40, 1, {0, 0, -1});
  camera.projection = Projection::orthographic(0.01 * kWidth / 2, 0.01 * kHeight / 2, 0, 10);
  AccuracySettings settings;
  settings.picture = test_settings(kWidth, kHeight);
  settings.techniques = {technique};
  settings.subpixels = kSubpixels;
  settings.frames = 1;
  return measure_accuracy(make_renderer(std::move(scene)), camera, settings).value().measured.at(0);
}

// Row 92: against ray truth, a map's edge is off by a quarter of a texel on average, wherever in a texel it lies; so
// that twice the resolution halves it. Rays have no resolution.
TEST(WikipediaShadowMapping, AccuracyIsLimitedByTheMapsResolution) {
  constexpr int kOffsets = 16;
  for (const int resolution : {10, 20, 40, 80}) {
    const double texel = 2.0 / resolution;
    double map_error = 0;
    double ray_error = 0;
    for (int i = 0; i < kOffsets; ++i) {
      const double edge_x = (i + 0.5) / kOffsets * texel;
      map_error += measure_edge(edge_x, resolution, ShadowTechnique::map).edge_px_mean / kOffsets;
      ray_error += measure_edge(edge_x, resolution, ShadowTechnique::raytraced).edge_px_mean / kOffsets;
    }
    const double texel_in_pixels = texel / 0.01;
    EXPECT_NEAR(map_error, texel_in_pixels / 4, 0.05 * texel_in_pixels / 4) << resolution;
    EXPECT_EQ(ray_error, 0);
  }
}

}  // namespace
}  // namespace laterna
