// Row 93 of the papers' list, parallel-split shadow maps: Zhang, Sun, Xu and Lun, Parallel-split shadow maps for
// large-scale virtual environments, 2006.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "light/camera_frustum.h"
#include "light/cascades.h"
#include "reference/picture_probes.h"
#include "reference/shadow_scenes.h"

namespace laterna {
namespace {

using namespace reference;

// Row 93: C_i = λ n (f/n)^(i/m) + (1 − λ) (n + (f − n) i/m).
TEST(Cascades, AreSplitByThePracticalScheme) {
  const std::vector<double> logarithmic = {1, 10, 100, 1000}, uniform = {1, 334, 667, 1000};
  for (const double lambda : {0.0, 0.5, 0.75, 1.0}) {
    const std::vector<double> splits = light::find_splits(1, 1000, 3, lambda);
    ASSERT_EQ(splits.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(splits[i], lambda * logarithmic[i] + (1 - lambda) * uniform[i], 1e-9) << lambda;
  }
  EXPECT_EQ(light::find_splits(0.5, 8, 1, 0.5), (std::vector<double>{0.5, 8}));
}

// Boxes along a road of `length` metres, in the sun; the camera stands at its beginning.
struct Road {
  Scene scene;
  View camera;
};
Road road(double length, const ShadowSettings& settings) {
  Road made;
  add_object(made.scene, "ground", floor(static_cast<float>(length)));
  for (double z = 3; z < length; z *= 1.35) {
    const auto size = static_cast<float>(0.03 * z);
    const auto at = static_cast<float>(-z);
    add_object(made.scene, "left", box({-3 * size, 3 * size, at}, {size, 3 * size, size}));
    add_object(made.scene, "right", box({4 * size, 2 * size, at}, {size, 2 * size, size}));
  }
  Light light = sun("light");
  light.shadow = settings;
  add_light(made.scene, light, {3, 4, 2}, {0, 0, 0});
  made.camera = look({0, 1.7, 0}, {0, 0.5, -10}, 50, 4.0 / 3);
  return made;
}

ShadowSettings cascaded(int resolution) {
  ShadowSettings settings;
  settings.technique = ShadowTechnique::cascades;
  settings.resolution = resolution;
  return settings;
}

// Row 93: every point of a slice of the camera's frustum that anything could shade lies within its map, and the
// nearer the slice, the finer the map.
TEST(Cascades, HoldTheirSliceOfTheFrustum) {
  const Road made = road(200, cascaded(512));
  const Renderer renderer = make_renderer(made.scene);
  const auto maps = renderer.shadow_map_views("light", made.camera, test_settings(64, 48)).value();
  ASSERT_EQ(maps.size(), 4U);
  const OwnedFrame owned = make_frame(made.scene);
  const light::Range depth = light::find_depth_range(made.camera, owned.frame);
  const std::vector<double> splits =
      light::find_splits(depth.low, depth.high, 4, ShadowSettings{}.split_lambda);
  double texel_before = 0;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const Projection& p = maps[i].view.projection;
    const double texel = (p.right - p.left) / maps[i].width;
    EXPECT_GT(texel, 1.2 * texel_before);
    texel_before = texel;
    EXPECT_NEAR((p.top - p.bottom) / maps[i].height, texel, 1e-9) << "texels are squares";
    EXPECT_LE(maps[i].width, 512);
    int inside = 0;
    for (int k = 0; k < 1000; ++k) {
      const double z = splits[i] + (splits[i + 1] - splits[i]) * (k % 10) / 9;
      const double x = ((k / 10) % 10 / 4.5 - 1) * made.camera.projection.right * z;
      const double y = ((k / 100) / 4.5 - 1) * made.camera.projection.top * z;
      const Pose& pose = made.camera.pose;
      const glm::dvec3 point =
          pose.position_ws + pose.forward_ws() * z + pose.right_ws() * x + pose.up_ws() * y;
      // What lies beside all casters is lit, and in no need of a map.
      if (std::abs(point.x) > 200 || std::abs(point.z) > 200 || point.y < 0 || point.y > 20) continue;
      const glm::dvec4 at = maps[i].view.image_from_world() * glm::dvec4(point, 1);
      for (const double s : {at.x, at.y}) {
        EXPECT_GT(s, 0) << i;
        EXPECT_LT(s, 1) << i;
      }
      ++inside;
    }
    EXPECT_GT(inside, 50);
  }
}

// Of an orthographic map of the whole scene a picture of what is near uses few texels.
TEST(Cascades, AreFinerNearTheCameraThanOneMapOfAsManyTexels) {
  const auto errors_with = [](ShadowTechnique technique, ShadowFilter filter) {
    ShadowSettings settings = cascaded(technique == ShadowTechnique::cascades ? 256 : 512);
    settings.technique = technique;
    settings.filter = filter;
    const Road made = road(300, settings);
    const Renderer renderer = make_renderer(made.scene);
    Road ray_traced = road(300, cascaded(256));
    ray_traced.scene.lights[0].shadow.technique = ShadowTechnique::raytraced;
    RenderSettings wanted = test_settings(320, 240);
    wanted.layers = {Layer::visibility};
    const LayeredImage got = render(renderer, made.camera, wanted);
    const LayeredImage truth = render(make_renderer(ray_traced.scene), made.camera, wanted);
    const auto a = values_of(got, "visibility.light"), b = values_of(truth, "visibility.light");
    int wrong = 0;
    for (std::size_t i = 0; i < a.size(); ++i) wrong += (a[i] >= 0.5F) != (b[i] >= 0.5F) ? 1 : 0;
    return wrong;
  };
  for (const ShadowFilter filter : {ShadowFilter::refined, ShadowFilter::bilinear}) {
    const int one_map = errors_with(ShadowTechnique::map, filter);
    const int cascades = errors_with(ShadowTechnique::cascades, filter);
    EXPECT_LT(2 * cascades, one_map) << static_cast<int>(filter);
    EXPECT_GT(one_map, 100);
  }
}

// The largest step of α from pixel to pixel along the edge of a shadow that runs from the camera to the horizon, through
// all splits. Within a cascade bilinear α is continuous: what is left are seams.
TEST(Cascades, AlphaStepsByLessThanATapWhereTheyMeet) {
  ShadowSettings settings = cascaded(512);
  settings.filter = ShadowFilter::bilinear;
  settings.cascade_distance = 60;
  Scene scene;
  add_object(scene, "ground", floor(300));
  // A wall's edge along z, in the camera's plane; its shadow falls to the left.
  add_object(scene, "wall", box({1, 1, 0}, {0.02F, 1, 299}));
  Light light = sun("light");
  light.shadow = settings;
  add_light(scene, light, {1, 2, 0}, {0, 0, 0}, {0, 0, -1});
  // The wall is 2 m high and stands at x = 0.98: its shadow ends at x = −0.02 or so.
  const Renderer renderer = make_renderer(scene);
  RenderSettings wanted = test_settings(401, 600);
  wanted.layers = {Layer::visibility, Layer::position};
  const View camera = look({-0.02, 3, 40}, {-0.02, 0, 10}, 50, 401.0 / 600);
  const auto maps = renderer.shadow_map_views("light", camera, wanted).value();
  ASSERT_GE(maps.size(), 3U);
  const LayeredImage image = render(renderer, camera, wanted);
  const auto alpha = values_of(image, "visibility.light");
  const auto x = values_of(image, "P.X"), y = values_of(image, "P.Y"), z = values_of(image, "P.Z");
  const auto cascade_at = [&](std::size_t pixel) {
    for (std::size_t i = 0; i < maps.size(); ++i) {
      const glm::dvec4 st = maps[i].image_from_world * glm::dvec4(x[pixel], y[pixel], z[pixel], 1);
      if (std::min(st.x, st.y) > 0 && std::max(st.x, st.y) < 1) return i;
    }
    return maps.size();
  };
  float largest = 0;
  int between = 0;
  std::set<std::size_t> passed;
  for (std::size_t column = 196; column <= 204; ++column) {
    for (std::size_t row = 300; row + 1 < 600; ++row) {
      const std::size_t here = row * 401 + column, below = here + 401;
      if (alpha[here] <= 0.02F || alpha[here] >= 0.98F) continue;
      // Steps along the edge, not across it.
      if (std::abs(x[here] - x[below]) > 0.002F) continue;
      largest = std::max(largest, std::abs(alpha[here] - alpha[below]));
      ++between;
      passed.insert(cascade_at(here));
    }
  }
  EXPECT_GT(between, 200);
  EXPECT_GE(passed.size(), 3U) << "the edge is to pass through several cascades";
  EXPECT_LT(largest, 1.0F / 9);
}

// Only parallel light has them.
TEST(Cascades, LeaveOtherLightsToMaps) {
  Light lamp = spot("lamp", 30);
  EXPECT_NE(find_fault(ShadowTechnique::cascades, lamp), "");
  EXPECT_EQ(find_fault(ShadowTechnique::cascades, sun("sun")), "");
  Scene scene;
  add_object(scene, "floor", floor(2));
  add_light(scene, lamp, {0, 3, 0}, {0, 0, 0}, {0, 0, 1});
  const Renderer renderer = make_renderer(scene);
  RenderSettings settings = test_settings(32, 32);
  const View view = look({0, 2, 4}, {0, 0, 0}, 40, 1);
  const Result<LayeredImage> by_map = renderer.render(view, settings);
  settings.shadows = ShadowTechnique::cascades;
  const Result<LayeredImage> drawn = renderer.render(view, settings);
  ASSERT_TRUE(by_map && drawn);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(drawn->channels[c].values, by_map->channels[c].values);
}

TEST(Cascades, AreRefusedWithNumbersThatMakeNoSense) {
  Scene scene;
  Light light = sun("sun");
  light.shadow.cascades = 9;
  light.shadow.split_lambda = -0.5;
  light.shadow.cascade_distance = -1;
  add_light(scene, light, {0, 3, 1}, {0, 0, 0});
  std::vector<std::string> places;
  for (const Diagnostic& fault : validate(scene)) places.push_back(fault.place);
  EXPECT_EQ(places, (std::vector<std::string>{"lights[0].shadow.cascades", "lights[0].shadow.split_lambda",
                                              "lights[0].shadow.cascade_distance"}));
  EXPECT_EQ(to_string(validate(scene)[0]), "lights[0].shadow.cascades: expected from 1 to 8, got 9");
}

}  // namespace
}  // namespace laterna
