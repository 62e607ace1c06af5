// Where rays of sight meet the relief of a triangle.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/relief_cut.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "frame/surface_alpha-inl.h"
#include "shade/relief_cut.h"
#include "shade/relief_hit-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using frame::HWY_NAMESPACE::FindReliefCoordinates;
using frame::HWY_NAMESPACE::TriangleCorners;

// The samples of one triangle.
class ReliefKeeper {
 public:
  ReliefKeeper(const CutSource& source, TriangleId id)
      : source_(source),
        frame_(*source.points.frame),
        surface_(frame_.surfaces[frame_.clusters[cluster_of(id)].material]),
        corners_(frame_, &id),
        facet_(FindFacet<true>(source.rays, corners_.Positions())),
        coordinates_(FindReliefCoordinates(frame_, surface_.relief, corners_)),
        chart_(frame_.relief_charts[cluster_of(id)]) {}

  // Moves samples i … i + kLanes − 1 and returns the bits of those that are kept.
  HWY_INLINE std::uint32_t Move(raster::CutSamples& samples, std::size_t i) const {
    const FloatTag d;
    const auto x = hn::Load(d, samples.x.data() + i), y = hn::Load(d, samples.y.data() + i);
    const Displaced displaced = DisplaceSample(source_.rays, facet_, surface_.relief, coordinates_, x, y,
                                               hn::Load(d, samples.reversed_depth.data() + i));
    hn::Store(displaced.q, d, samples.reversed_depth.data() + i);
    auto kept = displaced.q >= displaced.q;  // all
    const bool is_cut_out = surface_.alpha_mode == AlphaMode::mask;
    if (!is_cut_out && !surface_.relief.cut_edges) return BitsOf(kept);
    const Hit hit = FindReliefHit(source_.rays, facet_, x, y, displaced.q);
    if (surface_.relief.cut_edges) kept = hn::Or(IsOnChart(hit.weights), displaced.t <= Splat(0.0F));
    if (is_cut_out) {
      const auto alpha = frame::HWY_NAMESPACE::AlphaInView(frame_, surface_, corners_, hit.weights,
                                                           source_.points.anisotropy);
      kept = hn::And(kept, alpha >= Splat(surface_.alpha_cutoff));
    }
    return BitsOf(kept);
  }

 private:
  HWY_INLINE FloatMask IsOnChart(const Weights& weights) const {
    const LatticePoint p = coordinates_.At(weights.b, weights.c);
    const auto within = [](FloatVector at, const frame::ReliefField::Axis& axis, float low,
                           float high) HWY_ATTR {
      const auto scale = Splat(axis.scale), offset = Splat(axis.offset);
      return hn::And(at >= Splat(low) * scale + offset, at <= Splat(high) * scale + offset);
    };
    const frame::ReliefField& field = *surface_.relief.field;
    return hn::And(within(p.x, field.x, chart_.low_u, chart_.high_u),
                   within(p.y, field.y, chart_.low_v, chart_.high_v));
  }

  const CutSource& source_;
  const frame::Frame& frame_;
  const frame::Surface& surface_;
  TriangleCorners<true> corners_;
  Facet facet_;
  ReliefCoordinates coordinates_;
  const frame::TextureRectangle& chart_;
};

void keep_on_relief(const CutSource& source, TriangleId id, raster::CutSamples& samples,
                    std::uint16_t* kept) {
  const ReliefKeeper keeper(source, id);
  for (std::size_t group = 0; group < samples.groups(); ++group) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 16; k += kLanes) bits |= keeper.Move(samples, group * 16 + k) << k;
    kept[group] = static_cast<std::uint16_t>(bits);
  }
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shade {
LATERNA_KERNEL_TABLE(keep_on_relief)
}  // namespace laterna::shade
#endif
