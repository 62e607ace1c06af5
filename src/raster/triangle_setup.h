// Set-up of one cluster: transform, clip, snap, cull, depth planes. See triangle_setup.simd.cc.
#pragma once

#include "raster/triangle_bins.h"

namespace laterna::raster {

/// What set-up needs of a view, in the precision of the kernels.
struct SetupView {
  const RasterView* view = nullptr;
  float eye_ws[3], x_row[3], y_row[3], w_row[3];
  float x_add, y_add, w_add;
  explicit SetupView(const RasterView& raster_view);
};

/// How a cluster's bounds lie to the view.
enum class ClusterPlace : std::uint8_t {
  outside,  ///< of the pixels wanted, or nearer than near, or beyond far
  inside,   ///< of near plane and guard band: no triangle needs clipping
  crossing,
};

struct SetupTask {
  const SetupView* setup;
  const TriangleClusters* geometry;
  const BinOptions* options;
  std::uint32_t cluster;
  bool crossing;
  double* transform_ms = nullptr;  ///< unless null, what the transformation took is added here
};

/// Pixels from the view's origin that have samples in the bounds of three snapped corners. `reach`: of samples from the
/// pixel's centre.
inline Rect pixels_of(const std::int32_t* x, const std::int32_t* y, int reach) {
  const PixelSpan across = pixels_between(x, -reach, reach), down = pixels_between(y, -reach, reach);
  return {across.begin, down.begin, across.end, down.end};
}

/// Appends the cluster's surviving triangles to the batch.
using SetUpCluster = void (*)(const SetupTask& task, Batch& batch);
SetUpCluster set_up_cluster_for(InstructionSet set);

}  // namespace laterna::raster
