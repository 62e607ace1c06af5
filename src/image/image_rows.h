// Whole rows of a picture.
#pragma once

#include <cstddef>
#include <span>

#include "laterna/image.h"

namespace laterna::image {

/// The bytes of row y.
std::span<std::byte> row_bytes(Image& image, int y);
std::span<const std::byte> row_bytes(const Image& image, int y);

/// Turns the picture upside down: for formats whose first row is the lowest.
void flip_rows(Image& image);

/// Swaps left and right.
void mirror_rows(Image& image);

}  // namespace laterna::image
