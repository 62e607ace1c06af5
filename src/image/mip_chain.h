// A picture prepared for look-ups: texels in the format that filters fastest, at every size down to 1 × 1.
#pragma once

#include <array>
#include <cstdint>

#include "base/aligned_vector.h"
#include "laterna/image.h"
#include "laterna/instruction_set.h"

namespace laterna::image {

/// How texels are stored. All values that come out of a look-up are linear.
enum class TexelFormat : std::uint8_t {
  /// Linear colour in [0, 1] as its square root, 11 + 11 + 10 bits: decoding is one multiplication. The error
  /// is at most 0.09 of a step of 8-bit sRGB in red and green, 0.18 in blue. What colour comes in 8-bit sRGB is
  /// stored so; alpha has a plane of its own.
  colour,
  /// Four 8-bit numbers divided by 255: normals, roughness, …
  data,
  /// Three floats: HDR and 16-bit pictures.
  wide,
};

/// The largest codes of TexelFormat::colour.
inline constexpr float kLargestRedGreen = 2047, kLargestBlue = 1023;

struct MipLevel {
  std::int32_t width, height;
  std::uint32_t first;  // texel
};

inline constexpr int kMaxMipLevels = 17;  // of a side of 65536

struct MipChain {
  TexelFormat format = TexelFormat::colour;
  int level_count = 0;
  std::array<MipLevel, kMaxMipLevels> levels{};
  AlignedVector<std::uint32_t> texels;  // colour: r << 21 | g << 10 | b; data: r | g << 8 | b << 16 | a << 24
  AlignedVector<float> wide;            // r plane, then g, then b, each `texel_count` long
  AlignedVector<std::uint8_t>
      alpha;  // one per texel plus 3 readable bytes; empty: opaque, or in `texels` (data)
  std::uint32_t texel_count = 0;

  [[nodiscard]] bool has_alpha() const { return format == TexelFormat::data || !alpha.empty(); }
  [[nodiscard]] int width() const { return levels[0].width; }
  [[nodiscard]] int height() const { return levels[0].height; }
  [[nodiscard]] std::size_t memory_bytes() const {
    return texels.capacity() * 4 + wide.capacity() * 4 + alpha.capacity();
  }
};

enum class MipUse : std::uint8_t {
  colour,             ///< decoded by the picture's transfer function
  colour_with_alpha,  ///< the same, keeping alpha
  data,               ///< numbers as stored, whatever the picture says of its transfer
};

/// Each level is the area-weighted mean, in linear light, of the one below (odd sizes too). Grey is spread
/// over r, g and b. Pictures of more than 2³¹ texels over all levels are refused by read_image already.
MipChain make_mip_chain(const Image& picture, MipUse use, InstructionSet set = best_instruction_set());

/// Linear r, g, b, alpha of one texel, for tests and for rays.
std::array<float, 4> texel(const MipChain& chain, int level, int x, int y);

}  // namespace laterna::image
