// Options of shadow maps: radial depths, soft edges by a range of depths, averaged depths; and what a map's size costs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "laterna/instruction_set.h"
#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"
#include "reference/shadow_scenes.h"

namespace laterna {
namespace {

using namespace reference;

// The scene under a projector whose corners lie far off its axis.
ShadowScene under_a_wide_projector(const ShadowSettings& shadow) {
  ShadowScene shown = torus_and_box(4.0 / 3);
  Light& light = shown.scene.lights[0];
  light.type = LightType::projector;
  light.projection = Projection::perspective(Angle::degrees(80), 1, 0.1, 100);
  light.shadow = shadow;
  return shown;
}

RenderSettings with_points(int width, int height) {
  RenderSettings settings = test_settings(width, height);
  settings.layers = {Layer::visibility, Layer::position, Layer::object};
  return settings;
}

// Row 61: by distance from the light rather than along its axis. Where the two decide otherwise, the depths that are compared
// differ by no more than the bias.
TEST(ShadowMapOptions, RadialAndPlanarDepthsAgreeButWithinTheBias) {
  constexpr double kBias = 0.05;
  ShadowSettings shadow;
  shadow.filter = ShadowFilter::nearest;
  shadow.resolution = 512;
  shadow.constant_bias = kBias;
  const ShadowScene planar_scene = under_a_wide_projector(shadow);
  shadow.depth = ShadowDepth::radial;
  const Renderer planar = make_renderer(planar_scene.scene);
  const Renderer radial = make_renderer(under_a_wide_projector(shadow).scene);
  const RenderSettings settings = with_points(480, 360);
  const LayeredImage a = render(planar, planar_scene.camera, settings);
  const LayeredImage b = render(radial, planar_scene.camera, settings);
  const LayeredImage map = planar.depth_map("light").value();
  const View view = planar.light_view("light").value();
  int same = 0;
  int other = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      if (at(a, "id.object", x, y) < 0) continue;
      if (at(a, "visibility.light", x, y) == at(b, "visibility.light", x, y)) {
        ++same;
        continue;
      }
      ++other;
      const glm::dvec4 world(at(a, "P.X", x, y), at(a, "P.Y", x, y), at(a, "P.Z", x, y), 1);
      const glm::dvec4 q = view.image_from_world() * world;
      const float stored =
          at(map, "Z", static_cast<int>(q.x / q.w * map.width), static_cast<int>(q.y / q.w * map.height));
      const double tested = -(view.view_from_world() * world).z;
      EXPECT_LT(std::abs(tested - stored - kBias), kBias) << x << ", " << y;
    }
  }
  EXPECT_GT(same, 60000);
  EXPECT_GT(other, 0);  // they are two comparisons
  EXPECT_LT(other, same / 100);
}

// With the receiver's plane both compare on one ray, so that they cannot differ.
TEST(ShadowMapOptions, RadialAndPlanarDepthsAreOneOnTheReceiversPlane) {
  for (const ShadowFilter filter :
       {ShadowFilter::nearest, ShadowFilter::bilinear, ShadowFilter::percentage_closer}) {
    ShadowSettings shadow;
    shadow.filter = filter;
    const ShadowScene planar = under_a_wide_projector(shadow);
    shadow.depth = ShadowDepth::radial;
    const ShadowScene radial = under_a_wide_projector(shadow);
    const RenderSettings settings = with_points(240, 180);
    EXPECT_LE(count_different_pixels(render(make_renderer(planar.scene), planar.camera, settings),
                                     render(make_renderer(radial.scene), radial.camera, settings)),
              4U);  // rounding
  }
}

// A board that leans on the floor along x = 0 and rises with it, in the sun from above: at x it is x metres up.
Scene leaning_board(const ShadowSettings& shadow) {
  Scene scene;
  add_object(scene, "floor", floor(4));
  Mesher mesh;
  mesh.quad({0, 0, 2}, {2, 2, 2}, {2, 2, -2}, {0, 0, -2});
  add_object(scene, "board", mesh.primitive);
  Light light = sun("light");
  light.shadow = shadow;
  add_light(scene, light, {0, 8, 0}, {0, 0, 0}, {0, 0, -1});
  return scene;
}

// Row 87: a range of depths near the edge makes it soft.
TEST(ShadowMapOptions, ASoftEdgeIsASmoothStepOfTheWidthThatWasSet) {
  for (const double width : {0.2, 0.5, 1.0}) {
    ShadowSettings shadow;
    shadow.soft_edge = width;
    Scene scene = leaning_board(shadow);
    scene.nodes[1].visible = false;
    const View camera = {Pose::look_at({0.75, 3, 0}, {0.75, 0, 0}, {0, 0, -1}).value(),
                         Projection::orthographic(0.75, 0.01, 0, 5)};
    RenderSettings settings = test_settings(600, 4);
    settings.layers = {Layer::visibility};
    const LayeredImage image = render(make_renderer(std::move(scene)), camera, settings);
    const std::span<const float> row = row_of(image, "visibility.light", 2);
    const auto place = [&](double alpha) {
      const std::vector<double> found = crossings(row, alpha);
      EXPECT_EQ(found.size(), 1U);
      return found.empty() ? 0 : found[0] / 600 * 1.5;
    };
    // Smoothstep is 0.104 at 0.2 of its width and 0.896 at 0.8.
    EXPECT_NEAR(place(0.896), 0.2 * width, 0.02) << width;
    EXPECT_NEAR(place(0.5), 0.5 * width, 0.02) << width;
    EXPECT_NEAR(place(0.104), 0.8 * width, 0.02) << width;
    EXPECT_NEAR((place(0.104) - place(0.896)) / 0.6, width, 0.02 * width + 0.004);
  }
}

// Row 101: the mean of depths is the depth of nothing. What it decides is what the mean, taken by hand, decides; and it
// lights pixels in shadow that percentage-closer filtering gets right.
TEST(ShadowMapOptions, AveragedDepthsLightWhatPercentageCloserFilteringKeepsDark) {
  // A sheet 1 m over a block 3 m over the floor, both with an edge at x = 0.
  const auto scene_with = [](ShadowFilter filter) {
    Scene scene;
    add_object(scene, "floor", floor(4));
    add_object(scene, "block", box({0.5F, 1.5F, 0}, {0.5F, 1.5F, 2}));
    Mesher mesh;
    mesh.quad({-0.02F, 4, 1}, {0.24F, 4, 1}, {0.24F, 4, -1}, {-0.02F, 4, -1});
    add_object(scene, "sheet", mesh.primitive);
    Light light = sun("light");
    light.fit = false;
    light.projection = Projection::orthographic(2, 2, 0, 20);
    light.shadow.resolution = 40;  // texels of 0.1 m, from whole tenths of a metre
    light.shadow.filter = filter;
    add_light(scene, light, {0, 8, 0}, {0, 0, 0}, {0, 0, -1});
    return scene;
  };
  const Renderer averaged = make_renderer(scene_with(ShadowFilter::averaged_depths));
  const View between = {Pose::look_at({0, 3.5, 0}, {0, 3, 0}, {0, 0, -1}).value(),
                        Projection::orthographic(0.2, 0.2, 0, 1)};
  RenderSettings settings = with_points(40, 40);
  const LayeredImage wrong = render(averaged, between, settings);
  const LayeredImage right =
      render(make_renderer(scene_with(ShadowFilter::percentage_closer)), between, settings);
  settings.shadows = ShadowTechnique::raytraced;
  Scene truth_scene = scene_with(ShadowFilter::refined);
  const LayeredImage truth = render(make_renderer(std::move(truth_scene)), between, settings);
  const LayeredImage map = averaged.depth_map("light").value();
  const View view = averaged.light_view("light").value();
  int corrected = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      if (at(wrong, "id.object", x, y) != 1) continue;
      const glm::dvec4 world(at(wrong, "P.X", x, y), at(wrong, "P.Y", x, y), at(wrong, "P.Z", x, y), 1);
      const glm::dvec4 q = view.image_from_world() * world;
      const int i = static_cast<int>(q.x * map.width);
      const int j = static_cast<int>(q.y * map.height);
      double mean = 0;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) mean += at(map, "Z", i + dx, j + dy) / 9;
      }
      const double distance = -(view.view_from_world() * world).z;
      ASSERT_GT(std::abs(distance - mean), 0.1);  // no matter of bias
      const float alpha = at(wrong, "visibility.light", x, y);
      ASSERT_EQ(alpha, distance < mean ? 1 : 0) << x << ", " << y;
      const bool is_lit = at(truth, "visibility.light", x, y) == 1;
      const bool is_right = (at(right, "visibility.light", x, y) >= 0.5F) == is_lit;
      corrected += alpha == 1 && !is_lit && is_right ? 1 : 0;
    }
  }
  EXPECT_GT(corrected, 20);
}

// Row 46: 128 or 256 texels in a window of 512. The mean distance of a shadow's edge from where it belongs, over 16 places
// within a texel, halves with the texel.
TEST(ShadowMapOptions, EdgesMoveHalfAsFarWithTexelsHalfAsWide) {
  for (const ShadowFilter filter : {ShadowFilter::nearest, ShadowFilter::bilinear}) {
    std::vector<double> errors;
    for (const int size : {64, 128, 256, 512}) {
      const double texel = 4.0 / size;
      double sum = 0;
      for (int offset = 0; offset < 16; ++offset) {
        const double edge = texel * (offset + 0.5) / 16;
        Scene scene;
        add_object(scene, "floor", floor(1.9F));
        Mesher mesh;
        const auto x = static_cast<float>(edge);
        mesh.quad({-1, 1, 1}, {x, 1, 1}, {x, 1, -1}, {-1, 1, -1});
        const int sheet = add_object(scene, "sheet", mesh.primitive);
        scene.nodes[static_cast<std::size_t>(sheet)].visible = false;
        Light light = sun("light");
        light.fit = false;
        light.projection = Projection::orthographic(2, 2, 0, 10);
        light.shadow.resolution = size;
        light.shadow.filter = filter;
        add_light(scene, light, {0, 5, 0}, {0, 0, 0}, {0, 0, -1});
        const View camera = {Pose::look_at({0, 2, 0}, {0, 0, 0}, {0, 0, -1}).value(),
                             Projection::orthographic(0.25, 0.01, 0, 3)};
        RenderSettings settings = test_settings(512, 4);
        settings.layers = {Layer::visibility};
        const LayeredImage image = render(make_renderer(std::move(scene), 1), camera, settings);
        const std::vector<double> found = crossings(row_of(image, "visibility.light", 2), 0.5);
        ASSERT_EQ(found.size(), 1U);
        sum += std::abs(found[0] - (edge / 0.5 + 0.5) * 512) / 16;
      }
      errors.push_back(sum);
      // An edge lies anywhere within half a texel of where it is drawn: a quarter in the mean.
      EXPECT_NEAR(errors.back(), 0.25 * texel / 0.5 * 512, 0.05 * texel / 0.5 * 512) << size;
    }
    for (std::size_t i = 1; i < errors.size(); ++i) EXPECT_NEAR(errors[i - 1] / errors[i], 2, 0.2) << i;
  }
}

TEST(ShadowMapOptions, SameBitsOnEverySetAndForEveryNumberOfThreads) {
  std::vector<ShadowSettings> all(4);
  all[0].filter = ShadowFilter::averaged_depths;
  all[0].kernel = 5;
  all[1].depth = ShadowDepth::radial;
  all[1].constant_bias = 0.01;
  all[2].soft_edge = 0.3;
  all[3].filter = ShadowFilter::averaged_depths;
  all[3].depth = ShadowDepth::radial;
  all[3].soft_edge = 0.1;
  all[3].outside_is_lit = false;
  for (const ShadowSettings& shadow : all) {
    const ShadowScene shown = under_a_wide_projector(shadow);
    const RenderSettings settings = with_points(96, 72);
    const LayeredImage first =
        render(make_renderer(shown.scene, 1, InstructionSet::scalar), shown.camera, settings);
    for (const InstructionSet set : supported_instruction_sets()) {
      const LayeredImage other = render(make_renderer(shown.scene, 2, set), shown.camera, settings);
      EXPECT_EQ(count_different_pixels(first, other), 0U) << name_of(set);
    }
  }
}

}  // namespace
}  // namespace laterna
