// sRGB codes against the curve itself, computed in double.
#include "image/colour.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "base/elementary.h"

namespace laterna::image {
namespace {

template <class Code>
Code encoded(float linear) {
  Code code = 0;
  encode_srgb(std::span(&linear, 1), std::span(&code, 1));
  return code;
}

template <class Code>
Code expected(float linear) {
  constexpr double kLargest = std::numeric_limits<Code>::max();
  return static_cast<Code>(std::floor(kLargest * srgb_from_linear(static_cast<double>(linear)) + 0.5));
}

// Around every value where the code changes, and at values spread over all magnitudes.
template <class Code>
void expect_correct_rounding() {
  constexpr double kLargest = std::numeric_limits<Code>::max();
  for (double code = 1; code <= kLargest; ++code) {
    const auto threshold = static_cast<float>(linear_from_srgb((code - 0.5) / kLargest));
    for (int step = -3; step <= 3; ++step) {
      const auto x =
          std::bit_cast<float>(std::bit_cast<std::uint32_t>(threshold) + static_cast<std::uint32_t>(step));
      ASSERT_EQ(encoded<Code>(x), expected<Code>(x)) << x;
    }
  }
  const auto one = std::bit_cast<std::uint32_t>(1.0F);
  for (std::uint32_t bits = 0; bits <= one; bits += 1009) {
    const auto x = std::bit_cast<float>(bits);
    ASSERT_EQ(encoded<Code>(x), expected<Code>(x)) << x;
  }
}

TEST(Colour, EightBitCodesAreCorrectlyRounded) { expect_correct_rounding<std::uint8_t>(); }
TEST(Colour, SixteenBitCodesAreCorrectlyRounded) { expect_correct_rounding<std::uint16_t>(); }

TEST(Colour, ValuesOutsideTakeTheNearerEndAndNanIsBlack) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float low : {0.0F, -0.0F, -1.0F, -kInfinity, std::nanf(""), -std::nanf(""), 1e-45F}) {
    EXPECT_EQ(encoded<std::uint8_t>(low), 0) << low;
    EXPECT_EQ(encoded<std::uint16_t>(low), 0) << low;
  }
  for (const float high : {1.0F, 1.5F, 1e30F, kInfinity}) {
    EXPECT_EQ(encoded<std::uint8_t>(high), 255) << high;
    EXPECT_EQ(encoded<std::uint16_t>(high), 65535) << high;
  }
}

TEST(Colour, DecodingAndEncodingGivesTheCodeBack) {
  for (unsigned code = 0; code < 256; ++code)
    EXPECT_EQ(encoded<std::uint8_t>(linear_from_srgb8()[code]), code);
  for (unsigned code = 0; code < 65536; ++code)
    EXPECT_EQ(encoded<std::uint16_t>(linear_from_srgb16()[code]), code);
}

TEST(Colour, TablesHoldTheCurve) {
  EXPECT_EQ(linear_from_srgb8()[0], 0);
  EXPECT_EQ(linear_from_srgb8()[255], 1);
  EXPECT_EQ(linear_from_srgb8()[128], static_cast<float>(linear_from_srgb(128 / 255.0)));
  EXPECT_EQ(linear_from_srgb16()[65535], 1);
  EXPECT_EQ(linear_from_srgb16()[257 * 128], linear_from_srgb8()[128]);
}

TEST(Colour, LinearCodesAreCorrectlyRounded) {
  const std::vector<float> values = {-1,   0, 0.5F / 255, std::nextafter(0.5F / 255, 0.0F),
                                     0.5F, 1, 2,          std::nanf("")};
  std::vector<std::uint8_t> codes(values.size());
  encode_linear(values, std::span(codes));
  EXPECT_EQ(codes, (std::vector<std::uint8_t>{0, 0, 1, 0, 128, 255, 255, 0}));
  std::vector<std::uint16_t> wide(values.size());
  encode_linear(values, std::span(wide));
  EXPECT_EQ(wide[4], 32768);
  EXPECT_EQ(wide[5], 65535);
}

}  // namespace
}  // namespace laterna::image
