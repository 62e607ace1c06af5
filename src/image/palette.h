// Pictures of at most 256 colours, for GIF.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "laterna/image.h"

namespace laterna::image {

using Rgb = std::array<std::uint8_t, 3>;

struct PalettePicture {
  std::vector<Rgb> colours;          ///< 1…256
  std::vector<std::uint8_t> pixels;  ///< places in `colours`, rows from the top
};

/// A picture of no more than 256 colours stays as it is. Of others, boxes of colours are halved at their mean, the one with
/// the largest sum of squared errors first (after Heckbert, Color Image Quantization for Frame Buffer Display, 1982, and Wan,
/// Wong and Prusinkiewicz, An Algorithm for Multidimensional Data Clustering, 1988); each pixel then takes the nearest
/// colour after an ordered 8 × 8 dither (Bayer, 1973) as strong as those colours are apart: patterns that stand still from
/// frame to frame, where error diffusion would swarm. `frame`: 8-bit R, G, B.
PalettePicture reduce_colours(const Image& frame);

}  // namespace laterna::image
