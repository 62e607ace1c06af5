#include "image/colour.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>

#include "base/elementary.h"

namespace laterna::image {
namespace {

constexpr int kFloatMantissaBits = 23;
constexpr std::uint32_t kOneBits = std::bit_cast<std::uint32_t>(1.0F);

// The smallest float that is not below `value` > 0.
float round_up(double value) {
  const auto nearest = static_cast<float>(value);
  if (static_cast<double>(nearest) >= value) return nearest;
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) + 1);
}

// Encodes by comparing with the smallest float of each code. A float's leading bits choose a bucket of
// values; its code is that of the bucket's first value, or one of the few after it.
//
// kLowest is a power of two below the first value that is not code 0. Within a bucket of relative width
// 2^−kBucketBits the code grows by at most kLargest · (1.055 / 2.4) · 2^−kBucketBits: below 1 for 8 bits and
// 7, below 15 for 16 bits and 11, which kSteps, halving from kFirstStep, covers.
template <class Code, int kBucketBits, unsigned kFirstStep, int kLowestExponent>
class SrgbEncoder {
 public:
  SrgbEncoder() {
    for (std::size_t code = 1; code <= kLargest; ++code) {
      first_value_[code] = round_up(linear_from_srgb((static_cast<double>(code) - 0.5) / kLargest));
    }
    std::fill(first_value_.begin() + kLargest + 1, first_value_.end(),
              std::numeric_limits<float>::infinity());
    std::size_t code = 0;
    for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
      const auto first =
          std::bit_cast<float>(kLowestBits + static_cast<std::uint32_t>(bucket << kBucketShift));
      while (first_value_[code + 1] <= first) ++code;
      first_code_[bucket] = static_cast<Code>(code);
    }
  }

  [[nodiscard]] Code operator()(float linear) const {
    // Both comparisons are false for NaN, which so becomes the lowest value.
    const float not_low = linear > kLowest ? linear : kLowest;
    const float value = not_low < kBelowOne ? not_low : kBelowOne;
    unsigned code = first_code_[(std::bit_cast<std::uint32_t>(value) - kLowestBits) >> kBucketShift];
    for (unsigned step = kFirstStep; step > 0; step /= 2) {
      code += value >= first_value_[code + step] ? step : 0;
    }
    return static_cast<Code>(code);
  }

 private:
  static constexpr std::size_t kLargest = std::numeric_limits<Code>::max();
  static constexpr std::uint32_t kLowestBits =
      kOneBits - (static_cast<std::uint32_t>(-kLowestExponent) << kFloatMantissaBits);
  static constexpr float kLowest = std::bit_cast<float>(kLowestBits);
  static constexpr float kBelowOne = std::bit_cast<float>(kOneBits - 1);
  static constexpr int kBucketShift = kFloatMantissaBits - kBucketBits;
  static constexpr std::size_t kBuckets = (kOneBits - kLowestBits) >> kBucketShift;

  std::array<float, kLargest + 1 + 2 * kFirstStep> first_value_ = {};  // infinite beyond the largest code
  std::array<Code, kBuckets> first_code_ = {};
};

// The first values that are not black: 0.5 / (255 · 12.92) > 2^−13 and 0.5 / (65535 · 12.92) > 2^−21.
using SrgbEncoder8 = SrgbEncoder<std::uint8_t, 7, 1, -13>;
using SrgbEncoder16 = SrgbEncoder<std::uint16_t, 11, 8, -21>;

template <class Encoder, class Code>
void encode_with(std::span<const float> linear, std::span<Code> codes) {
  static const Encoder encoder;
  for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = encoder(linear[i]);
}

// In double the product of a float and 65535 is exact, and so is the rounding.
template <class Code>
void encode_without_curve(std::span<const float> linear, std::span<Code> codes) {
  constexpr double kLargest = std::numeric_limits<Code>::max();
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const float not_negative = linear[i] > 0 ? linear[i] : 0;
    const float value = not_negative < 1 ? not_negative : 1;
    codes[i] = static_cast<Code>(static_cast<double>(value) * kLargest + 0.5);
  }
}

template <std::size_t kCount>
std::array<float, kCount> linear_table() {
  std::array<float, kCount> table;
  for (std::size_t i = 0; i < kCount; ++i) {
    table[i] = static_cast<float>(linear_from_srgb(static_cast<double>(i) / static_cast<double>(kCount - 1)));
  }
  return table;
}

}  // namespace

void encode_srgb(std::span<const float> linear, std::span<std::uint8_t> codes) {
  encode_with<SrgbEncoder8>(linear, codes);
}
void encode_srgb(std::span<const float> linear, std::span<std::uint16_t> codes) {
  encode_with<SrgbEncoder16>(linear, codes);
}
void encode_linear(std::span<const float> linear, std::span<std::uint8_t> codes) {
  encode_without_curve(linear, codes);
}
void encode_linear(std::span<const float> linear, std::span<std::uint16_t> codes) {
  encode_without_curve(linear, codes);
}

const std::array<float, 256>& linear_from_srgb8() {
  static const std::array<float, 256> table = linear_table<256>();
  return table;
}

const std::array<float, 65536>& linear_from_srgb16() {
  static const std::array<float, 65536> table = linear_table<65536>();
  return table;
}

}  // namespace laterna::image
