// Linear colour in planes to 8-bit pixels, for pictures on their way to the screen.
#pragma once

#include <cstddef>
#include <cstdint>

#include "laterna/instruction_set.h"

namespace laterna::image {

/// Planes start on a cache line.
struct LinearPixels {
  const float *r, *g, *b;
  const float* alpha;  ///< null: opaque; else colours are multiplied by it, and are divided by it here
  float exposure;      ///< factor on the colours
};

/// pixels[i] = r | g << 8 | b << 16 | alpha << 24: colours in sRGB codes, exactly those of encode_srgb(), alpha in
/// encode_linear()'s, 0 where there is none. `count` is a multiple of 16.
using EncodePixels = void (*)(const LinearPixels& linear, std::size_t count, std::uint32_t* pixels);
EncodePixels encode_pixels_for(InstructionSet set);

}  // namespace laterna::image
