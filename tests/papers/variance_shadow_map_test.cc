// Donnelly and Lauritzen, Variance shadow maps, 2006; Lauritzen and McCool, Layered variance shadow maps, 2008.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "laterna/instruction_set.h"
#include "reference/picture_probes.h"
#include "reference/shadow_scenes.h"
#include "reference/shadow_truth.h"

namespace laterna {
namespace {

using namespace reference;

RenderSettings variance_settings(int width, int height) {
  RenderSettings settings = test_settings(width, height);
  settings.shadows = ShadowTechnique::variance;
  settings.layers = {Layer::visibility};
  return settings;
}

// A high sheet with its edge at x = 0, 9 m up, and a low one 1 m over all of the floor. The largest α on the floor under
// both, which no light reaches.
double light_that_bleeds(ShadowMoments moments, float reduction) {
  Scene scene;
  add_object(scene, "floor", floor(4));
  add_object(scene, "low", floor(3, 1));
  Mesher mesh;
  mesh.quad({-3, 9, 3}, {0, 9, 3}, {0, 9, -3}, {-3, 9, -3});
  add_object(scene, "high", mesh.primitive);
  Light light = sun("light");
  light.shadow.resolution = 512;
  light.shadow.moments = moments;
  light.shadow.bleeding_reduction = reduction;
  light.shadow.blur = 4;
  add_light(scene, light, {0, 20, 0}, {0, 0, 0}, {0, 0, -1});
  const View between = {Pose::look_at({0, 0.5, 0}, {0, 0, 0}, {0, 0, -1}).value(),
                        Projection::orthographic(1, 0.01, 0, 1)};
  const LayeredImage image = render(make_renderer(std::move(scene)), between, variance_settings(800, 8));
  const std::span<const float> alpha = values_of(image, "visibility.light");
  return *std::max_element(alpha.begin(), alpha.end());
}

// Of depths 1 m (share p) and 9 m, at a receiver 10 m deep, σ² = 64 p (1 − p) and t − μ = 1 + 8 p: at p = 0.1 Chebyshev's
// bound is 5.76 / (5.76 + 3.24) = 0.64, and nowhere more.
TEST(VarianceShadowMap, LightBleedsUnderTwoCastersAsChebyshevAllowsAndNotWhereItIsReduced) {
  const double unreduced = light_that_bleeds(ShadowMoments::variance, 0);
  EXPECT_NEAR(unreduced, 0.64, 0.01);
  EXPECT_NEAR(light_that_bleeds(ShadowMoments::variance, 0.4F), (0.64 - 0.4) / 0.6, 0.02);
  EXPECT_EQ(light_that_bleeds(ShadowMoments::variance, 0.7F), 0);
  // Exponentials put what is far behind out of reach; what is left is the least variance, a quarter of a texel's.
  EXPECT_LT(light_that_bleeds(ShadowMoments::exponential, 0), 2e-3);
  EXPECT_EQ(light_that_bleeds(ShadowMoments::exponential, 0.2F), 0);
}

// Every light that has maps: edges lie where rays say, and surfaces do not shade themselves.
TEST(VarianceShadowMap, AgreesWithRaysBesideItsBlur) {
  for (const LightType type :
       {LightType::directional, LightType::spot, LightType::projector, LightType::point}) {
    for (const ShadowMoments moments : {ShadowMoments::variance, ShadowMoments::exponential}) {
      ShadowScene shown = sphere_over_plane(4.0 / 3);
      Light& light = shown.scene.lights[0];
      light.type = type;
      light.projection = Projection::perspective(Angle::degrees(50), 1, 0.1, 100);
      light.shadow.moments = moments;
      RenderSettings settings = test_settings(320, 240);
      settings.shadows = ShadowTechnique::variance;
      const ShadowErrors errors = find_shadow_errors(
          draw_shadow_masks(make_renderer(shown.scene), shown.camera, settings, "light", 3));
      SCOPED_TRACE(to_string(errors));
      SCOPED_TRACE(static_cast<int>(type));
      EXPECT_LT(errors.farthest_false_dark, 6);
      EXPECT_LT(errors.farthest_false_lit, 6);
      EXPECT_LT(errors.wrong_share(), 0.005);
      EXPECT_GT(errors.pixels, 20000);
    }
  }
}

// Lit ground stays lit, however the light falls on it.
TEST(VarianceShadowMap, PlainGroundIsLitWholly) {
  for (const double height : {0.3, 1.0, 10.0}) {
    for (const ShadowMoments moments : {ShadowMoments::variance, ShadowMoments::exponential}) {
      Scene scene;
      add_object(scene, "floor", floor(4));
      Light light = sun("light");
      light.shadow.resolution = 512;
      light.shadow.moments = moments;
      light.shadow.bleeding_reduction = 0;
      add_light(scene, light, {1.3, height, 0.7}, {0, 0, 0});
      const View above = {Pose::look_at({0, 1, 0}, {0, 0, 0}, {0, 0, -1}).value(),
                          Projection::orthographic(3.5, 3.5, 0, 2)};
      const LayeredImage image = render(make_renderer(std::move(scene)), above, variance_settings(100, 100));
      for (const float alpha : values_of(image, "visibility.light")) ASSERT_GT(alpha, 0.99F) << height;
    }
  }
}

// A wider blur makes a wider edge: α rises over twice its reach.
TEST(VarianceShadowMap, TheBlurSetsTheEdgesWidth) {
  double before = 0;
  for (const float blur : {0.0F, 2.0F, 8.0F}) {
    Scene scene;
    add_object(scene, "floor", floor(4));
    Mesher mesh;
    mesh.quad({-3, 1, 3}, {0, 1, 3}, {0, 1, -3}, {-3, 1, -3});
    scene.nodes[static_cast<std::size_t>(add_object(scene, "sheet", mesh.primitive))].visible = false;
    Light light = sun("light");
    light.shadow.resolution = 512;
    light.shadow.blur = blur;
    light.shadow.bleeding_reduction = 0;
    add_light(scene, light, {0, 20, 0}, {0, 0, 0}, {0, 0, -1});
    const View above = {Pose::look_at({0, 5, 0}, {0, 0, 0}, {0, 0, -1}).value(),
                        Projection::orthographic(0.3, 0.01, 0, 10)};
    const LayeredImage image = render(make_renderer(std::move(scene)), above, variance_settings(600, 8));
    const std::span<const float> row = row_of(image, "visibility.light", 4);
    const double texels = (crossings(row, 0.95)[0] - crossings(row, 0.05)[0]) * 0.6 / 600 / (8.0 / 508);
    EXPECT_GT(texels, before);
    EXPECT_LT(texels, 2 * (blur + 1));
    before = texels + 0.5 * blur;
  }
}

TEST(VarianceShadowMap, SameBitsOnEverySetAndForEveryNumberOfThreads) {
  for (const LightType type : {LightType::directional, LightType::point, LightType::spot}) {
    for (const ShadowMoments moments : {ShadowMoments::variance, ShadowMoments::exponential}) {
      ShadowScene shown = torus_and_box(4.0 / 3);
      Light& light = shown.scene.lights[0];
      light.type = type;
      light.shadow.resolution = 200;
      light.shadow.moments = moments;
      if (type == LightType::point) light.shadow.depth = ShadowDepth::radial;
      const RenderSettings settings = variance_settings(96, 72);
      const LayeredImage first =
          render(make_renderer(shown.scene, 1, InstructionSet::scalar), shown.camera, settings);
      for (const InstructionSet set : supported_instruction_sets()) {
        for (const int threads : {1, 3}) {
          const LayeredImage other = render(make_renderer(shown.scene, threads, set), shown.camera, settings);
          EXPECT_EQ(count_different_pixels(first, other), 0U)
              << name_of(set) << ", " << threads << " threads";
        }
      }
    }
  }
}

// Extremes of size and nothing to see.
TEST(VarianceShadowMap, TinyMapsAndEmptyScenesAreNoTrouble) {
  for (const int resolution : {1, 2, 17}) {
    Scene scene;
    add_object(scene, "floor", floor(4));
    scene.nodes[0].casts_shadow = false;
    Light light = spot("light", 40);
    light.shadow.resolution = resolution;
    add_light(scene, light, {0, 5, 0}, {0, 0, 0}, {0, 0, -1});
    const View above = look({0, 4, 0.1}, {0, 0, 0}, 30, 1, {0, 0, -1});
    for (const ShadowTechnique technique : {ShadowTechnique::variance, ShadowTechnique::pcss}) {
      scene.lights[0].source.radius = 0.2;
      RenderSettings settings = variance_settings(32, 32);
      settings.shadows = technique;
      const LayeredImage image = render(make_renderer(scene), above, settings);
      for (const float alpha : values_of(image, "visibility.light")) ASSERT_EQ(alpha, 1);
    }
  }
}

}  // namespace
}  // namespace laterna
