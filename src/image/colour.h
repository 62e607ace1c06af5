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

/// Linear light of every code: the float nearest to the curve's value. Built on first use.
const std::array<float, 256>& linear_from_srgb8();
const std::array<float, 65536>& linear_from_srgb16();

}  // namespace laterna::image
