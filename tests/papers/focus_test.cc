// Projectors with a lens: what is out of focus, by the accumulation buffer (Haeberli and Akeley, The accumulation buffer:
// hardware support for high-quality rendering, 1990) and by discs of the slide. docs/focus.md has the equation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "laterna/instruction_set.h"
#include "laterna/technique_choice.h"
#include "light/light_samples.h"
#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"

namespace laterna {
namespace {

using namespace reference;

constexpr double kRadius = 0.1, kFocus = 4, kPi = 3.14159265358979323846;
constexpr int kSide = 101;  // pixels of the pictures, and of slides: the middle one is on the axis

// A projector at z = 4 … 10 m before a wall at z = 0.
Scene slide_on_wall(double distance, double half_width, int slide_side,
                    const std::function<float(int, int)>& slide, Aperture aperture) {
  Scene scene;
  add_object(scene, "wall", wall(20, 20, 0));
  Light light = projector("projector", half_width, half_width,
                          add_linear_picture(scene, slide_side, slide_side,
                                             [&](int x, int y) { return glm::vec3(slide(x, y)); }));
  light.aperture = aperture;
  add_light(scene, light, {0, 0, distance}, {0, 0, 0});
  return scene;
}

// One pixel in the middle of a slide whose pixels are 6 mm wide at 6 m, 4 mm at 4 m.
Scene dot_on_wall(double distance) {
  constexpr int kMiddle = kSide / 2;
  return slide_on_wall(distance, 0.05, kSide,
                       [](int x, int y) { return x == kMiddle && y == kMiddle ? 100.0F : 0.0F; },
                       {kRadius, kFocus});
}

// `half` metres to each side of `centre`.
LayeredImage picture_of(const Scene& scene, double half, int pictures, RenderStatistics* statistics = nullptr,
                        ShadowTechnique shadows = ShadowTechnique::none, glm::dvec2 centre = {0, 0}) {
  RenderSettings settings = papers_settings(kSide, kSide);
  settings.accumulate = pictures;
  settings.samples = pictures == 1 ? 4 : 1;
  settings.shadows = shadows;
  return *make_renderer(scene).render(square_on(half, 1, centre), settings, {}, statistics);
}

double sum_of(const LayeredImage& image) {
  const auto values = values_of(image, "G");
  return std::accumulate(values.begin(), values.end(), 0.0);
}

// The diameter of a disc of light at half of its height: of its area at half of the mean of its inner half.
double diameter_at_half_maximum(const LayeredImage& image, double half, double expected) {
  const double pixel = 2 * half / kSide;
  const auto values = values_of(image, "G");
  const auto distance = [&](std::size_t i) {
    const int x = static_cast<int>(i) % kSide - kSide / 2, y = static_cast<int>(i) / kSide - kSide / 2;
    return std::hypot(x, y) * pixel;
  };
  double height = 0, inside = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (distance(i) > expected / 4) continue;
    height += values[i];
    ++inside;
  }
  height /= inside;
  const auto bright = std::count_if(values.begin(), values.end(), [&](float v) { return v > height / 2; });
  return 2 * std::sqrt(static_cast<double>(bright) * pixel * pixel / kPi);
}

// Row 13: 2 · 0.1 · |6 − 4| / 4 = 0.10 m within 3 %, by many points of the lens and by discs.
TEST(Focus, ADotSpreadsToItsCircleOfConfusion) {
  for (const double distance : {6.0, 3.0}) {
    const double expected = 2 * kRadius * std::abs(distance - kFocus) / kFocus;
    const Scene scene = dot_on_wall(distance);
    for (const int pictures : {1, 512}) {
      const LayeredImage image = picture_of(scene, 0.08, pictures);
      EXPECT_NEAR(diameter_at_half_maximum(image, 0.08, expected), expected, 0.03 * expected)
          << distance << " m, " << pictures << " pictures";
    }
  }
}

// Row 13: unblurred at the focal distance: the picture through a pinhole, bit for bit where it is drawn by discs, and to
// rounding from all points of the lens.
TEST(Focus, AtTheFocalDistanceNothingIsBlurred) {
  Scene scene = dot_on_wall(kFocus);
  const LayeredImage wide = picture_of(scene, 0.016, 1);
  const LayeredImage accumulated = picture_of(scene, 0.016, 16);
  scene.lights[0].aperture = {};
  EXPECT_EQ(count_different_pixels(wide, picture_of(scene, 0.016, 1)), 0U);
  const LayeredImage pinhole = picture_of(scene, 0.016, 16);
  EXPECT_GT(*std::ranges::max_element(values_of(pinhole, "G")), 90.0F);
  double error = 0;
  for (std::size_t i = 0; i < values_of(pinhole, "G").size(); ++i)
    error = std::max<double>(error, std::abs(values_of(pinhole, "G")[i] - values_of(accumulated, "G")[i]));
  EXPECT_LT(error, 0.05) << "of 100";
}

// Every point of the lens throws the slide on the same place of the plane in focus, and elsewhere R |d − f| / f away.
TEST(Focus, PointsOfTheLensMeetInFocus) {
  const OwnedFrame owned = make_frame(dot_on_wall(6));
  const frame::PlacedLight& placed = owned.frame.lights[0];
  glm::dvec2 mean(0);
  double widest = 0;
  constexpr int kCount = 64;
  for (int i = 0; i < kCount; ++i) {
    const frame::PlacedLight moved = light::at_sample(placed, {i, kCount});
    const auto slide_place = [&](glm::dvec4 p) {
      const glm::dvec4 at = moved.view.image_from_world() * p;
      return glm::dvec2(at.x, at.y) / at.w;
    };
    const glm::dvec2 sharp = slide_place({0.3, -0.2, 2, 1});  // 4 m before the lens, at tangents 0.075, −0.05
    EXPECT_NEAR(sharp.x, 0.5 + 0.075 / 0.1, 1e-12);
    EXPECT_NEAR(sharp.y, 0.5 + 0.05 / 0.1, 1e-12);
    const glm::dvec2 blurred = (slide_place({0, 0, 0, 1}) - 0.5) * 0.1 * 6.0;  // metres on the wall
    mean += blurred / static_cast<double>(kCount);
    widest = std::max(widest, std::hypot(blurred.x, blurred.y));
    EXPECT_EQ(moved.intensity, placed.intensity);
  }
  EXPECT_NEAR(widest, 0.05, 0.0005);
  EXPECT_LT(std::hypot(mean.x, mean.y), 0.001);
}

// What a slide of stripes, discs and a gradient throws out of focus: its mean over the lens, and how the discs differ.
Scene pattern_on_wall(double distance, double radius = 0.05) {
  return slide_on_wall(distance, 0.25, 256,
                       [](int x, int y) {
                         const double r = std::hypot(x - 180, y - 80);
                         return static_cast<float>(r < 40 ? 1.0 : x < 96 ? (x / 8) % 2 : y / 256.0);
                       },
                       {radius, kFocus});
}

double rms_difference(const LayeredImage& a, const LayeredImage& b) {
  const auto va = values_of(a, "G"), vb = values_of(b, "G");
  double squares = 0;
  for (std::size_t i = 0; i < va.size(); ++i) squares += (va[i] - vb[i]) * (va[i] - vb[i]);
  return std::sqrt(squares / static_cast<double>(va.size()));
}

double largest_difference(const LayeredImage& a, const LayeredImage& b) {
  const auto va = values_of(a, "G"), vb = values_of(b, "G");
  double largest = 0;
  for (std::size_t i = 0; i < va.size(); ++i) largest = std::max<double>(largest, std::abs(va[i] - vb[i]));
  return largest;
}

// Noise falls as 1/√N or better, and is about what is reported.
TEST(Focus, NoiseFallsWithTheNumberOfPictures) {
  const Scene scene = pattern_on_wall(6);
  const LayeredImage truth = picture_of(scene, 1.6, 512);
  const double mean = sum_of(truth) / (kSide * kSide);
  double last = 0;
  for (const int pictures : {8, 32, 128}) {
    RenderStatistics statistics;
    const LayeredImage image = picture_of(scene, 1.6, pictures, &statistics);
    const double error = rms_difference(image, truth) / mean;
    EXPECT_EQ(statistics.pictures, pictures);
    EXPECT_LT(error, 2 * statistics.noise) << pictures;
    if (last > 0) {
      EXPECT_LT(error, 0.5 * last) << pictures;
    }
    last = error;
  }
}

// The fast path against the truth, beyond and before the focus and about it. docs/focus.md states these numbers.
TEST(Focus, DiscsOfTheSlideAreTheMeanOverTheLens) {
  struct Case {
    double distance, radius;
  };
  for (const auto& [distance, radius] : {Case{2.5, 0.05},
                                         {3.9, 0.05},
                                         {4.2, 0.05},
                                         {4.5, 0.05},
                                         {6, 0.05},
                                         {12, 0.05},
                                         {2.5, 0.4},
                                         {6, 0.3}}) {
    SCOPED_TRACE(distance);
    SCOPED_TRACE(radius);
    const Scene scene = pattern_on_wall(distance, radius);
    // Texels are as large as pixels: stripes on the left, the disc's rim on the right, a gradient below.
    const double half = 0.1 * distance;
    const auto draw = [&](int pictures) {
      return picture_of(scene, half, pictures, nullptr, ShadowTechnique::none,
                        {0.004 * distance, 0.09 * distance});
    };
    const LayeredImage truth = draw(256), fast = draw(1);
    const double rms = rms_difference(fast, truth), largest = largest_difference(fast, truth);
    const std::string name = std::to_string(distance) + " m, radius " + std::to_string(radius);
    RecordProperty("rms at " + name, std::to_string(rms));
    RecordProperty("largest at " + name, std::to_string(largest));
    EXPECT_LT(rms, 0.008);
    EXPECT_LT(largest, 0.05);
    EXPECT_NEAR(sum_of(fast) / sum_of(truth), 1, 0.003) << "no light is lost";
  }
}

// What goes on beyond the frame goes on out of focus too, plain white light has blurred edges, and a large disc spreads it thin.
TEST(Focus, WhatIsOutsideTheSlideIsBlurredIn) {
  for (const Outside outside : {Outside::black, Outside::clamp, Outside::repeat, Outside::mirror}) {
    Scene scene = pattern_on_wall(6);
    scene.lights[0].outside = outside;
    const LayeredImage truth = picture_of(scene, 3, 128), fast = picture_of(scene, 3, 1);
    EXPECT_LT(rms_difference(fast, truth), 0.012) << static_cast<int>(outside);
  }
  for (const double radius : {0.02, 0.3, 4.0}) {
    Scene scene = pattern_on_wall(8);
    scene.lights[0].slide = -1;
    scene.lights[0].aperture.radius = radius;
    const double half = 3 + 2 * radius;
    const LayeredImage truth = picture_of(scene, half, 256), fast = picture_of(scene, half, 1);
    EXPECT_LT(rms_difference(fast, truth), 0.012) << radius;
    EXPECT_NEAR(sum_of(fast) / sum_of(truth), 1, 0.01) << radius;
  }
}

// A post before the wall: its shadow is as soft as the lens is wide, R (d − b) / b to each side of the middle.
TEST(Focus, ShadowsOfAWideLensAreSoft) {
  Scene scene;
  add_object(scene, "wall", wall(20, 20, 0));
  const int post = add_object(scene, "post", box({-1, 0, 3}, {1, 5, 0.001F}));  // its edge on the axis
  scene.nodes[static_cast<std::size_t>(post)].visible = false;
  Light light = projector("projector", 0.5, 0.5);
  light.aperture = {kRadius, 6};  // the wall is in focus
  add_light(scene, light, {0, 0, 6}, {0, 0, 0});
  EXPECT_EQ(technique_for(scene.lights[0], ShadowTechnique::map), ShadowTechnique::pcss);
  EXPECT_EQ(technique_for(scene.lights[0], ShadowTechnique::exact), ShadowTechnique::exact);
  const LayeredImage truth = picture_of(scene, 0.3, 128, nullptr, ShadowTechnique::exact);
  const LayeredImage fast = picture_of(scene, 0.3, 1, nullptr, ShadowTechnique::map);
  EXPECT_LT(rms_difference(fast, truth), 0.02);
  const auto row = row_of(truth, "G", kSide / 2);
  for (const double t : {-0.7, -0.3, 0.0, 0.3, 0.7}) {
    const double share = 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / kPi;
    const auto pixel = static_cast<std::size_t>((t * kRadius / 0.3 + 1) * 0.5 * kSide);
    EXPECT_NEAR(row[pixel] / row[kSide - 10], share, 0.03) << t;
  }
  scene.lights[0].shadow.technique = ShadowTechnique::map;
  const LayeredImage hard = picture_of(scene, 0.3, 1, nullptr, ShadowTechnique::map);
  const auto levels = row_of(hard, "G", kSide / 2);
  const auto is_between = [&](float v) { return v > 0.01F && v < 0.9F * levels[kSide - 10]; };
  EXPECT_LE(std::ranges::count_if(levels, is_between), 1) << "the pixel on the edge";
}

// All instruction sets and any number of threads draw the same, by discs and from points; a lens that is shut costs nothing.
// Maps reach beyond the frame, for shadows in what is blurred out of it; what is said of the projector does not change.
TEST(Focus, OnlyMapsReachBeyondTheFrame) {
  Scene scene;
  add_object(scene, "wall", wall(20, 20, 0));
  Light light = projector("projector", 0.5, 0.5);
  light.aperture = {kRadius, 0.2};
  light.shadow.resolution = kMaxShadowResolution;
  add_light(scene, light, {0, 0, 6}, {0, 0, 0});
  const Renderer renderer = make_renderer(scene);
  const View frame = renderer.light_view("projector").value();
  EXPECT_NEAR(frame.projection.right, 0.5, 1e-12);
  EXPECT_EQ(renderer.depth_map_views("projector")->at(0).width, kMaxShadowResolution);
  const ShadowMapView map = renderer.shadow_map_views("projector", frame, test_settings(16, 16))->at(0);
  EXPECT_GT(map.view.projection.right, 0.6);
  EXPECT_LE(map.width, kMaxShadowResolution);
}

TEST(Focus, IsTheSameForEveryone) {
  for (const Outside outside : {Outside::black, Outside::repeat}) {
    Scene scene = pattern_on_wall(6);
    scene.lights[0].outside = outside;
    const int floor_node = add_object(scene, "floor", floor(10, -1));
    scene.nodes[static_cast<std::size_t>(floor_node)].casts_shadow = false;
    RenderSettings settings = test_settings(160, 90);
    const View camera = look({3, 1, 5}, {0, -0.5, 0}, 60, 16.0 / 9);
    settings.layers = {Layer::light, Layer::uv};
    for (const int pictures : {1, 3}) {
      settings.accumulate = pictures;
      const LayeredImage image = render(make_renderer(scene, 1), camera, settings);
      EXPECT_GT(sum_of(image), 1);
      for (const InstructionSet set : supported_instruction_sets()) {
        EXPECT_EQ(count_different_pixels(image, render(make_renderer(scene, 3, set), camera, settings)), 0U)
            << name_of(set) << ' ' << pictures;
      }
    }
  }
}

}  // namespace
}  // namespace laterna
