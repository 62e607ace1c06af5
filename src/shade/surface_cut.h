// Cut-out materials while rasterising.
#pragma once

#include "raster/alpha_cut.h"
#include "shade/pixel_rays.h"
#include "shade/surface_points.h"

namespace laterna::shade {

/// What finding the alpha of samples needs to know of where they come from.
struct CutSource {
  PointSource points;
  PixelRays rays;  ///< of points.view
  /// Alpha is read from the full-size texture instead of the size that suits the view. Shadow maps do, so that what
  /// casts a shadow does not depend on how large the light sees it.
  bool full_size;
};

/// AlphaCut::keep() by the material's cutoff.
using KeepAboveCutoff = void (*)(const CutSource& source, TriangleId id, const raster::CutSamples& samples,
                                 std::uint16_t* kept);
KeepAboveCutoff keep_above_cutoff_for(InstructionSet set);

/// Keeps samples whose alpha reaches the material's cutoff; of blended surfaces, where they are drawn as cut-outs
/// (shadow maps), those that are at least half opaque.
class SurfaceCut final : public raster::AlphaCut {
 public:
  SurfaceCut(const PointSource& source, bool full_size, InstructionSet set)
      : source_{source, PixelRays(*source.view), full_size}, keep_above_cutoff_(keep_above_cutoff_for(set)) {}

  void keep(TriangleId id, raster::CutSamples& samples, std::uint16_t* kept) const override {
    keep_above_cutoff_(source_, id, samples, kept);
  }

 private:
  CutSource source_;
  KeepAboveCutoff keep_above_cutoff_;
};

}  // namespace laterna::shade
