// Row 41: terrain from a height map receives correct shadows, and its detail changes neither with the camera nor with time.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "laterna/terrain.h"
#include "reference/picture_probes.h"
#include "reference/shadow_scenes.h"
#include "reference/shadow_truth.h"

namespace laterna {
namespace {

using namespace reference;

// 256 × 256 samples over 8 m × 8 m.
HeightMap hills() {
  HeightMap map = {256, 256, {}};
  for (int j = 0; j < 256; ++j) {
    for (int i = 0; i < 256; ++i) {
      const double x = i / 255.0 * 8 - 4, z = j / 255.0 * 8 - 4;
      map.heights.push_back(static_cast<float>(0.25 * std::sin(1.3 * x) * std::cos(1.7 * z + 0.4)));
    }
  }
  return map;
}

Scene hills_in_the_sun(double error) {
  Scene scene;
  add_object(scene, "terrain", make_terrain(hills(), {8, 8, error}).value());
  add_object(scene, "ball", sphere({0.3F, 0.9F, 0}, 0.4F, 48));
  add_object(scene, "post", box({-1.2F, 0.6F, 0.4F}, {0.1F, 0.8F, 0.1F}));
  Light light = sun("sun");
  light.shadow.resolution = 1024;
  add_light(scene, light, {-3, 4, 1}, {0, 0, 0});
  return scene;
}

RenderSettings settings_with(int width, int height, ShadowTechnique technique) {
  RenderSettings settings = test_settings(width, height);
  settings.shadows = technique;
  settings.layers = {Layer::visibility, Layer::object, Layer::position};
  return settings;
}

// Against rays: nothing lit or dark that should not be, at the feet of what stands on it neither; only edges may be a texel
// off. With the surface as fine as the map and with a quarter of the triangles.
TEST(Terrain, ReceivesTheTrueShadow) {
  const View camera = look({0.5, 3.5, 4.5}, {0, 0.1, 0}, 40, 4.0 / 3);
  for (const double error : {0.0, 0.01}) {
    const Renderer renderer = make_renderer(hills_in_the_sun(error));
    for (const ShadowTechnique technique : {ShadowTechnique::map, ShadowTechnique::exact}) {
      const ShadowErrors errors = find_shadow_errors(
          draw_shadow_masks(renderer, camera, settings_with(240, 180, technique), "sun", 3));
      SCOPED_TRACE(to_string(errors));
      EXPECT_EQ(errors.far_false_dark, 0);
      EXPECT_EQ(errors.far_false_lit, 0);
      EXPECT_LE(errors.contact_gap, 2);
      EXPECT_GT(errors.edge_pixels, 100);
    }
  }
}

// The shadow of a vertical post on a slope, by hand: where the ray from its top meets the ground.
TEST(Terrain, ShadowOfAPostOnASlopeEndsWhereItMust) {
  HeightMap slope = {65, 65, {}};
  for (int j = 0; j < 65; ++j) {
    for (int i = 0; i < 65; ++i) slope.heights.push_back(static_cast<float>((i / 64.0 - 0.5) * 8 * 0.25));
  }
  Scene scene;
  add_object(scene, "terrain", make_terrain(slope, {8, 8, 0}).value());
  add_object(scene, "post", box({0, 0.5F, 0}, {0.05F, 0.5F, 0.05F}));  // its top at 1 m
  add_light(scene, sun("sun"), {-2, 2, 0}, {0, 0, 0});
  const Renderer renderer = make_renderer(std::move(scene));
  View camera = look({0, 10, 0}, {0, 0, 0}, 40, 1, {0, 0, -1});
  camera.projection = Projection::orthographic(2, 2, 0.1, 20);
  const LayeredImage image = renderer.render(camera, settings_with(801, 801, ShadowTechnique::map)).value();
  const std::span<const float> alpha = values_of(image, "visibility.sun");
  int end = 0;
  for (int x = 0; x < 801; ++x) end = alpha[400 * 801 + static_cast<std::size_t>(x)] < 0.5F ? x : end;
  // Down one metre for each metre to the right from (0.05, 1): 1.05 − x = x / 4.
  EXPECT_NEAR((end + 1) * 4.0 / 801 - 2, 1.05 / 1.25, 4.0 / 801);
}

// Whether all around a pixel is lit, or all dark.
bool is_plain(std::span<const float> alpha, int side, int x, int y) {
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, side - 1); ++v) {
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, side - 1); ++u) {
      if (alpha[static_cast<std::size_t>(v * side + u)] != alpha[static_cast<std::size_t>(y * side + x)])
        return false;
    }
  }
  return true;
}

// A camera that slides by whole pixels sees the same points again: the light that arrives there is the same, but where the
// edge of a shadow runs through a point. What casts does not depend on the camera: its map is drawn once.
TEST(Terrain, ShadowsStayUnderASlowCamera) {
  const Renderer renderer = make_renderer(hills_in_the_sun(0.01));
  constexpr int kSide = 256;
  constexpr double kPixel = 1.0 / 64;
  const RenderSettings settings = settings_with(kSide, kSide, ShadowTechnique::map);
  const auto draw = [&](int step, RenderStatistics& statistics) {
    View camera = look({step * kPixel, 6, 0}, {step * kPixel, 0, 0}, 40, 1, {0, 0, -1});
    camera.projection = Projection::orthographic(2, 2, 0.5, 20);
    return renderer.render(camera, settings, {}, &statistics).value();
  };
  RenderStatistics statistics;
  LayeredImage before = draw(0, statistics);
  EXPECT_EQ(statistics.maps_drawn, 1);
  int compared = 0, dark = 0, changed = 0;
  double total = 0;
  for (int step = 1; step <= 8; ++step) {
    LayeredImage after = draw(step, statistics);
    EXPECT_EQ(statistics.maps_drawn, 0);
    EXPECT_EQ(statistics.maps_kept, 1);
    const std::span<const float> old_alpha = values_of(before, "visibility.sun"),
                                 alpha = values_of(after, "visibility.sun");
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x + 1 < kSide; ++x) {
        const auto at = static_cast<std::size_t>(y * kSide + x);
        ASSERT_NEAR(values_of(before, "P.Y")[at + 1], values_of(after, "P.Y")[at], 1e-4F);
        const double change = std::abs(old_alpha[at + 1] - alpha[at]);
        ++compared;
        dark += alpha[at] < 0.5F ? 1 : 0;
        changed += change > 0 ? 1 : 0;
        EXPECT_TRUE(change == 0 || !is_plain(alpha, kSide, x, y)) << x << " " << y;
        total += change;
      }
    }
    before = std::move(after);
  }
  EXPECT_GT(dark, compared / 25);
  EXPECT_LE(changed, compared / 2000);
  EXPECT_LE(total / compared, 5e-4);
}

}  // namespace
}  // namespace laterna
