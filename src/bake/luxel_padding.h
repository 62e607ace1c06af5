// What lies between the surfaces of a page.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "laterna/image.h"

namespace laterna::bake {

/// Continues what is found by so many luxels: each takes the mean of its neighbours that lie nearer to a surface. Pictures hold
/// floats or 8 bits, and are as large as `is_found` is long, row by row. Returns how many luxels were filled.
std::size_t continue_surfaces(std::span<Image* const> pictures, std::span<const std::uint8_t> is_found,
                              int luxels);

}  // namespace laterna::bake
