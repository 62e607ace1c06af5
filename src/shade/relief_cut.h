// Cut-out and relief materials while rasterising for a camera.
#pragma once

#include "shade/surface_cut.h"

namespace laterna::shade {

/// AlphaCut::keep() of a triangle whose surface has a relief: samples move along their rays of sight to where these meet it.
using KeepOnRelief = void (*)(const CutSource& source, TriangleId id, raster::CutSamples& samples,
                              std::uint16_t* kept);
KeepOnRelief keep_on_relief_for(InstructionSet set);

/// SurfaceCut of what a camera sees, with reliefs.
class ReliefCut final : public raster::AlphaCut {
 public:
  ReliefCut(const PointSource& source, InstructionSet set)
      : source_{source, PixelRays(*source.view), false},
        cut_(source, false, set),
        keep_on_relief_(keep_on_relief_for(set)) {}

  void keep(TriangleId id, raster::CutSamples& samples, std::uint16_t* kept) const override {
    if ((source_.points.frame->clusters[cluster_of(id)].flags & kRelief) != 0) {
      keep_on_relief_(source_, id, samples, kept);
    } else {
      cut_.keep(id, samples, kept);
    }
  }

 private:
  CutSource source_;
  SurfaceCut cut_;
  KeepOnRelief keep_on_relief_;
};

}  // namespace laterna::shade
