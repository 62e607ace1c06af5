// 8-bit pixels on every instruction set against the curves in double.
#include "image/encode_pixels.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "base/aligned_vector.h"
#include "base/elementary.h"

namespace laterna::image {
namespace {

using Floats = AlignedVector<float>;
constexpr std::size_t kWholeVectors = 16;

// IEC 61966-2-1, rounded; values outside [0, 1] take the nearer end, and what is no number is black.
std::uint32_t srgb_code(float value) {
  if (!(value > 0)) return 0;
  if (value >= 1) return 255;
  return static_cast<std::uint32_t>(std::floor(255 * srgb_from_linear(static_cast<double>(value)) + 0.5));
}
std::uint32_t linear_code(float value) {
  if (!(value > 0)) return 0;
  return static_cast<std::uint32_t>(std::floor(255 * std::min(static_cast<double>(value), 1.0) + 0.5));
}

float step(float value, int floats) {
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) + static_cast<std::uint32_t>(floats));
}

// Every value at which a code of either curve changes with its neighbours, all exponents, and what is no colour.
Floats interesting_values() {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  Floats values = {
      0.0F,          -0.0F,          -1.0F,          -kInfinity,    kInfinity,
      std::nanf(""), -std::nanf(""), 1e-45F,         -1e-45F,       1.0F,
      1.5F,          1e30F,          step(1.0F, -1), step(1.0F, 1), std::numeric_limits<float>::max()};
  for (int code = 1; code <= 255; ++code) {
    const double middle = (code - 0.5) / 255;
    for (const double threshold : {linear_from_srgb(middle), middle}) {
      for (int floats = -3; floats <= 3; ++floats)
        values.push_back(step(static_cast<float>(threshold), floats));
    }
  }
  for (std::uint32_t bits = 0; bits < 0xFF800000U; bits += 0x00040001U)
    values.push_back(std::bit_cast<float>(bits));
  values.resize((values.size() + kWholeVectors - 1) / kWholeVectors * kWholeVectors, 0);
  return values;
}

class EncodePixelsOn : public testing::TestWithParam<InstructionSet> {
 protected:
  static AlignedVector<std::uint32_t> encoded(const LinearPixels& linear, std::size_t count) {
    AlignedVector<std::uint32_t> pixels(count);
    encode_pixels_for(GetParam())(linear, count, pixels.data());
    return pixels;
  }
};

TEST_P(EncodePixelsOn, ColoursAreCorrectlyRounded) {
  const Floats values = interesting_values();
  const Floats reversed(values.rbegin(), values.rend());
  const Floats grey(values.size(), 0.5F);
  const auto pixels = encoded({values.data(), grey.data(), reversed.data(), nullptr, 1}, values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    ASSERT_EQ(pixels[i], srgb_code(values[i]) | srgb_code(0.5F) << 8U | srgb_code(reversed[i]) << 16U)
        << values[i] << ' ' << reversed[i];
  }
}

TEST_P(EncodePixelsOn, ExposureIsAFactorOnTheLight) {
  const Floats values = interesting_values();
  for (const float exposure : {0.25F, 3.7F}) {
    const auto pixels =
        encoded({values.data(), values.data(), values.data(), nullptr, exposure}, values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      ASSERT_EQ(pixels[i], srgb_code(values[i] * exposure) * 0x010101U) << values[i];
  }
}

TEST_P(EncodePixelsOn, ColoursAreDividedByAlphaWhichHasNoCurve) {
  const Floats values = interesting_values();
  Floats colour(values.size());
  for (std::size_t i = 0; i < colour.size(); ++i) colour[i] = static_cast<float>(i % 97) / 96;
  const auto pixels = encoded({colour.data(), values.data(), colour.data(), values.data(), 2}, values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float alpha = values[i];
    const auto divided = [&](float c) { return srgb_code(alpha > 0 ? c * 2 / alpha : 0); };
    ASSERT_EQ(pixels[i], divided(colour[i]) | divided(values[i]) << 8U | divided(colour[i]) << 16U |
                             linear_code(alpha) << 24U)
        << colour[i] << ' ' << alpha;
  }
}

INSTANTIATE_TEST_SUITE_P(All, EncodePixelsOn, testing::ValuesIn(supported_instruction_sets()),
                         [](const auto& set) { return std::string(name_of(set.param)); });

}  // namespace
}  // namespace laterna::image
