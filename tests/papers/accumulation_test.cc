// The accumulation buffer as a service: what pictures of one mean differ in, how far it is told, and where it stops.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "base/sample_sequence.h"
#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"

namespace laterna {
namespace {

using namespace reference;

// Largest difference between the share of points in a box from the corner and the box's area, over a grid of boxes.
double discrepancy(const std::vector<glm::dvec2>& points) {
  double worst = 0;
  for (int i = 1; i <= 32; ++i) {
    for (int j = 1; j <= 32; ++j) {
      const double x = i / 32.0, y = j / 32.0;
      const auto inside = std::ranges::count_if(points, [&](glm::dvec2 p) { return p.x < x && p.y < y; });
      worst =
          std::max(worst, std::abs(static_cast<double>(inside) / static_cast<double>(points.size()) - x * y));
    }
  }
  return worst;
}

double field_centre(SampleIndex sample) { return (sample_field(sample) + 0.5) / sample.count; }

// Every two dimensions fill their square more evenly than chance, which is off by 1.05/√N in the mean.
TEST(Accumulation, EveryTwoDimensionsFillTheirSquare) {
  for (const int count : {64, 100, 256, 1000}) {
    const auto numbers = [&](int which) {
      std::vector<double> all;
      for (int i = 0; i < count; ++i) {
        const SampleIndex sample = {i, count};
        all.push_back(which == 0   ? sample_number(sample, SampleDimension::pixel_x)
                      : which == 1 ? sample_number(sample, SampleDimension::pixel_y)
                      : which == 2 ? sample_number(sample, SampleDimension::source)
                      : which == 3 ? sample_number(sample, SampleDimension::instant)
                                   : field_centre(sample));
      }
      return all;
    };
    for (int a = 0; a < 5; ++a) {
      for (int b = a + 1; b < 5; ++b) {
        std::vector<glm::dvec2> points;
        for (int i = 0; i < count; ++i)
          points.emplace_back(numbers(a)[static_cast<std::size_t>(i)],
                              numbers(b)[static_cast<std::size_t>(i)]);
        EXPECT_LT(discrepancy(points), 0.7 / std::sqrt(count)) << count << ' ' << a << ' ' << b;
      }
    }
  }
  std::set<int> fields;
  for (int i = 0; i < 100; ++i) fields.insert(sample_field({i, 100}));
  EXPECT_EQ(fields.size(), 100U);
  EXPECT_EQ(sample_number({0, 7}, SampleDimension::pixel_x), 0.5) << "the first sample is the pixel's centre";
}

// The edge of a white card crosses a pixel: what it covers of the pixel is what is seen.
Scene card(double edge) {
  Scene scene;
  add_object(scene, "card", box({-5 + edge, 0, 0}, {5, 5, 0.001F}));
  scene.ambient = glm::vec3(1);
  scene.ambient_is_set = true;
  return scene;
}

TEST(Accumulation, PicturesSamplePixelsAtOtherPlaces) {
  for (const int samples : {1, 4, 16}) {
    for (const double covered : {0.13, 0.5, 0.77}) {
      RenderSettings settings = papers_settings(8, 8);
      settings.samples = samples;
      settings.accumulate = 64;
      settings.layers = {Layer::depth};
      // Pixels are 1 m wide; the edge lies in the fifth.
      const LayeredImage image = render(make_renderer(card(covered)), square_on(4, 1), settings);
      EXPECT_NEAR(at(image, "G", 4, 4), covered, 0.02) << samples;
      EXPECT_NEAR(at(image, "A", 4, 4), covered, 0.02) << samples;
      EXPECT_EQ(at(image, "G", 3, 4), 1) << samples;
      EXPECT_EQ(at(image, "G", 5, 4), 0) << samples;
      settings.accumulate = 1;
      const LayeredImage one = render(make_renderer(card(covered)), square_on(4, 1), settings);
      EXPECT_EQ(at(image, "Z", 4, 4), at(one, "Z", 4, 4)) << "data is the first picture's";
    }
  }
}

// Its edge stands at 2 t metres at t seconds.
Scene moving_card() {
  Scene scene = card(0);
  scene.nodes[0].transform = Transform();
  Clip clip;
  clip.name = "go";
  clip.at_end = AtEnd::hold;
  clip.keys = {{KeyInterpolation::linear, {0, 2}, {0, 0, 0, 4, 0, 0}}};
  clip.channels = {{AnimatedProperty::translation, 0, false, 0, 0}};
  scene.clips.push_back(clip);
  return scene;
}

Renderer at_one_second(Scene scene) {
  RendererOptions options;
  options.time = 1;
  return *Renderer::create(std::move(scene), options);
}

// While the shutter is open the edge goes from 1 to 3 metres: of a pixel's metre it covers the mean share of that time.
TEST(Accumulation, AShutterBlursWhatMoves) {
  Renderer renderer = at_one_second(moving_card());
  RenderSettings settings = papers_settings(8, 8);
  const LayeredImage still = render(renderer, square_on(4, 1), settings);
  EXPECT_EQ(at(still, "G", 5, 4), 1);
  EXPECT_EQ(at(still, "G", 6, 4), 0);
  settings.accumulate = 256;
  const Result<LayeredImage> blurred = renderer.render_exposed(square_on(4, 1), settings, {1});
  ASSERT_TRUE(blurred) << to_string(blurred.error());
  const double expected[] = {1, 0.75, 0.25, 0};
  // Place and instant fill their square to 0.7/√N (above).
  for (int x = 4; x < 8; ++x) EXPECT_NEAR(at(*blurred, "G", x, 4), expected[x - 4], 0.7 / 16) << x;
  EXPECT_EQ(renderer.time(), 1);
  settings.accumulate = 1;
  EXPECT_EQ(count_different_pixels(render(renderer, square_on(4, 1), settings), still), 0U);
}

// What moves with the camera stays sharp, and so does what is still.
TEST(Accumulation, AShutterLeavesSharpWhatStandsStillInThePicture) {
  Renderer renderer = at_one_second(moving_card());
  RenderSettings settings = papers_settings(8, 8);
  settings.accumulate = 64;
  Shutter shutter{1};
  shutter.view_now = [](const Renderer& posed) -> Result<View> {
    View view = square_on(4, 1);
    view.pose.position_ws.x += 2 * posed.time() - 2;
    return view;
  };
  const LayeredImage followed = *renderer.render_exposed(square_on(4, 1), settings, shutter);
  for (int x = 4; x < 8; ++x) EXPECT_EQ(at(followed, "G", x, 4), x < 6 ? 1 : 0) << x;
  Renderer unmoved = make_renderer(card(0.3));
  EXPECT_EQ(count_different_pixels(*unmoved.render_exposed(square_on(4, 1), settings, {1}),
                                   render(unmoved, square_on(4, 1), settings)),
            0U);
}

TEST(Accumulation, AShutterIsOpenForSomeTimeWithinTheScenes) {
  Renderer renderer = make_renderer(card(0.3));
  const RenderSettings settings = papers_settings(8, 8);
  for (const double seconds : {-1.0, std::nan(""), 3e6}) {
    const auto refused = renderer.render_exposed(square_on(4, 1), settings, {seconds});
    EXPECT_FALSE(refused) << seconds;
    EXPECT_EQ(renderer.time(), 0);
  }
  Shutter lost{0.5};
  lost.view_now = [](const Renderer& posed) { return posed.camera_view("none", 8, 8); };
  RenderSettings many = settings;
  many.accumulate = 4;
  EXPECT_FALSE(renderer.render_exposed(square_on(4, 1), many, lost));
  EXPECT_EQ(renderer.time(), 0);
}

// Called after each picture but the last; what it is shown is the mean of so many pictures; it may end the work.
TEST(Accumulation, IsShownAsItImproves) {
  const Renderer renderer = make_renderer(card(0.3));
  RenderSettings settings = papers_settings(16, 16);
  settings.accumulate = 16;
  std::vector<int> counts;
  LayeredImage after_five;
  RenderStatistics statistics;
  const Preview preview = [&](const PartialMean& mean) {
    counts.push_back(mean.pictures);
    if (mean.pictures == 5) {
      mean.write();
      after_five = *mean.image;
    }
    return true;
  };
  const LayeredImage whole = *renderer.render(square_on(4, 1), settings, {}, &statistics, preview);
  std::vector<int> expected(15);
  std::iota(expected.begin(), expected.end(), 1);
  EXPECT_EQ(counts, expected);
  const LayeredImage unwatched = *renderer.render(square_on(4, 1), settings);
  EXPECT_EQ(count_different_pixels(whole, unwatched), 0U) << "looking at it changes nothing";
  const LayeredImage stopped = *renderer.render(square_on(4, 1), settings, {}, &statistics,
                                                [](const PartialMean& mean) { return mean.pictures < 5; });
  EXPECT_EQ(statistics.pictures, 5);
  EXPECT_EQ(count_different_pixels(stopped, after_five), 0U);
  EXPECT_EQ(after_five.metadata, whole.metadata);
  EXPECT_GT(count_different_pixels(stopped, whole), 0U);
}

// With memory of the caller's own.
TEST(Accumulation, ShowsItselfInTheCallersMemory) {
  const Renderer renderer = make_renderer(card(0.3));
  RenderSettings settings = papers_settings(16, 16);
  settings.accumulate = 4;
  std::vector<std::uint8_t> pixels(16 * 16 * 3);
  RenderTarget target;
  target.color8 = ColorTarget8{pixels.data(), 3, 16 * 3, 1};
  std::set<std::vector<std::uint8_t>> seen;
  const auto done = renderer.render_into(square_on(4, 1), settings, target, {}, [&](const PartialMean& mean) {
    EXPECT_EQ(mean.image, nullptr);
    mean.write();
    seen.insert(pixels);
    return true;
  });
  ASSERT_TRUE(done);
  EXPECT_GE(seen.size(), 2U);
  EXPECT_EQ(done->pictures, 4);
}

}  // namespace
}  // namespace laterna
