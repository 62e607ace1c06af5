// The elementary functions against the C library's, which is accurate but not the same on every machine.
#include "base/elementary.h"

#include <gtest/gtest.h>

#include <cmath>

namespace laterna {
namespace {

TEST(Elementary, AgreesWithTheLibraryToRounding) {
  for (int i = -20000; i <= 20000; ++i) {
    const double x = i * 0.00173;
    EXPECT_NEAR(sine(x), std::sin(x), 2e-16);
    EXPECT_NEAR(cosine(x), std::cos(x), 2e-16);
    EXPECT_NEAR(arctangent(x), std::atan(x), 5e-16);
    EXPECT_NEAR(exponential2(x) / std::exp2(x), 1, 5e-16);
  }
  for (int i = 1; i <= 20000; ++i) {
    const double x = i * 0.0037;
    EXPECT_NEAR(logarithm2(x), std::log2(x), 4e-16 * std::max(1.0, std::abs(std::log2(x))));
    EXPECT_NEAR(power(x, 2.4) / std::pow(x, 2.4), 1, 4e-15);
  }
  for (int i = -1000; i <= 1000; ++i) {
    const double x = i / 1000.0;
    EXPECT_NEAR(arccosine(x), std::acos(x), 1e-15);
    EXPECT_NEAR(arcsine(x), std::asin(x), 1e-15);
  }
}

TEST(Elementary, HandlesTheEdges) {
  EXPECT_EQ(power(0, 2), 0);
  EXPECT_EQ(power(0, 0), 1);
  EXPECT_EQ(power(7, 0), 1);
  EXPECT_EQ(exponential2(3), 8);
  EXPECT_EQ(exponential2(-2000), 0);
  EXPECT_TRUE(std::isinf(exponential2(2000)));
  EXPECT_EQ(logarithm2(8), 3);
  EXPECT_EQ(arctangent2(0, -1), kPi);
  EXPECT_EQ(arctangent2(0, 0), 0);
  EXPECT_DOUBLE_EQ(arctangent2(-1, -1), -0.75 * kPi);
}

TEST(Elementary, SrgbCurveMeetsTheStandardsPoints) {
  EXPECT_EQ(linear_from_srgb(0), 0);
  EXPECT_NEAR(linear_from_srgb(1), 1, 1e-15);
  EXPECT_NEAR(linear_from_srgb(0.5), 0.21404114048223255, 1e-15);
  for (int i = 0; i <= 1000; ++i)
    EXPECT_NEAR(srgb_from_linear(linear_from_srgb(i / 1000.0)), i / 1000.0, 1e-7);
}

}  // namespace
}  // namespace laterna
