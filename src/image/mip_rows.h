// Rows of a mip chain while it is made: floats in planes of r, g, b and alpha. One level's row from rows of the level
// before it, and floats to stored texels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/aligned_vector.h"
#include "laterna/instruction_set.h"

namespace laterna::image {

/// A plane of `width` texels takes this many floats, which may all be read and written: kernels work in whole vectors,
/// and read two of them past the texels that they make one from.
constexpr std::size_t plane_stride(std::size_t width) { return (width + 63) / 32 * 32; }

/// Which texels of the level before a texel is the mean of, along one axis, and what each counts. Texel i covers those
/// from 2 i on: two where the size was even, three where it was odd, the only one where it was 1.
struct AxisMeans {
  int count = 0;
  std::array<AlignedVector<float>, 3> weights;  ///< of texel 2 i + k for texel i, padded to plane_stride()
};

/// One row of a level. Planes lie behind one another, plane_stride() apart.
struct ShrinkTask {
  int planes;
  std::array<const float*, 3> rows;  ///< of the level before
  std::array<float, 3> row_weights;
  int row_count;
  std::size_t row_stride;
  const AxisMeans* across;
  float* to;
  std::size_t width;
};
using ShrinkRow = void (*)(const ShrinkTask& task);
ShrinkRow shrink_row_for(InstructionSet set);

/// Planes of a row to TexelFormat::colour or TexelFormat::data. `texels` holds plane_stride(width) words.
using EncodeTexels = void (*)(const float* planes, std::size_t width, std::uint32_t* texels);
EncodeTexels encode_colour_for(InstructionSet set);
EncodeTexels encode_data_for(InstructionSet set);

/// One plane to 8 bits. `bytes` holds plane_stride(width).
using EncodeAlpha = void (*)(const float* plane, std::size_t width, std::uint8_t* bytes);
EncodeAlpha encode_alpha_for(InstructionSet set);

}  // namespace laterna::image
