// Casters as a warped shadow map has them: the same triangles, with every vertex moved by the warp.
#pragma once

#include <vector>

#include "base/aligned_vector.h"
#include "base/task_pool.h"
#include "light/light_plan.h"
#include "raster/alpha_cut.h"
#include "raster/raster_view.h"

namespace laterna::render {

class WarpedCasters {
 public:
  /// `geometry` stays while this lives. Clusters that reach behind the warp's eye are left out: nothing that the map is
  /// asked about lies in their shadow (see light::light_space_perspective_view).
  WarpedCasters(const TriangleClusters& geometry, const light::Warp& warp, const TaskPool& pool);
  [[nodiscard]] TriangleClusters geometry() const;

 private:
  void warp_cluster(const TriangleClusters& from, const light::Warp& warp, Cluster& cluster);

  AlignedVector<glm::vec3> positions_;
  std::vector<Cluster> clusters_;
  const std::uint32_t* corners_;
};

/// Holes of cut-outs, asked where they are in the unwarped world: on the light's own rays.
class WarpedCut final : public raster::AlphaCut {
 public:
  /// All stay while this lives. `cut` looks from `unwarped`.
  WarpedCut(const raster::AlphaCut& cut, const light::Warp& warp, const raster::RasterView& warped,
            const raster::RasterView& unwarped);
  void keep(TriangleId id, raster::CutSamples& samples, std::uint16_t* kept) const override;

 private:
  const raster::AlphaCut& cut_;
  // Pixel-homogeneous (x, y, reversed depth, 1) of one view from the other's.
  glm::dmat4 unwarped_from_warped_{1.0};
};

}  // namespace laterna::render
