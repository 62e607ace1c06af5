#include "image/text_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace laterna::image {
namespace {

LayeredImage black(int width, int height) {
  LayeredImage image;
  image.width = width;
  image.height = height;
  const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (const char* name : {"R", "G", "B", "Z"}) image.channels.push_back({name, std::vector<float>(count)});
  return image;
}

// Rows of '#' and '.', from the channel R.
std::string drawn(const LayeredImage& image) {
  std::string rows;
  for (std::size_t i = 0; i < image.channels[0].values.size(); ++i) {
    rows += image.channels[0].values[i] > 0 ? '#' : '.';
    if ((i + 1) % static_cast<std::size_t>(image.width) == 0) rows += '\n';
  }
  return rows;
}

std::string drawn(std::string_view text, int width, int left = 0, int top = 0) {
  LayeredImage image = black(width, kGlyphHeight);
  draw_text(image, left, top, text, {1, 1, 1});
  return drawn(image);
}

TEST(TextDrawing, LettersStandUprightAndReadFromLeftToRight) {
  EXPECT_EQ(drawn("F1", 11),
            "#####...#..\n"
            "#......##..\n"
            "#.......#..\n"
            "####....#..\n"
            "#.......#..\n"
            "#.......#..\n"
            "#......###.\n");
}

TEST(TextDrawing, EveryPrintableCharacterLooksDifferent) {
  std::set<std::string> seen;
  for (char c = ' '; c <= '~'; ++c) seen.insert(drawn(std::string(1, c), kGlyphWidth));
  seen.insert(drawn("\n", kGlyphWidth));  // the frame that stands for others
  EXPECT_EQ(seen.size(), 96U);
}

TEST(TextDrawing, InkIsTheColourAskedForAndTouchesColoursOnly) {
  LayeredImage image = black(12, 16);
  draw_text(image, 1, 1, "|", {0.25F, 0.5F, 0.75F}, 2);
  std::size_t inked = 0;
  for (std::size_t i = 0; i < image.channels[0].values.size(); ++i) {
    if (image.channels[0].values[i] == 0) continue;
    ++inked;
    EXPECT_EQ(image.channels[0].values[i], 0.25F);
    EXPECT_EQ(image.channels[1].values[i], 0.5F);
    EXPECT_EQ(image.channels[2].values[i], 0.75F);
  }
  EXPECT_EQ(inked, 7U * 2 * 2);
  const std::vector<float>& depth = image.channels[3].values;
  EXPECT_EQ(std::count(depth.begin(), depth.end(), 0.0F), static_cast<std::ptrdiff_t>(depth.size()));
}

TEST(TextDrawing, WhatLiesBesideThePictureIsCutOff) {
  const std::string inside = drawn("H", kGlyphWidth);
  EXPECT_EQ(drawn("HHH", kGlyphWidth, -kGlyphAdvance), inside);
  EXPECT_EQ(drawn("H", kGlyphWidth, 0, kGlyphHeight).find('#'), std::string::npos);
  EXPECT_EQ(drawn("H", kGlyphWidth, -100, -100).find('#'), std::string::npos);
}

TEST(TextDrawing, WidthCountsCharactersAndNotBytes) {
  EXPECT_EQ(text_width(""), 0);
  EXPECT_EQ(text_width("a"), 5);
  EXPECT_EQ(text_width("ab", 3), 33);
  EXPECT_EQ(text_width("\xC3\xA9t\xC3\xA9"), text_width("ete"));
  EXPECT_EQ(drawn("\xC3\xA9", kGlyphWidth), drawn("\n", kGlyphWidth));
}

TEST(TextDrawing, TextThatDoesNotFitEndsInDots) {
  EXPECT_EQ(fitted_text("lantern", text_width("lantern")), "lantern");
  EXPECT_EQ(fitted_text("lantern", text_width("lantern") - 1), "lant..");
  EXPECT_EQ(fitted_text("l\xC3\xA9t\xC3\xA9s", text_width("l\xC3\xA9..")), "l\xC3\xA9..");
  EXPECT_EQ(fitted_text("lantern", text_width("l..") - 1), "");
  EXPECT_EQ(fitted_text("", 0), "");
}

}  // namespace
}  // namespace laterna::image
