// How a material may cut holes into the triangles that are rasterised.
#pragma once

#include <cstdint>

#include "base/triangle_clusters.h"

namespace laterna::raster {

/// The 16 samples of a block: sample i lies at (x + i % 4, y + i / 4), in pixels from the view's origin.
struct BlockSamples {
  float x, y;
  const float* reversed_depth;  // 16
};

/// Asked during rasterisation about the covered, visible samples of cut-out triangles.
class AlphaCut {
 public:
  virtual ~AlphaCut() = default;
  /// Bits of `mask` whose sample the material keeps. Called from several threads at once.
  [[nodiscard]] virtual std::uint32_t keep(TriangleId id, const BlockSamples& samples,
                                           std::uint32_t mask) const = 0;
};

}  // namespace laterna::raster
