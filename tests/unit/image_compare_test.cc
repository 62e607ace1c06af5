// idiff's numbers and verdicts.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "laterna/image.h"

namespace laterna {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

LayeredImage grey(int width, int height, std::vector<float> values) {
  return {width, height, {{"Y", std::move(values)}}, {}};
}

Comparison compare(const LayeredImage& a, const LayeredImage& b, const DifferenceLimits& limits = {}) {
  const Result<Comparison> result = compare_images(a, b, limits);
  if (result) return *result;
  ADD_FAILURE() << to_string(result.error());
  return {};
}

TEST(CompareImages, EqualPicturesPass) {
  const Comparison found = compare(grey(2, 1, {0.5F, 7}), grey(2, 1, {0.5F, 7}));
  EXPECT_EQ(found.verdict, Verdict::pass);
  EXPECT_EQ(found.difference.max_error, 0);
  EXPECT_EQ(found.difference.mean_error, 0);
  EXPECT_EQ(found.difference.psnr_db, kInfinity);
  EXPECT_EQ(found.difference.pixels, 2);
}

TEST(CompareImages, NumbersAreThoseOfTheirDefinition) {
  // Errors 0, 0.5 in R and 0.25, 0.25 in G.
  const LayeredImage a{2, 1, {{"R", {1, 0}}, {"G", {0.5F, 1}}}, {}};
  const LayeredImage b{2, 1, {{"G", {0.25F, 0.75F}}, {"R", {1, 0.5F}}}, {}};
  const Difference found = compare(a, b, {.warn = 0.1, .fail = 0.3}).difference;
  EXPECT_DOUBLE_EQ(found.mean_error, 0.25);
  EXPECT_DOUBLE_EQ(found.rms_error, std::sqrt((0.25 + 0.0625 + 0.0625) / 4));
  EXPECT_NEAR(found.psnr_db, 20 * std::log10(1 / found.rms_error), 1e-12);
  EXPECT_EQ(found.max_error, 0.5);
  EXPECT_EQ(found.max_x, 1);
  EXPECT_EQ(found.max_y, 0);
  EXPECT_EQ(found.max_channel, "R");
  EXPECT_EQ(found.max_value_a, 0);
  EXPECT_EQ(found.max_value_b, 0.5F);
  EXPECT_EQ(found.pixels_over_warn, 2);
  EXPECT_EQ(found.pixels_over_fail, 1);
}

TEST(CompareImages, SignalIsTheLargestValueAboveOne) {
  EXPECT_NEAR(compare(grey(1, 1, {10}), grey(1, 1, {9})).difference.psnr_db, 20, 1e-12);
}

TEST(CompareImages, VerdictsFollowTheLimits) {
  // Ten pixels, one of which differs by 0.5 and one by 0.01.
  const LayeredImage a = grey(10, 1, std::vector<float>(10, 0));
  LayeredImage b = a;
  b.channels[0].values[3] = 0.5F;
  b.channels[0].values[7] = 0.01F;
  struct Row {
    DifferenceLimits limits;
    Verdict expected;
  };
  const Row rows[] = {
      {{}, Verdict::failure},
      {{.warn = 1, .fail = 1}, Verdict::pass},
      {{.warn = 0.5, .fail = 0.5}, Verdict::pass},  // a limit itself is allowed
      {{.warn = 0.1, .fail = 1}, Verdict::warning},
      {{.warn = 1, .fail = 0.1}, Verdict::failure},
      {{.warn = 0.1, .fail = 0.1, .warn_percent = 10, .fail_percent = 10}, Verdict::pass},
      {{.warn = 0.1, .fail = 0.1, .warn_percent = 9.9, .fail_percent = 10}, Verdict::warning},
      {{.warn = 0.1, .fail = 0.1, .warn_percent = 10, .fail_percent = 9.9}, Verdict::failure},
      {{.warn = 0.001, .fail = 0.001, .warn_percent = 10, .fail_percent = 10}, Verdict::failure},
      {{.warn = 0.001, .fail = 0.001, .warn_percent = 10, .fail_percent = 20}, Verdict::warning},
      {{.warn = 1, .fail = 1, .hard_fail = 0.4}, Verdict::failure},
      {{.warn = 1, .fail = 1, .hard_fail = 0.5}, Verdict::pass},
      {{.warn = 1, .fail = 1, .hard_warn = 0.4}, Verdict::warning},
      {{.warn = 0.1, .fail = 0.1, .warn_percent = 100, .fail_percent = 100, .hard_fail = 0.4},
       Verdict::failure},
  };
  for (const Row& row : rows) {
    EXPECT_EQ(compare(a, b, row.limits).verdict, row.expected) << "row " << &row - rows;
  }
}

TEST(CompareImages, BackgroundsAtInfinityAreEqualAndNanIsNot) {
  const float nan = std::nanf("");
  EXPECT_EQ(compare(grey(1, 1, {kInfinity}), grey(1, 1, {kInfinity})).verdict, Verdict::pass);
  EXPECT_EQ(compare(grey(1, 1, {kInfinity}), grey(1, 1, {-kInfinity})).verdict, Verdict::failure);
  EXPECT_EQ(compare(grey(1, 1, {kInfinity}), grey(1, 1, {1})).difference.max_error, kInfinity);
  EXPECT_EQ(compare(grey(1, 1, {nan}), grey(1, 1, {nan})).verdict, Verdict::pass);
  const Comparison found = compare(grey(2, 1, {1, nan}), grey(2, 1, {1, 1}));
  EXPECT_EQ(found.verdict, Verdict::failure);
  EXPECT_EQ(found.difference.max_error, kInfinity);
  EXPECT_EQ(found.difference.max_x, 1);
  EXPECT_EQ(found.difference.psnr_db, -kInfinity);
}

TEST(CompareImages, RefusesPicturesThatCannotBeCompared) {
  const auto error = [](const LayeredImage& a, const LayeredImage& b) {
    const Result<Comparison> result = compare_images(a, b, {});
    return result ? "no error" : to_string(result.error());
  };
  EXPECT_EQ(error(grey(2, 1, {1, 2}), grey(1, 2, {1, 2})), "the pictures differ in size: 2 x 1 and 1 x 2");
  EXPECT_EQ(error(grey(1, 1, {1}), {1, 1, {{"Z", {1}}}, {}}),
            "the pictures differ in their channels: Y and Z");
  EXPECT_EQ(error(grey(1, 1, {1}), {1, 1, {{"Y", {1}}, {"A", {1}}}, {}}),
            "the pictures differ in their channels: Y and Y A");
}

TEST(DifferencePicture, IsTheScaledDifferenceOfTheColours) {
  const LayeredImage a{1, 1, {{"A", {1}}, {"B", {1}}, {"G", {1}}, {"R", {1}}}, {}};
  const LayeredImage b{1, 1, {{"R", {0.75F}}, {"G", {1.25F}}, {"B", {1}}, {"A", {0}}}, {}};
  const Result<LayeredImage> picture = difference_picture(a, b, 8);
  ASSERT_TRUE(picture);
  ASSERT_EQ(picture->channels.size(), 3U);
  EXPECT_EQ(picture->find("R")->values[0], 2);
  EXPECT_EQ(picture->find("G")->values[0], 2);
  EXPECT_EQ(picture->find("B")->values[0], 0);
}

TEST(DifferencePicture, WithoutColoursShowsTheFirstSharedChannel) {
  const LayeredImage a{1, 1, {{"N.X", {1}}, {"Z", {3}}, {"id.object", {1}}}, {}};
  const LayeredImage b{1, 1, {{"Z", {5}}, {"id.object", {1}}}, {}};
  const Result<LayeredImage> picture = difference_picture(a, b, 1);
  ASSERT_TRUE(picture);
  ASSERT_EQ(picture->channels.size(), 1U);
  EXPECT_EQ(picture->find("Y")->values[0], 2);
  EXPECT_FALSE(difference_picture(a, {1, 1, {{"Q", {1}}}, {}}, 1));
  EXPECT_FALSE(difference_picture(a, {2, 1, {{"Z", {1, 1}}}, {}}, 1));
}

}  // namespace
}  // namespace laterna
