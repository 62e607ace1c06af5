// The picture of which objects may shade which.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "laterna/measure.h"
#include "reference/picture_probes.h"
#include "reference/shadow_scenes.h"
#include "reference/shapes.h"

namespace laterna {
namespace {

using namespace reference;

// A lamp overhead; a ball over a plate, and another plate far off to the side, all seen straight from above.
Scene ball_and_plates() {
  Scene scene;
  add_object(scene, "plate", box({0, 0, 0}, {0.5F, 0.1F, 0.5F}));
  add_object(scene, "ball", sphere({0, 1.5F, 0}, 0.2F, 12));
  add_object(scene, "lone", box({3, 0, 0}, {0.5F, 0.1F, 0.5F}));
  Light light = sun("sun");
  light.shadow.technique = ShadowTechnique::silhouette;
  add_light(scene, light, {0, 5, 0}, {0, 0, 0}, {0, 0, -1});
  add_light(scene, spot("lamp", 30), {0, 6, 0}, {0, 0, 0}, {0, 0, -1});
  return scene;
}

View from_above() {
  return {Pose::look_at({1.5, 8, 0}, {1.5, 0, 0}, {0, 0, -1}).value(),
          Projection::orthographic(2.5, 2.5, 0, 10)};
}

Result<ExplainedPicture> draw(Scene scene, const std::string& light = "sun") {
  return shadow_pairs_picture(make_renderer(std::move(scene)), from_above(), test_settings(100, 100), light);
}

// Colours to the hundredth, within columns and rows.
std::set<std::array<int, 3>> colors_within(const LayeredImage& image, int left, int right, int top,
                                           int bottom) {
  std::set<std::array<int, 3>> colors;
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      std::array<int, 3> color = {};
      for (std::size_t c = 0; c < 3; ++c)
        color.at(c) = static_cast<int>(100 * at(image, std::array{"R", "G", "B"}.at(c), x, y) + 0.5F);
      colors.insert(color);
    }
  }
  return colors;
}

// 20 pixels a metre: the plate is at columns 10 to 30, the lone one at 70 to 90, rows 40 to 60; the ball within 4 pixels
// of (20, 50).
TEST(ShadowPairsPicture, StripesAReceiverWithTheColourOfItsOccluder) {
  const Result<ExplainedPicture> drawn = draw(ball_and_plates());
  ASSERT_TRUE(drawn) << to_string(drawn.error());
  const std::set<std::array<int, 3>> red_and_azure = {{90, 5, 5}, {5, 30, 90}};
  EXPECT_EQ(colors_within(drawn->picture, 11, 29, 41, 45), red_and_azure);
  EXPECT_EQ(colors_within(drawn->picture, 71, 89, 41, 59), (std::set<std::array<int, 3>>{{15, 15, 15}}));
  EXPECT_EQ(colors_within(drawn->picture, 40, 60, 0, 100), (std::set<std::array<int, 3>>{{0, 0, 0}}));
  // The ball is shaded by none: no stripes.
  for (const auto& color : colors_within(drawn->picture, 18, 22, 48, 52)) {
    EXPECT_GT(color[2], 2 * color[1]);
    EXPECT_GT(color[2], 10 * color[0]);
  }
  ASSERT_EQ(drawn->legend.size(), 2U);
  EXPECT_EQ(drawn->legend[0].substr(0, 20), "1 pairs of 3 objects");
  EXPECT_EQ(drawn->legend[1], "\"ball\" (azure) may shade \"plate\" (red)");
}

TEST(ShadowPairsPicture, ListsFortyPairsAndCountsTheRest) {
  Scene scene = ball_and_plates();
  for (int i = 0; i < 9; ++i)
    add_object(scene, "leaf", box({0, 2 + 0.1F * static_cast<float>(i), 0}, {0.3F, 0.01F, 0.3F}));
  const Result<ExplainedPicture> drawn = draw(std::move(scene));
  ASSERT_TRUE(drawn) << to_string(drawn.error());
  ASSERT_EQ(drawn->legend.size(), 42U);
  const int pairs = std::stoi(drawn->legend[0]);
  EXPECT_EQ(drawn->legend[41], "and " + std::to_string(pairs - 40) + " pairs more");
  // Leaves are flat, and their spheres overlap in distance.
  EXPECT_TRUE(std::any_of(drawn->legend.begin(), drawn->legend.end(), [](const std::string& line) {
    return line.find("\"leaf\"") == 0 &&
           line.find(": their distances from the light overlap") != std::string::npos;
  }));
}

TEST(ShadowPairsPicture, IsRefusedWhereThereAreNone) {
  const auto message = [](Scene scene, const std::string& light) {
    const Result<ExplainedPicture> drawn = draw(std::move(scene), light);
    return drawn ? std::string() : to_string(drawn.error());
  };
  EXPECT_EQ(message(ball_and_plates(), "lamp"),
            "light \"lamp\" has no projected silhouettes: its shadow technique is another one");
  EXPECT_EQ(message(ball_and_plates(), "moon"), "the scene has no light \"moon\": it has \"sun\", \"lamp\"");
  Scene one;
  add_object(one, "ball", sphere({0, 1.5F, 0}, 0.2F, 12));
  Light light = sun("sun");
  light.shadow.technique = ShadowTechnique::silhouette;
  add_light(one, light, {0, 5, 0}, {0, 0, 0}, {0, 0, -1});
  EXPECT_EQ(message(std::move(one), "sun"),
            "a pair takes two objects that cast or receive shadows: the scene has one");
}

}  // namespace
}  // namespace laterna
