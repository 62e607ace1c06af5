#include "image/colour.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>

#include "base/elementary.h"

namespace laterna::image {
namespace {

constexpr int kFloatMantissaBits = 23;
constexpr std::uint32_t kOneBits = CodeSteps::kOneBits;
static_assert(kOneBits == std::bit_cast<std::uint32_t>(1.0F));

// The smallest float that is not below `value` > 0.
float round_up(double value) {
  const auto nearest = static_cast<float>(value);
  if (static_cast<double>(nearest) >= value) return nearest;
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) + 1);
}

// The smallest float of an sRGB code > 0.
float first_value(std::size_t code, std::size_t largest) {
  return round_up(linear_from_srgb((static_cast<double>(code) - 0.5) / static_cast<double>(largest)));
}

// Into the values that tables know. Both comparisons are false for NaN, which so becomes the lowest value.
float held(float value, std::uint32_t lowest_bits) {
  const auto lowest = std::bit_cast<float>(lowest_bits);
  constexpr auto kBelowOne = std::bit_cast<float>(kOneBits - 1);
  const float not_low = value > lowest ? value : lowest;
  return not_low < kBelowOne ? not_low : kBelowOne;
}

// Encodes to 16 bits by comparing with the smallest float of each code. A float's leading bits choose a bucket of
// values; its code is that of the bucket's first value, or one of the few after it.
//
// kLowest is a power of two below the first value that is not code 0, 0.5 / (65535 · 12.92). Within a bucket of relative
// width 2^−kBucketBits the code grows by at most kLargest · (1.055 / 2.4) · 2^−kBucketBits: below 15, which the steps,
// halving from kFirstStep, cover.
class SrgbEncoder16 {
 public:
  SrgbEncoder16() {
    for (std::size_t code = 1; code <= kLargest; ++code) first_value_[code] = first_value(code, kLargest);
    std::fill(first_value_.begin() + kLargest + 1, first_value_.end(),
              std::numeric_limits<float>::infinity());
    std::size_t code = 0;
    for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
      const auto first =
          std::bit_cast<float>(kLowestBits + static_cast<std::uint32_t>(bucket << kBucketShift));
      while (first_value_[code + 1] <= first) ++code;
      first_code_[bucket] = static_cast<std::uint16_t>(code);
    }
  }

  [[nodiscard]] std::uint16_t operator()(float linear) const {
    const float value = held(linear, kLowestBits);
    unsigned code = first_code_[(std::bit_cast<std::uint32_t>(value) - kLowestBits) >> kBucketShift];
    for (unsigned step = kFirstStep; step > 0; step /= 2) {
      code += value >= first_value_[code + step] ? step : 0;
    }
    return static_cast<std::uint16_t>(code);
  }

 private:
  static constexpr std::size_t kLargest = std::numeric_limits<std::uint16_t>::max();
  static constexpr unsigned kFirstStep = 8;
  static constexpr std::uint32_t kLowestBits = kOneBits - (21U << kFloatMantissaBits);
  static constexpr int kBucketShift = kFloatMantissaBits - 11;
  static constexpr std::size_t kBuckets = (kOneBits - kLowestBits) >> kBucketShift;

  std::array<float, kLargest + 1 + 2 * kFirstStep> first_value_ = {};  // infinite beyond the largest code
  std::array<std::uint16_t, kBuckets> first_code_ = {};
};

template <class FirstValue>
CodeSteps::FirstValues first_values(FirstValue first_value_of) {
  CodeSteps::FirstValues values = {};
  for (std::size_t code = 1; code < 256; ++code) values[code] = first_value_of(code);
  values[256] = 1;
  return values;
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

CodeSteps::CodeSteps(const FirstValues& first_values) {
  std::uint32_t code = 0;
  for (std::size_t bucket = 0; bucket < kBuckets; ++bucket) {
    const std::uint32_t first = kLowestBits + static_cast<std::uint32_t>(bucket << kBucketBits);
    const std::uint32_t end = first + (1U << kBucketBits);
    const auto next = [&] { return std::bit_cast<std::uint32_t>(first_values[code + 1]); };
    while (next() <= first) ++code;
    const std::uint32_t floats_of_next_code = next() < end ? end - next() : 0;
    steps_[bucket] = (code << kBucketBits) + floats_of_next_code;
  }
}

std::uint8_t CodeSteps::operator()(float value) const {
  const auto bits = std::bit_cast<std::uint32_t>(held(value, kLowestBits));
  const std::uint32_t step = steps_[(bits - kLowestBits) >> kBucketBits];
  return static_cast<std::uint8_t>((step + (bits & ((1U << kBucketBits) - 1))) >> kBucketBits);
}

const CodeSteps& srgb_steps() {
  static const CodeSteps steps(first_values([](std::size_t code) { return first_value(code, 255); }));
  return steps;
}

const CodeSteps& linear_steps() {
  static const CodeSteps steps(
      first_values([](std::size_t code) { return round_up((static_cast<double>(code) - 0.5) / 255); }));
  return steps;
}

void encode_srgb(std::span<const float> linear, std::span<std::uint8_t> codes) {
  const CodeSteps& steps = srgb_steps();
  for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = steps(linear[i]);
}
void encode_srgb(std::span<const float> linear, std::span<std::uint16_t> codes) {
  static const SrgbEncoder16 encoder;
  for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = encoder(linear[i]);
}
void encode_linear(std::span<const float> linear, std::span<std::uint8_t> codes) {
  const CodeSteps& steps = linear_steps();
  for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = steps(linear[i]);
}
// In double the product of a float and 65535 is exact, and so is the rounding.
void encode_linear(std::span<const float> linear, std::span<std::uint16_t> codes) {
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const float not_negative = linear[i] > 0 ? linear[i] : 0;
    const float value = not_negative < 1 ? not_negative : 1;
    codes[i] = static_cast<std::uint16_t>(static_cast<double>(value) * 65535 + 0.5);
  }
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
