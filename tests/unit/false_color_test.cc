// Amounts as colours: the scale, what is above it, what is nothing, iso-lines, and the picture's size.
#include "laterna/false_color.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace laterna {
namespace {

using Rgb = std::array<float, 3>;

// A row of values repeated downward.
LayeredImage ramp(const std::vector<float>& row, int height = 64) {
  LayeredImage image;
  image.width = static_cast<int>(row.size());
  image.height = height;
  Channel channel{"lux.Y", {}};
  for (int y = 0; y < height; ++y) channel.values.insert(channel.values.end(), row.begin(), row.end());
  image.channels.push_back(std::move(channel));
  return image;
}

Rgb pixel(const LayeredImage& image, int x, int y) {
  const auto i = static_cast<std::size_t>(y * image.width + x);
  return {image.find("R")->values[i], image.find("G")->values[i], image.find("B")->values[i]};
}

LayeredImage colored(const LayeredImage& image, double maximum, bool iso_lines = false) {
  return false_color_picture(image, "lux.Y", {maximum, "lx", iso_lines}).value();
}

TEST(FalseColor, RunsFromBlueToRedWithPinkAboveAndGreyForNothing) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const LayeredImage shown = colored(ramp({0, 50, 100, 101, kInfinity, NAN}), 100);
  EXPECT_EQ(shown.height, 64);
  EXPECT_GT(shown.width, 6 + 20);
  const Rgb dark = pixel(shown, 0, 5);
  const Rgb middle = pixel(shown, 1, 5);
  const Rgb red = pixel(shown, 2, 5);
  EXPECT_GT(dark[2], dark[0]);
  EXPECT_LT(dark[2], 0.1F);
  EXPECT_GT(middle[1], middle[0]);
  EXPECT_GT(middle[1], middle[2]);
  EXPECT_GT(red[0], 10 * red[1]);
  const Rgb above = pixel(shown, 3, 5);
  EXPECT_EQ(above[0], 1);
  EXPECT_GT(above[1], 0.3F);
  for (const int x : {4, 5}) {
    const Rgb nothing = pixel(shown, x, 5);
    EXPECT_EQ(nothing[0], nothing[1]);
    EXPECT_EQ(nothing[1], nothing[2]);
  }
}

TEST(FalseColor, AmountsAreDividedByCoverage) {
  LayeredImage image = ramp({40, 20, 0});
  image.channels.push_back({"A", {}});
  for (int y = 0; y < image.height; ++y)
    image.channels[1].values.insert(image.channels[1].values.end(), {1, 0.5F, 0});
  const LayeredImage shown = colored(image, 100);
  EXPECT_EQ(pixel(shown, 0, 9), pixel(shown, 1, 9));
  EXPECT_EQ(pixel(shown, 2, 9)[0], pixel(shown, 2, 9)[2]);  // grey
}

// From 0 to 100 in 200 pixels with numbers every 20 (a scale of 64 pixels has room for few): lines where they are passed.
TEST(FalseColor, IsoLinesStandWhereTheScalesNumbersArePassed) {
  std::vector<float> row(200);
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = 0.5F * (static_cast<float>(i) + 0.5F);
  const LayeredImage plain = colored(ramp(row, 160), 100);
  const LayeredImage lined = colored(ramp(row, 160), 100, true);
  std::vector<int> lines;
  for (int x = 0; x < 200; ++x) {
    if (pixel(plain, x, 80) != pixel(lined, x, 80)) lines.push_back(x);
  }
  ASSERT_GE(lines.size(), 4U);
  const int step = lines[1] - lines[0];
  for (std::size_t i = 0; i < lines.size(); ++i)
    EXPECT_EQ(lines[i], static_cast<int>(i + 1) * step - 1);  // the last pixel before it
}

TEST(FalseColor, TheScalesEndIsRoundAndTold) {
  const auto maximum = [](float most) {
    std::vector<float> row(100);
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = most * static_cast<float>(i) / 99;
    return colored(ramp(row), 0).metadata.at("laterna.scale_maximum");
  };
  EXPECT_EQ(maximum(1333), "1500");
  EXPECT_EQ(maximum(0.19F), "0.2");
  EXPECT_EQ(maximum(47), "50");
  EXPECT_EQ(maximum(0), "1");
  // One lamp's bright spot does not darken all the rest.
  std::vector<float> spot(1000, 3);
  spot[500] = 1e6F;
  EXPECT_EQ(colored(ramp(spot, 8), 0).metadata.at("laterna.scale_maximum"), "3");
}

// The scale is white paper with black numbers, and its bar has the picture's own colours: what is above it, on top.
TEST(FalseColor, TheScaleStandsBesideThePicture) {
  const LayeredImage shown = colored(ramp(std::vector<float>(10, 150), 200), 100);
  int black = 0;
  bool has_end = false;
  for (int y = 0; y < shown.height; ++y) {
    for (int x = 10; x < shown.width; ++x) {
      const Rgb c = pixel(shown, x, y);
      black += c == Rgb{0, 0, 0} ? 1 : 0;
      has_end = has_end || c == pixel(shown, 0, 0);
    }
  }
  EXPECT_GT(black, 100);
  EXPECT_TRUE(has_end);
}

TEST(FalseColor, SmallPicturesAndFaultySettings) {
  EXPECT_EQ(colored(ramp({7}, 1), 10).height, 1);
  const auto fault = [](const std::string& channel, double maximum) {
    return to_string(false_color_picture(ramp({1, 2}), channel, {maximum, "", true}).error());
  };
  EXPECT_EQ(fault("lux", 1), "the picture has no channel \"lux\"; it has lux.Y");
  EXPECT_EQ(fault("lux.Y", -1), "the scale's maximum must be a number from 1e-12 to 1e+15, got -1");
  EXPECT_EQ(fault("lux.Y", NAN), "the scale's maximum must be a number from 1e-12 to 1e+15, got nan");
  EXPECT_EQ(to_string(false_color_picture({1, 1, {{"Y", {}}}, {}}, "Y").error()),
            "the picture has no pixels");
}

}  // namespace
}  // namespace laterna
