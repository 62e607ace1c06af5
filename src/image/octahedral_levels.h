// Pictures of all directions in the octahedral chart, several of them, as kernels read them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "base/aligned_vector.h"

namespace laterna::image {

/// Each level is a square of side + 2 texels: those around the outside repeat what the chart has beyond its sides, so that
/// interpolation needs to know of no edges.
struct OctahedralLevels {
  struct Level {
    std::int32_t side;
    std::uint32_t first;  // texel of the border's corner
  };
  std::vector<Level> levels;
  AlignedVector<float> r, g, b;

  /// Room for one more level of zeros; returns its number.
  std::size_t add_level(int side);
  /// 0 ≤ x, y < side.
  [[nodiscard]] std::size_t index(std::size_t level, int x, int y) const {
    const Level& l = levels[level];
    return l.first + static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(l.side + 2) +
           static_cast<std::size_t>(x + 1);
  }
  void set(std::size_t level, const std::vector<glm::vec3>& texels);
  /// The border from the texels within.
  void fill_border(std::size_t level);
};

/// Texels in all levels at most: indices are 32 bits wide with a sign.
inline constexpr std::size_t kMaxOctahedralTexels = std::size_t{1} << 28;

/// The levels down to a side of 4, each the mean of four texels of the one before by their solid angles. `texels`: side · side, side a power of
/// two of at least 4.
OctahedralLevels make_octahedral_pyramid(int side, const std::vector<glm::vec3>& texels);

}  // namespace laterna::image
