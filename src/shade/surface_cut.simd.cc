// Which samples of a cut-out are no holes.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/surface_cut.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "frame/surface_alpha-inl.h"
#include "frame/triangle_corners-inl.h"
#include "shade/surface_cut.h"
#include "shade/surface_hit-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// Bits of samples i … i + kLanes − 1.
HWY_INLINE std::uint32_t FindKept(const CutSource& source, const frame::Surface& surface,
                                  const frame::HWY_NAMESPACE::TriangleCorners<true>& corners,
                                  const Facet& facet, const raster::CutSamples& samples, std::size_t i) {
  const FloatTag d;
  const Hit hit =
      FindHit(source.rays, facet, hn::Load(d, samples.x.data() + i), hn::Load(d, samples.y.data() + i),
              hn::Load(d, samples.reversed_depth.data() + i), source.points.interpolation);
  const frame::Frame& frame = *source.points.frame;
  const auto alpha =
      source.full_size
          ? frame::HWY_NAMESPACE::AlphaAtFullSize(frame, surface, corners, hit.weights)
          : frame::HWY_NAMESPACE::AlphaInView(frame, surface, corners, hit.weights, source.points.anisotropy);
  return BitsOf(alpha >= Splat(surface.alpha_cutoff));
}

void keep_above_cutoff(const CutSource& source, TriangleId id, const raster::CutSamples& samples,
                       std::uint16_t* kept) {
  const frame::Frame& frame = *source.points.frame;
  const frame::Surface& surface = frame.surfaces[frame.clusters[cluster_of(id)].material];
  const frame::HWY_NAMESPACE::TriangleCorners<true> corners(frame, &id);
  const Facet facet = FindFacet<true>(source.rays, corners.Positions());
  for (std::size_t group = 0; group < samples.groups(); ++group) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 16; k += kLanes)
      bits |= FindKept(source, surface, corners, facet, samples, group * 16 + k) << k;
    kept[group] = static_cast<std::uint16_t>(bits);
  }
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shade {
LATERNA_KERNEL_TABLE(keep_above_cutoff)
}  // namespace laterna::shade
#endif
