// The PNG that most pictures are: 8 bits per channel, no palette, not interlaced, whole. It is read about twice as fast
// as libpng reads it.
#pragma once

#include <cstddef>
#include <span>

#include "laterna/image.h"

namespace laterna::image {

/// Fills `image`, which has the file's size and channels. False where the file is anything else, or damaged: libpng
/// then knows how to read it, or what to say. What `image` holds is unspecified then. May throw std::bad_alloc.
bool read_plain_png(std::span<const std::byte> file, Image& image);

}  // namespace laterna::image
