#include "shade/surface_cut.h"

#include "frame/surface_alpha.h"

namespace laterna::shade {

std::uint32_t SurfaceCut::keep(TriangleId id, const raster::BlockSamples& samples, std::uint32_t mask) const {
  const frame::Frame& frame = *source_.frame;
  const frame::Surface& surface = frame.surfaces[frame.clusters[cluster_of(id)].material];
  const CutBlock block = {id, samples.x, samples.y, samples.reversed_depth, full_size_};
  return mask & keep_above_cutoff_(source_, surface, frame::cutoff_of(surface), block);
}

}  // namespace laterna::shade
