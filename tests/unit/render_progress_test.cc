// Progress, cancelling, and several callers at once.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "reference/everything.h"
#include "reference/shapes.h"

namespace laterna {
namespace {

using reference::everything;
using reference::same_bits;

RenderSettings settings_of(int width, int height) {
  RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.layers = {Layer::light, Layer::visibility, Layer::depth};
  return settings;
}

View view_number(int i) {
  return reference::look({2.0 * i - 3, 2 + 0.4 * i, 7 - 0.5 * i}, {0, 1, 0}, 45, 1.3);
}

LayeredImage draw(const Renderer& renderer, int i) {
  return reference::render(renderer, view_number(i), settings_of(200, 150));
}

TEST(RenderProgress, GoesFromNothingToOneByOneThreadAtATime) {
  for (const int threads : {1, 2, 8}) {
    const Renderer renderer = reference::make_renderer(everything(), threads);
    std::vector<double> fractions;
    std::atomic<int> inside = 0;
    const Result<LayeredImage> picture =
        renderer.render(view_number(1), settings_of(700, 500), [&](double fraction) {
          EXPECT_EQ(inside.fetch_add(1), 0);
          fractions.push_back(fraction);
          inside.fetch_sub(1);
          return true;
        });
    ASSERT_TRUE(picture);
    ASSERT_FALSE(fractions.empty());
    for (const double fraction : fractions) {
      EXPECT_GE(fraction, 0);
      EXPECT_LE(fraction, 1);
    }
    EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
    if (threads == 1) {
      EXPECT_EQ(fractions.back(), 1);
    }
  }
}

TEST(RenderProgress, AskingToStopEndsInAnErrorAndLeavesTheRendererAsItWas) {
  const Renderer renderer = reference::make_renderer(everything(), 2);
  const LayeredImage before = draw(renderer, 2);
  for (const int patience : {0, 1, 5}) {
    int calls = 0;
    const Result<LayeredImage> stopped =
        renderer.render(view_number(2), settings_of(700, 500), [&](double) { return calls++ < patience; });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().failure, Failure::cancelled);
    EXPECT_EQ(to_string(stopped.error()), "cancelled");
    EXPECT_EQ(calls, patience + 1);  // once it has said no, it is not asked again
    EXPECT_TRUE(same_bits(draw(renderer, 2), before));
  }
  // And a renderer whose first picture was stopped.
  const Renderer fresh = reference::make_renderer(everything(), 2);
  ASSERT_FALSE(fresh.render(view_number(2), settings_of(700, 500), [](double) { return false; }));
  EXPECT_TRUE(same_bits(draw(fresh, 2), before));
}

TEST(RenderProgress, ReportingDoesNotChangeThePicture) {
  const Renderer renderer = reference::make_renderer(everything(), 2);
  const Result<LayeredImage> reported =
      renderer.render(view_number(3), settings_of(200, 150), [](double) { return true; });
  ASSERT_TRUE(reported);
  EXPECT_TRUE(same_bits(*reported, draw(renderer, 3)));
}

TEST(RenderReentrancy, FourCallersAtOnceGetWhatTheyGetOneAfterTheOther) {
  for (const int threads : {1, 3}) {
    const Renderer renderer = reference::make_renderer(everything(), threads);
    const Renderer other = reference::make_renderer(everything(), threads);
    std::vector<LayeredImage> expected(4), got(4);
    for (int i = 0; i < 4; ++i) expected[static_cast<std::size_t>(i)] = draw(other, i);
    for (int round = 0; round < 3; ++round) {
      std::vector<std::thread> callers;
      callers.reserve(4);
      for (int i = 0; i < 4; ++i) {
        callers.emplace_back([&, i] { got[static_cast<std::size_t>(i)] = draw(renderer, i); });
      }
      for (std::thread& caller : callers) caller.join();
      for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(same_bits(got[i], expected[i])) << "caller " << i;
    }
  }
}

TEST(RenderReentrancy, CallersWithDifferentSettingsDoNotDisturbEachOther) {
  const Renderer renderer = reference::make_renderer(everything(), 2);
  std::vector<RenderSettings> settings(4, settings_of(200, 150));
  settings[0].shadows = ShadowTechnique::none;
  settings[1].shadows = ShadowTechnique::raytraced;
  settings[2].passes = Passes::multi;
  settings[3].keep_shadow_maps = false;
  std::vector<LayeredImage> expected, got(4);
  for (const RenderSettings& s : settings) expected.push_back(reference::render(renderer, view_number(0), s));
  std::vector<std::thread> callers;
  for (std::size_t i = 0; i < 4; ++i) {
    callers.emplace_back([&, i] { got[i] = reference::render(renderer, view_number(0), settings[i]); });
  }
  for (std::thread& caller : callers) caller.join();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(same_bits(got[i], expected[i])) << "settings " << i;
}

TEST(RenderReentrancy, OneCallerStoppingDoesNotStopTheOthers) {
  const Renderer renderer = reference::make_renderer(everything(), 2);
  const LayeredImage expected = draw(renderer, 1);
  LayeredImage got;
  std::atomic<bool> was_stopped = false;
  std::thread stopping([&] {
    was_stopped =
        !renderer.render(view_number(1), settings_of(700, 500), [](double) { return false; }).has_value();
  });
  std::thread drawing([&] { got = draw(renderer, 1); });
  stopping.join();
  drawing.join();
  EXPECT_TRUE(was_stopped);
  EXPECT_TRUE(same_bits(got, expected));
}

}  // namespace
}  // namespace laterna
