// Which samples of a cut-out's block are no holes.
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

alignas(64) constexpr float kBlockX[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr float kBlockY[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
alignas(64) constexpr std::int32_t kBit[16] = {1 << 0,  1 << 1,  1 << 2,  1 << 3, 1 << 4,  1 << 5,
                                               1 << 6,  1 << 7,  1 << 8,  1 << 9, 1 << 10, 1 << 11,
                                               1 << 12, 1 << 13, 1 << 14, 1 << 15};

std::uint32_t keep_above_cutoff(const CutSource& source, TriangleId id, const raster::BlockSamples& samples,
                                std::uint32_t mask) {
  const FloatTag d;
  const IntTag di;
  const frame::Frame& frame = *source.points.frame;
  const frame::Surface& surface = frame.surfaces[frame.clusters[cluster_of(id)].material];
  const frame::HWY_NAMESPACE::TriangleCorners<true> corners(frame, &id);
  const Facet facet = FindFacet(source.rays, corners.Positions());
  // Samples that are not asked about become copies of one that is: they read no texels of their own.
  const auto first = static_cast<std::size_t>(__builtin_ctz(mask));
  const auto first_x = Splat(kBlockX[first]), first_y = Splat(kBlockY[first]),
             first_q = Splat(samples.reversed_depth[first]);
  std::uint32_t kept = 0;
  for (std::size_t k = 0; k < shadow::kGroupSize; k += kLanes) {
    if ((mask >> k & ((1U << kLanes) - 1)) == 0) continue;
    const auto bits = hn::And(SplatInt(static_cast<std::int32_t>(mask)), hn::Load(di, kBit + k));
    const auto is_asked = hn::RebindMask(d, bits != hn::Zero(di));
    const auto x = hn::IfThenElse(is_asked, hn::Load(d, kBlockX + k), first_x);
    const auto y = hn::IfThenElse(is_asked, hn::Load(d, kBlockY + k), first_y);
    const auto q = hn::IfThenElse(is_asked, hn::LoadU(d, samples.reversed_depth + k), first_q);
    const Hit hit = FindHit(source.rays, facet, Splat(samples.x) + x, Splat(samples.y) + y, q,
                            source.points.interpolation);
    const auto alpha = source.full_size
                           ? frame::HWY_NAMESPACE::AlphaAtFullSize(frame, surface, corners, hit.weights)
                           : frame::HWY_NAMESPACE::AlphaInView(frame, surface, corners, hit.weights,
                                                               source.points.anisotropy);
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, alpha >= Splat(frame::cutoff_of(surface)), bytes);
    kept |= (bytes[0] | std::uint32_t{bytes[1]} << 8U) << k;
  }
  return kept & mask;
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shade {
LATERNA_KERNEL_TABLE(keep_above_cutoff)
}  // namespace laterna::shade
#endif
