// Cut-out materials while rasterising.
#pragma once

#include "raster/alpha_cut.h"
#include "shade/surface_points.h"

namespace laterna::shade {

/// Keeps samples whose alpha reaches the material's cutoff; of blended surfaces, where they are drawn as cut-outs
/// (shadow maps), those that are at least half opaque.
class SurfaceCut final : public raster::AlphaCut {
 public:
  /// `full_size`: alpha is read from the full-size texture. Shadow maps do, so that what casts a shadow does not
  /// depend on how large the light sees it.
  SurfaceCut(const PointSource& source, bool full_size, InstructionSet set)
      : source_(source), full_size_(full_size), keep_above_cutoff_(keep_above_cutoff_for(set)) {}

  [[nodiscard]] std::uint32_t keep(TriangleId id, const raster::BlockSamples& samples,
                                   std::uint32_t mask) const override;

 private:
  PointSource source_;
  bool full_size_;
  KeepAboveCutoff keep_above_cutoff_;
};

}  // namespace laterna::shade
