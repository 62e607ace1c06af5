// Rectangles of whole luxels side by side in pages.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

namespace laterna::bake {

struct PackedRectangles {
  struct Place {
    std::size_t page = 0;
    glm::ivec2 corner{0};  ///< the lesser one, in luxels
  };
  std::vector<Place> places;      ///< in the order of what was packed
  std::vector<glm::ivec2> pages;  ///< width and height of each, no larger than needed
};

/// Packs rectangles so that at least `gap` luxels lie between any two. All go on one page, of the smallest power of two that
/// holds them, where `max_side` allows; else on several of that side. Each lies as low as it can, then as far left: the
/// skyline algorithm (Jylänki 2010, A thousand ways to pack the bin, section 3), the highest first.
/// No side may be less than 1 or greater than `max_side`. Nothing: they need more than `max_pages`.
std::optional<PackedRectangles> pack_rectangles(std::span<const glm::ivec2> sizes, int gap, int max_side,
                                                std::size_t max_pages);

}  // namespace laterna::bake
