// Between linear light and the stored codes of 8- and 16-bit pictures (IEC 61966-2-1, "sRGB"). Every result
// is the correctly rounded one, so it is the same on every machine: encode(x) is the code nearest to largest
// · srgb(x). Values outside [0, 1] take the nearer end; NaN becomes 0.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace laterna::image {

/// codes[i] from linear[i]; both of one length.
void encode_srgb(std::span<const float> linear, std::span<std::uint8_t> codes);
void encode_srgb(std::span<const float> linear, std::span<std::uint16_t> codes);

/// The same without the curve: for alpha, and for data.
void encode_linear(std::span<const float> linear, std::span<std::uint8_t> codes);
void encode_linear(std::span<const float> linear, std::span<std::uint16_t> codes);

/// How 8-bit codes are found: by one look-up for each float in [kLowest, 1), since among 2^16 floats that share their
/// leading bits the code changes at most once. What lies below is black, NaN too; what lies above is white.
class CodeSteps {
 public:
  static constexpr std::uint32_t kOneBits = 0x3F800000U;
  static constexpr std::uint32_t kBucketBits = 16;  // of the float that do not choose its bucket
  static constexpr std::uint32_t kLowestBits =
      kOneBits - (13U << 23U);  // 2^−13, below the first value of code 1
  static constexpr std::size_t kBuckets = (kOneBits - kLowestBits) >> kBucketBits;

  /// The smallest float of each code > 0, rising; the last is 1.
  using FirstValues = std::array<float, 257>;
  explicit CodeSteps(const FirstValues& first_values);

  /// For a float of these bits the code is (steps()[(bits − kLowestBits) >> kBucketBits] + (bits & 0xFFFF)) >> 16: the
  /// sum carries where the float reaches the next code.
  [[nodiscard]] const std::uint32_t* steps() const { return steps_.data(); }
  [[nodiscard]] std::uint8_t operator()(float value) const;

 private:
  alignas(64) std::array<std::uint32_t, kBuckets> steps_ = {};
};
const CodeSteps& srgb_steps();
const CodeSteps& linear_steps();

/// Linear light of every code: the float nearest to the curve's value. Built on first use.
const std::array<float, 256>& linear_from_srgb8();
const std::array<float, 65536>& linear_from_srgb16();

}  // namespace laterna::image
