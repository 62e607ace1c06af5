// How a material may cut holes into the triangles that are rasterised, and push their samples back.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/triangle_clusters.h"

namespace laterna::raster {

/// Samples of one triangle, in any order, with copies of one up to a multiple of 16: places in pixels from the view's
/// origin.
struct CutSamples {
  static constexpr std::size_t kMost = 256;
  alignas(64) std::array<float, kMost> x, y, reversed_depth;
  std::size_t count = 0;

  [[nodiscard]] std::size_t groups() const { return (count + 15) / 16; }
};

/// Asked during rasterisation about the covered, visible samples of cut-out triangles.
class AlphaCut {
 public:
  virtual ~AlphaCut() = default;
  /// Sets bit i % 16 of kept[i / 16] where the material keeps sample i, and may make its reversed depth less. What becomes
  /// of a sample must not depend on those asked about beside it. Called from several threads at once.
  virtual void keep(TriangleId id, CutSamples& samples, std::uint16_t* kept) const = 0;
};

}  // namespace laterna::raster
