// Photographs at surface samples: which may see a sample, what colour they give it, and how much each counts.
#pragma once

#include <glm/vec3.hpp>

#include "frame/frame.h"
#include "laterna/instruction_set.h"
#include "shade/surface_points.h"
#include "shadow/projected_view.h"
#include "shadow/surface_samples.h"

namespace laterna::shade {

/// A photograph bound to the rays of the samples it will be thrown back on. What the kernels read.
struct BoundPhotograph {
  shadow::ProjectedView picture_position;  // (s, t), (0, 0) the picture's top-left corner
  shadow::ProjectedRow homogeneous;
  float position_ws[3], forward_ws[3], gain[3];
  float pixels_at_unit;  // pixels per square metre of a surface square to the axis, 1 m along it
  bool by_view;          // PhotographBlend::view
  const image::MipChain* picture;
  const image::MipChain* feather;  // in r: 0 at what must show no seam, 1 well inside; null: 1
  int anisotropy;

  BoundPhotograph(const frame::PlacedPhotograph& placed, const raster::RasterView::Ray& ray,
                  PhotographBlend blend, const image::MipChain* feather, int anisotropy);
};

/// Sums over the photographs so far.
struct PhotographSums {
  shadow::SampleArray<float> r, g, b, weight;
  shadow::SampleArray<float> seen;  // number of photographs
};

/// What one photograph gave: weight 0 where it does not see the sample.
struct PhotographColor {
  shadow::SampleArray<float> r, g, b, weight;
};

/// Samples in a photograph's frame whose surface faces it: a bit each, by group.
using FindFaced = void (*)(const BoundPhotograph& photograph, const shadow::SurfaceSamples& samples,
                           std::span<std::uint16_t> faced);
FindFaced find_faced_for(InstructionSet set);

/// Looks the photograph up where `seen` has a bit and adds it to the sums. `color`: in linear light, before gain.
using AddPhotograph = void (*)(const BoundPhotograph& photograph, const shadow::SurfaceSamples& samples,
                               const SurfacePoints& points, std::span<const std::uint16_t> seen,
                               PhotographSums& sums, PhotographColor& color);
AddPhotograph add_photograph_for(InstructionSet set);

/// Base colours: the weighted means, or `unseen`.
using TakePhotographs = void (*)(const PhotographSums& sums, const glm::vec3& unseen, std::size_t groups,
                                 SurfacePoints& points);
TakePhotographs take_photographs_for(InstructionSet set);

}  // namespace laterna::shade
