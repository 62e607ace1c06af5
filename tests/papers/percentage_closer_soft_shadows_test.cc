// Fernando, Percentage-closer soft shadows, 2005: penumbrae as wide as the light's size makes them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "laterna/instruction_set.h"
#include "reference/picture_probes.h"
#include "reference/shadow_scenes.h"
#include "reference/soft_truth.h"

namespace laterna {
namespace {

using namespace reference;

// The share of a disc on one side of a line `t` radii from its middle.
double disc_share(double t) { return 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / 3.14159265358979; }

// A sheet whose edge is the line x = 0 at `height` over a floor, dark where x < 0.
Scene sheet_over_floor(float height) {
  Scene scene;
  add_object(scene, "floor", floor(4));
  Mesher mesh;
  mesh.quad({-3, height, 3}, {0, height, 3}, {0, height, -3}, {-3, height, -3});
  add_object(scene, "sheet", mesh.primitive);
  return scene;
}

// α along x on the floor, from `middle` − `width`/2 to `middle` + `width`/2.
std::vector<float> floor_profile(const Renderer& renderer, double middle, double width) {
  const View view = {Pose::look_at({middle, 0.5, 0}, {middle, 0, 0}, {0, 0, -1}).value(),
                     Projection::orthographic(width / 2, width / 200, 0, 1)};
  RenderSettings settings = test_settings(1000, 10);
  settings.shadows = ShadowTechnique::pcss;
  settings.layers = {Layer::visibility};
  const LayeredImage image = render(renderer, view, settings);
  const std::span<const float> row = row_of(image, "visibility.light", 5);
  return {row.begin(), row.end()};
}

// Where a profile crosses α = share, in metres.
double place_of(const std::vector<float>& profile, double middle, double width, double share) {
  const std::vector<double> found = crossings(profile, share);
  EXPECT_EQ(found.size(), 1U) << share;
  return found.empty() ? 0 : middle + (found[0] / static_cast<double>(profile.size()) - 0.5) * width;
}

// The sun is 0.53° wide; 10 m under an edge it leaves a penumbra of 2 · 10 m · tan 0.265° = 92.5 mm.
TEST(PercentageCloserSoftShadows, TheSunsPenumbraUnderAnEdgeTenMetresUp) {
  Scene scene = sheet_over_floor(10);
  Light light = sun("light");
  light.source.angular_diameter = Angle::degrees(0.53);
  add_light(scene, light, {0, 20, 0}, {0, 0, 0}, {0, 0, -1});
  const std::vector<float> profile = floor_profile(make_renderer(std::move(scene)), 0, 0.2);
  const double expected = 2 * 10 * std::tan(0.265 * 3.14159265358979 / 180);
  EXPECT_NEAR(expected, 0.0925, 0.0001);
  // Nearly from where nothing arrives to where all does: 2 % of the disc are seen beside a line 0.895 radii off.
  EXPECT_NEAR(disc_share(0.895), 0.98, 0.001);
  const double width = (place_of(profile, 0, 0.2, 0.98) - place_of(profile, 0, 0.2, 0.02)) / 0.895;
  EXPECT_NEAR(width, expected, 0.05 * expected);
  // And in between as a disc is uncovered.
  for (const double t : {-0.6, -0.3, 0.0, 0.3, 0.6}) {
    EXPECT_NEAR(place_of(profile, 0, 0.2, disc_share(t)), 0.5 * expected * t, 0.05 * expected) << t;
  }
}

// A ball of radius R over an edge: the penumbra ends where the two planes touch that go through the edge and touch the ball.
TEST(PercentageCloserSoftShadows, ABallsPenumbraEndsWhereItsTangentsDo) {
  constexpr double kHeight = 1, kRadius = 0.15;
  for (const LightType type : {LightType::point, LightType::spot, LightType::projector}) {
    // From above; aslant; and so that the penumbra lies where two faces of a point light's cube meet.
    for (const glm::dvec3 position : {glm::dvec3(0, 3, 0), glm::dvec3(-1, 3, 0.5), glm::dvec3(-2, 3, 0)}) {
      SCOPED_TRACE(static_cast<int>(type));
      SCOPED_TRACE(position.x);
      Scene scene = sheet_over_floor(kHeight);
      Light light = spot("light", 60);
      light.type = type;
      light.projection = Projection::perspective(Angle::degrees(75), 1, 0.1, 100);
      light.source.radius = kRadius;
      light.shadow.resolution = 2048;
      add_light(scene, light, position, {0, 0, 0}, {0, 0, -1});
      const double distance = std::hypot(position.x, position.y - kHeight);
      const double middle_angle = std::atan2(-position.x, position.y - kHeight);
      const double half_angle = std::asin(kRadius / distance);
      const double first = kHeight * std::tan(middle_angle - half_angle);
      const double last = kHeight * std::tan(middle_angle + half_angle);
      const double middle = 0.5 * (first + last);
      const double range = 1.6 * (last - first);
      const std::vector<float> profile = floor_profile(make_renderer(std::move(scene)), middle, range);
      const double width = last - first;
      // 2 % of the disc lie beyond a line 0.895 radii off, which is 5.25 % of its width.
      EXPECT_NEAR(place_of(profile, middle, range, 0.02), first + 0.0525 * width, 0.05 * width);
      EXPECT_NEAR(place_of(profile, middle, range, 0.98), last - 0.0525 * width, 0.05 * width);
      EXPECT_NEAR(place_of(profile, middle, range, 0.5), kHeight * std::tan(middle_angle), 0.05 * width);
    }
  }
}

// A rectangle is uncovered at an even rate by an edge along its side.
TEST(PercentageCloserSoftShadows, ARectanglesPenumbraIsARamp) {
  Scene scene = sheet_over_floor(1);
  Light light = spot("light", 60);
  light.source.width = 0.4;
  light.source.height = 0.1;
  add_light(scene, light, {0, 3, 0}, {0, 0, 0}, {0, 0, -1});
  const std::vector<float> profile = floor_profile(make_renderer(std::move(scene)), 0, 0.4);
  const double width = 0.4 * 1 / (3 - 1);
  for (const double share : {0.1, 0.25, 0.5, 0.75, 0.9}) {
    EXPECT_NEAR(place_of(profile, 0, 0.4, share), (share - 0.5) * width, 0.05 * width) << share;
  }
}

// A light without size casts the shadows of `map`.
TEST(PercentageCloserSoftShadows, ALightWithoutSizeCastsTheMapsShadows) {
  const ShadowScene shown = torus_and_box(1);
  const Renderer renderer = make_renderer(shown.scene);
  RenderSettings settings = test_settings(160, 160);
  const LayeredImage map = render(renderer, shown.camera, settings);
  settings.shadows = ShadowTechnique::pcss;
  EXPECT_EQ(count_different_pixels(map, render(renderer, shown.camera, settings)), 0U);
}

LightSource ball(double radius) {
  LightSource source;
  source.radius = radius;
  return source;
}

struct Against {
  double rms = 0;      // over pixels on which the light falls
  double far_off = 0;  // share of pixels that are wrong by more than a quarter
  int penumbra = 0;    // pixels in it
  double penumbra_rms = 0;
};

Against errors_of(ShadowScene shown, const LightSource& source) {
  shown.scene.lights[0].source = source;
  RenderSettings settings = test_settings(240, 180);
  settings.shadows = ShadowTechnique::pcss;
  settings.layers = {Layer::visibility, Layer::object, Layer::lux};
  const LayeredImage image = render(make_renderer(shown.scene), shown.camera, settings);
  const std::vector<float> truth = soft_truth(shown.scene, shown.camera, settings, "light", 128);
  settings.shadows = ShadowTechnique::none;
  const LayeredImage unshaded = render(make_renderer(shown.scene), shown.camera, settings);
  const std::span<const float> alpha = values_of(image, "visibility.light");
  const std::span<const float> lux = values_of(unshaded, "lux.Y");
  const double brightest = *std::max_element(lux.begin(), lux.end());
  Against against;
  int count = 0;
  int far_off = 0;
  double sum = 0;
  double penumbra_sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (lux[i] <= 0) continue;
    // By the light that would fall there unshaded: where the surface turns away, half of the light has set, and the
    // other half hardly falls on it.
    const double error = (alpha[i] - truth[i]) * lux[i] / brightest;
    ++count;
    sum += error * error;
    far_off += std::abs(error) > 0.25 ? 1 : 0;
    if (truth[i] < 0.01F || truth[i] > 0.99F) continue;
    ++against.penumbra;
    penumbra_sum += error * error;
  }
  against.rms = std::sqrt(sum / count);
  against.penumbra_rms = std::sqrt(penumbra_sum / against.penumbra);
  against.far_off = static_cast<double>(far_off) / count;
  return against;
}

// Against the mean of rays to all of the light.
TEST(PercentageCloserSoftShadows, SimpleScenesAgreeWithRaysToAllOfTheLight) {
  LightSource disc;
  disc.angular_diameter = Angle::degrees(4);
  const Against sphere = errors_of(sphere_over_plane(4.0 / 3), disc);
  EXPECT_LT(sphere.rms, 0.005);
  EXPECT_LT(sphere.penumbra_rms, 0.03);
  EXPECT_LT(sphere.far_off, 0.0005);
  EXPECT_GT(sphere.penumbra, 400);
  const Against torus = errors_of(torus_and_box(4.0 / 3), ball(0.15));
  EXPECT_LT(torus.rms, 0.005);
  EXPECT_LT(torus.penumbra_rms, 0.03);
  EXPECT_LT(torus.far_off, 0.0005);
  EXPECT_GT(torus.penumbra, 400);
}

// Plain ground is lit wholly, and what touches it leaves no gap.
TEST(PercentageCloserSoftShadows, NoAcneAndNoGapAtContacts) {
  ShadowScene shown;
  add_object(shown.scene, "floor", floor(4));
  add_object(shown.scene, "box", box({0, 0.5F, 0}, {0.5F, 0.5F, 0.5F}));
  Light light = sun("light");
  light.source.angular_diameter = Angle::degrees(0.53);
  add_light(shown.scene, light, {4, 2, 0}, {0, 0, 0});
  // The floor on the far side of the box, down to the line where they touch.
  const View view = {Pose::look_at({-0.55, 0.4, 0}, {-0.55, 0, 0}, {0, 0, -1}).value(),
                     Projection::orthographic(0.05, 0.05, 0, 1)};
  RenderSettings settings = test_settings(100, 100);
  settings.shadows = ShadowTechnique::pcss;
  settings.layers = {Layer::visibility};
  const Renderer renderer = make_renderer(shown.scene);
  const LayeredImage dark = render(renderer, view, settings);
  for (const float alpha : values_of(dark, "visibility.light")) ASSERT_EQ(alpha, 0);
  const View bare = {Pose::look_at({2.3, 1, 0}, {2.3, 0, 0}, {0, 0, -1}).value(),
                     Projection::orthographic(1.6, 3, 0, 2)};
  const LayeredImage lit = render(renderer, bare, settings);
  for (const float alpha : values_of(lit, "visibility.light")) ASSERT_EQ(alpha, 1);
}

TEST(PercentageCloserSoftShadows, SameBitsOnEverySetAndForEveryNumberOfThreads) {
  for (const LightType type : {LightType::directional, LightType::point, LightType::spot}) {
    ShadowScene shown = torus_and_box(4.0 / 3);
    Light& light = shown.scene.lights[0];
    light.type = type;
    if (type == LightType::directional) {
      light.source.angular_diameter = Angle::degrees(3);
    } else if (type == LightType::point) {
      light.source.radius = 0.2;
    } else {
      light.source.width = 0.4, light.source.height = 0.1;
    }
    RenderSettings settings = test_settings(120, 90);
    settings.shadows = ShadowTechnique::pcss;
    settings.layers = {Layer::visibility};
    const LayeredImage first =
        render(make_renderer(shown.scene, 1, InstructionSet::scalar), shown.camera, settings);
    int partly = 0;
    for (const float alpha : values_of(first, "visibility.light")) partly += alpha > 0 && alpha < 1 ? 1 : 0;
    EXPECT_GT(partly, 200);
    for (const InstructionSet set : supported_instruction_sets()) {
      for (const int threads : {1, 3}) {
        const LayeredImage other = render(make_renderer(shown.scene, threads, set), shown.camera, settings);
        EXPECT_EQ(count_different_pixels(first, other), 0U) << name_of(set) << ", " << threads << " threads";
      }
    }
  }
}

TEST(PercentageCloserSoftShadows, AParallelProjectorHasNoSizeToSoftenWith) {
  Scene scene = sheet_over_floor(1);
  Light light = spot("light", 45);
  light.type = LightType::projector;
  light.projection = Projection::orthographic(1, 1, 0.1, 10);
  light.source.radius = 0.1;
  light.shadow.technique = ShadowTechnique::pcss;
  add_light(scene, light, {0, 3, 0}, {0, 0, 0}, {0, 0, -1});
  const std::vector<Diagnostic> faults = validate(scene);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].place, "lights[0].shadow.technique");
  EXPECT_EQ(faults[0].message,
            "\"pcss\" cannot serve a parallel projector with a size: all its light goes one way");
}

}  // namespace
}  // namespace laterna
