// Wikipedia, Shadow mapping (2010): the depth test and what is made of its answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "laterna/measure.h"
#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"
#include "reference/shadow_scenes.h"
#include "shadow/depth_comparison.h"

namespace laterna {
namespace {

using namespace reference;

constexpr ShadowFilter kFilters[] = {ShadowFilter::refined, ShadowFilter::nearest, ShadowFilter::bilinear,
                                     ShadowFilter::percentage_closer};

// Row 84: the table of row 29 through the whole renderer: a blocker at one distance, a wall at another.
TEST(WikipediaShadowMapping, WhatLiesBehindTheStoredDepthIsInShadow) {
  struct Row {
    float stored, tested;
    double bias;
    bool is_lit;
  };
  constexpr Row kTable[] = {{2, 3, 0, false},      {3, 2, 0, true},       {2, 2.25F, 0, false},
                            {2.25F, 2, 0, true},   {2, 2.25F, 0.5, true}, {2, 2.75F, 0.5, false},
                            {2, 2.25F, 0.2, false}};
  for (const bool is_perspective : {true, false}) {
    for (const Row& row : kTable) {
      Scene scene;
      const int blocker = add_object(scene, "blocker", wall(3, 3, -row.stored));
      add_object(scene, "wall", wall(3, 3, -row.tested));
      scene.nodes[static_cast<std::size_t>(blocker)].visible = false;
      Light light = projector("light", 0.3, 0.3);
      light.projection = is_perspective ? Projection::perspective(Angle::degrees(30), 1, 0.5, 10)
                                        : Projection::orthographic(1, 1, 0.5, 10);
      light.shadow.constant_bias = row.bias;
      light.shadow.resolution = 64;
      add_light(scene, light, {0, 0, 0}, {0, 0, -1});
      RenderSettings settings = papers_settings(8, 8);
      settings.layers = {Layer::visibility};
      const View camera = {Pose{}, Projection::orthographic(0.2, 0.2, 0, 10)};
      const LayeredImage image = render(make_renderer(std::move(scene)), camera, settings);
      EXPECT_EQ(at(image, "visibility.light", 4, 4), row.is_lit ? 1 : 0)
          << is_perspective << ": " << row.stored << " " << row.tested << " " << row.bias;
      EXPECT_EQ(shadow::is_lit(10 - row.stored, 10 - row.tested, static_cast<float>(row.bias)), row.is_lit);
    }
  }
}

// Row 85: beyond the map's four sides and its far plane, lit by default or shadowed.
TEST(WikipediaShadowMapping, OutsideTheMapIsLitOrShadowedAsAsked) {
  EXPECT_TRUE(ShadowSettings{}.outside_is_lit);
  for (const ShadowFilter filter : kFilters) {
    for (const bool outside_is_lit : {true, false}) {
      Scene scene;
      add_object(scene, "wall", wall(4, 4, 0));
      add_object(scene, "far wall", wall(1, 1, -20));  // beyond the far plane, inside the sides
      Light light = sun("light");
      light.fit = false;
      light.projection = Projection::orthographic(2, 2, 0.5, 10);
      light.shadow.filter = filter;
      light.shadow.outside_is_lit = outside_is_lit;
      light.shadow.resolution = 128;
      add_light(scene, light, {0, 0, 5}, {0, 0, 0});
      const Renderer renderer = make_renderer(scene);
      RenderSettings settings = test_settings(80, 80);
      settings.layers = {Layer::visibility};
      const LayeredImage image = render(renderer, square_on(4, 1), settings);
      const float outside = outside_is_lit ? 1 : 0;
      for (int i = 0; i < 80; ++i) {
        EXPECT_EQ(at(image, "visibility.light", i, 18), outside);
        EXPECT_EQ(at(image, "visibility.light", i, 61), outside);
        EXPECT_EQ(at(image, "visibility.light", 18, i), outside);
        EXPECT_EQ(at(image, "visibility.light", 61, i), outside);
        if (i > 21 && i < 58) {  // just within the four borders
          EXPECT_EQ(at(image, "visibility.light", i, 22), 1);
          EXPECT_EQ(at(image, "visibility.light", i, 57), 1);
          EXPECT_EQ(at(image, "visibility.light", 22, i), 1);
          EXPECT_EQ(at(image, "visibility.light", 57, i), 1);
        }
      }
      const View behind = {Pose::look_at({0, 0, -10}, {0, 0, -20}, {0, 1, 0}).value(),
                           Projection::orthographic(0.5, 0.5, 0, 20)};
      const LayeredImage far = render(renderer, behind, settings);
      EXPECT_EQ(at(far, "visibility.light", 40, 40), outside);
    }
  }
}

// A half plane's shadow seen from below the sheet, where a texel of the map is exactly ten pixels wide.
LayeredImage edge_of_half_plane(const ShadowSettings& settings, double edge) {
  Scene scene;
  add_object(scene, "floor", floor(3));
  Mesher mesh;
  const auto x = static_cast<float>(edge);
  mesh.quad({-2, 1, 2}, {x, 1, 2}, {x, 1, -2}, {-2, 1, -2});
  add_object(scene, "sheet", mesh.primitive);
  Light light = sun("light");
  light.fit = false;
  light.projection = Projection::orthographic(2, 2, 0, 20);
  light.shadow = settings;
  light.shadow.resolution = 40;  // 0.1 m
  add_light(scene, light, {0, 5, 0}, {0, 0, 0}, {0, 0, -1});
  const View below = {Pose::look_at({0, 0.5, 0}, {0, 0, 0}, {0, 0, -1}).value(),
                      Projection::orthographic(0.5, 0.5, 0, 1)};
  RenderSettings wanted = test_settings(100, 100);
  wanted.layers = {Layer::visibility};
  return render(make_renderer(std::move(scene)), below, wanted);
}

// Row 86: nearest is a staircase of texels, filtered comparison a ramp.
TEST(WikipediaShadowMapping, NearestIsAStaircaseAndFilteredComparisonARamp) {
  ShadowSettings settings;
  settings.filter = ShadowFilter::nearest;
  // The edge may lie anywhere in a texel: the shadow's edge does not move until it passes a texel's centre.
  for (const double edge : {0.06, 0.1, 0.14}) {
    const LayeredImage image = edge_of_half_plane(settings, edge);
    const std::vector<double> step = crossings(row_of(image, "visibility.light", 50), 0.5);
    ASSERT_EQ(step.size(), 1U);
    EXPECT_DOUBLE_EQ(step[0], 60);  // texels begin at whole tenths of a metre, each ten pixels
    for (const float alpha : values_of(image, "visibility.light")) ASSERT_TRUE(alpha == 0 || alpha == 1);
  }
  settings.filter = ShadowFilter::bilinear;
  const LayeredImage image = edge_of_half_plane(settings, 0.1);
  const std::span<const float> ramp = row_of(image, "visibility.light", 50);
  // From the last shadowed texel's centre, 0.05 m, to the first lit one's, 0.15 m: pixels 55 to 65, by 1/10 each.
  for (int x = 0; x < 100; ++x) {
    const double expected = std::clamp((x + 0.5 - 55) / 10, 0.0, 1.0);
    EXPECT_NEAR(ramp[static_cast<std::size_t>(x)], expected, 1e-3) << x;
  }
}

// Row 88: a texture on lit regions only: the projector with shadows.
TEST(WikipediaShadowMapping, ASlideFallsOnLitRegionsOnly) {
  ShadowScene shown = torus_and_box(4.0 / 3);
  const int slide = add_linear_picture(shown.scene, 32, 32, [](int x, int y) {
    return glm::vec3((x / 2 + y / 2) % 2 == 0 ? 0.9F : 0.3F, static_cast<float>(x) / 32,
                     static_cast<float>(y) / 32);
  });
  shown.scene.lights[0] = projector("light", 0.5, 0.5, slide);
  const Renderer renderer = make_renderer(shown.scene);
  for (const ShadingModel model : {ShadingModel::papers, ShadingModel::phong, ShadingModel::pbr}) {
    RenderSettings settings = test_settings(160, 120);
    settings.shading = model;
    settings.layers = {Layer::visibility};
    const LayeredImage image = render(renderer, shown.camera, settings);
    settings.shadows = ShadowTechnique::none;
    const LayeredImage slide_alone = render(renderer, shown.camera, settings);
    int partly = 0;
    for (const char* channel : {"R", "G", "B"}) {
      for (std::size_t i = 0; i < image.channels[0].values.size(); ++i) {
        const float alpha = values_of(image, "visibility.light")[i];
        const float unshadowed = values_of(slide_alone, channel)[i];
        // α multiplies what arrives, so rounding differs by a few units in the last place.
        ASSERT_NEAR(values_of(image, channel)[i], unshadowed * alpha, 1e-6 * (1 + unshadowed));
        partly += alpha > 0 && alpha < 1 ? 1 : 0;
      }
    }
    EXPECT_GT(partly, 30);
  }
}

// Row 89: the depth map thrown back on the scene: every lit surface shows its own depth.
TEST(WikipediaShadowMapping, TheProjectedDepthMapShowsLitSurfacesTheirOwnDepth) {
  ShadowScene shown = torus_and_box(4.0 / 3);
  const Renderer renderer = make_renderer(shown.scene);
  const RenderSettings settings = test_settings(200, 150);
  const LayeredImage picture = projected_depth(renderer, shown.camera, settings, "light").value();
  RenderSettings seen = settings;
  seen.shadows = ShadowTechnique::raytraced;
  seen.layers = {Layer::visibility, Layer::position, Layer::object};
  const LayeredImage image = render(renderer, shown.camera, seen);

  // The ramp's ends, from the map; grey is linear between them.
  const LayeredImage map = renderer.depth_map("light").value();
  const LayeredImage ramp = depth_picture(map).value();
  std::pair<double, double> nearest = {1e9, 0};
  std::pair<double, double> farthest = {0, 0};
  for (std::size_t i = 0; i < map.channels[0].values.size(); ++i) {
    const double z = map.channels[0].values[i];
    if (std::isinf(z)) continue;
    nearest = std::min(nearest, {z, values_of(ramp, "R")[i]});
    if (z > farthest.first) farthest = {z, values_of(ramp, "R")[i]};
  }
  const View view = renderer.light_view("light").value();
  int lit = 0;
  int agree = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (at(image, "id.object", x, y) < 0 || at(image, "visibility.light", x, y) != 1) continue;
      const glm::dvec4 world(at(image, "P.X", x, y), at(image, "P.Y", x, y), at(image, "P.Z", x, y), 1);
      const glm::dvec4 q = view.image_from_world() * world;
      if (q.x < 0 || q.y < 0 || q.x >= q.w || q.y >= q.w) continue;
      const double distance = -(view.view_from_world() * world).z;
      // On a contour of constant depth the grey is constant: it is a function of the depth alone.
      const double share = (distance - nearest.first) / (farthest.first - nearest.first);
      const double expected = nearest.second + (farthest.second - nearest.second) * share;
      ++lit;
      agree += std::abs(at(picture, "R", x, y) - expected) < 0.01 ? 1 : 0;
    }
  }
  EXPECT_GT(lit, 5000);
  EXPECT_GT(agree, 0.99 * lit);  // all but texels that straddle an edge
}

// Row 90: one pass, or the shadowed scene first and each light's part added to it: the same image.
TEST(WikipediaShadowMapping, OnePassAndSeveralGiveTheSameImage) {
  ShadowScene shown = torus_and_box(4.0 / 3);
  shown.scene.ambient = glm::vec3(0.2F);
  shown.scene.ambient_is_set = true;
  add_light(shown.scene, sun("sun"), {-2, 5, 1}, {0, 0, 0});
  const Renderer renderer = make_renderer(shown.scene);
  for (const ShadingModel model : {ShadingModel::papers, ShadingModel::phong, ShadingModel::pbr}) {
    RenderSettings settings = test_settings(160, 120);
    settings.shading = model;
    const LayeredImage single = render(renderer, shown.camera, settings);
    settings.passes = Passes::multi;
    settings.layers = {Layer::passes};
    const LayeredImage multi = render(renderer, shown.camera, settings);
    EXPECT_EQ(count_different_pixels(single, multi), 0U);
    // The last pass is the picture; before it, the shadowed scene with the lights so far.
    EXPECT_TRUE(std::ranges::equal(values_of(multi, "pass.3.sun.c.R"), values_of(single, "R")));
    std::size_t brighter = 0;
    for (std::size_t i = 0; i < single.channels[0].values.size(); ++i) {
      const float before = values_of(multi, "pass.1.c.R")[i];
      const float after = values_of(multi, "pass.3.light.c.R")[i];
      ASSERT_GE(after, before);
      brighter += after > before ? 1U : 0U;
    }
    EXPECT_GT(brighter, 3000U);
  }
}

}  // namespace
}  // namespace laterna
