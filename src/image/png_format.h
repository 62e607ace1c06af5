// What reading and writing PNG have in common.
#pragma once

#include <array>
#include <cstdint>

#include "laterna/image.h"

namespace laterna::image {

/// The header's colour type for the picture's channels: grey, grey with alpha, RGB, RGBA (PNG specification, 11.2.1).
inline std::uint8_t png_colour_type(const Image& image) {
  constexpr std::array<std::uint8_t, 4> kTypes = {0, 4, 2, 6};
  return kTypes[static_cast<std::size_t>(image.channels() - 1)];
}

}  // namespace laterna::image
