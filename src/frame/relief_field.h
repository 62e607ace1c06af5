// The heights of a relief, as rays are traced through them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/aligned_vector.h"
#include "laterna/image.h"
#include "laterna/relief.h"

namespace laterna::frame {

/// Depths from 0, the polygon's plane, to 1, at the corners of a lattice of cells; within a cell they run bilinearly. A corner
/// is the middle of a texel, so that the surface is what linear filtering of the picture gives.
///
/// Over the cells stands a pyramid of least depths: a node of level k holds the least depth of 2ᵏ × 2ᵏ cells, of fewer at the
/// far sides. A ray that stays above it passes over all of them in one step (Tevs, Ihrke and Seidel, Maximum mipmaps for fast,
/// accurate, and scalable dynamic height field rendering, 2008).
struct ReliefField {
  /// Levels of kMaxReliefSamples in one row, and a cell more.
  static constexpr std::size_t kMaxLevels = 28;

  /// How the lattice goes on to one side and the other.
  struct Axis {
    std::int32_t cells = 0;
    /// Clamped, the outermost cells have no end, and are level across it. Mirrored, they are level, too, and it is in their
    /// middles that the lattice is folded: cells beyond are those before, the other way round.
    Wrap wrap = Wrap::clamp;
    /// Lattice coordinate = texture coordinate · scale + offset; corner i lies at i.
    float scale = 0, offset = 0;
  };

  Axis x, y;
  AlignedVector<float> corners;  ///< (x.cells + 1) · (y.cells + 1), by rows
  AlignedVector<float> least;    ///< of all levels
  std::int32_t levels = 0;
  std::array<std::int32_t, kMaxLevels> first{}, width{};  ///< of a level in `least`, and its nodes per row

  /// Of a picture with finite values; what lies beyond 0 to 1 is taken as the nearest of these.
  ReliefField(const Image& picture, ReliefKind kind, const Sampler& wrap);
};

}  // namespace laterna::frame
