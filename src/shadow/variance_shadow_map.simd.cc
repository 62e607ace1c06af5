// Look-ups in filtered moments.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shadow/variance_shadow_map.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "shadow/depth_measure-inl.h"
#include "shadow/map_reader-inl.h"
#include "shadow/variance_shadow_map.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// Texels of a map that a pixel's side spans, the longer way: equation 6, differentiated.
HWY_INLINE FloatVector FindFootprint(const BoundDepthMap& bound, const Points& p, FloatVector dq_dx,
                                     FloatVector dq_dy) {
  const ProjectedRow& divisor = bound.is_orthographic ? bound.homogeneous : bound.position.divisor;
  const auto W = Evaluate(divisor, p.x, p.y, p.q);
  const auto inverse = Splat(1.0F) / hn::IfThenElse(hn::Abs(W) > Splat(1e-30F), W, Splat(1.0F));
  const auto x = Evaluate(bound.position.x, p.x, p.y, p.q) * inverse,
             y = Evaluate(bound.position.y, p.x, p.y, p.q) * inverse;
  const auto length_squared = [&](float ProjectedRow::*at, FloatVector dq) HWY_ATTR {
    const auto slope = [&](const ProjectedRow& row)
                           HWY_ATTR { return Splat(row.*at) + Splat(row.at_q) * dq; };
    const auto dw = slope(divisor);
    const auto dx = (slope(bound.position.x) - x * dw) * inverse,
               dy = (slope(bound.position.y) - y * dw) * inverse;
    return dx * dx + dy * dy;
  };
  return hn::Sqrt(
      hn::Max(length_squared(&ProjectedRow::at_x, dq_dx), length_squared(&ProjectedRow::at_y, dq_dy)));
}

struct Moments {
  FloatVector mean, square, negative_mean, negative_square;
};
HWY_INLINE Moments Mix(const Moments& a, const Moments& b, FloatVector weight) {
  const auto mix = [&](FloatVector from, FloatVector to) HWY_ATTR { return from + (to - from) * weight; };
  return {mix(a.mean, b.mean), mix(a.square, b.square), mix(a.negative_mean, b.negative_mean),
          mix(a.negative_square, b.negative_square)};
}

class MomentReader {
 public:
  explicit MomentReader(const MomentMap& map, ShadowMoments kind)
      : map_(map), has_negative_(kind == ShadowMoments::exponential) {}

  // Between two levels, four texels of each (trilinear), whose texels are as wide as the footprint.
  HWY_INLINE Moments Find(FloatVector x, FloatVector y, FloatVector footprint) const {
    const FloatTag d;
    const auto last = Splat(static_cast<float>(map_.levels().size() - 1));
    const auto held = hn::Min(hn::Max(footprint, Splat(1.0F)), Splat(65536.0F));
    const auto level = hn::Min(hn::Max(Logarithm2(held), Splat(0.0F)), last);
    const auto finer = hn::Floor(level), coarser = hn::Min(finer + Splat(1.0F), last);
    const Moments fine = AtLevel(x, y, finer);
    if (hn::AllTrue(d, level <= Splat(0.0F))) return fine;
    return Mix(fine, AtLevel(x, y, coarser), level - finer);
  }

 private:
  HWY_INLINE Moments AtLevel(FloatVector x, FloatVector y, FloatVector level) const {
    const IntTag di;
    // Levels of N samples may differ; there are few.
    auto scale = Splat(1.0F);
    auto width = SplatInt(map_.levels()[0].width), height = SplatInt(map_.levels()[0].height),
         first = SplatInt(0);
    float share = 1;
    for (std::size_t i = 1; i < map_.levels().size(); ++i) {
      share *= 0.5F;
      const MomentLevel& candidate = map_.levels()[i];
      const auto is_it = level == Splat(static_cast<float>(i));
      const auto is_it_int = hn::RebindMask(di, is_it);
      scale = hn::IfThenElse(is_it, Splat(share), scale);
      width = hn::IfThenElse(is_it_int, SplatInt(candidate.width), width);
      height = hn::IfThenElse(is_it_int, SplatInt(candidate.height), height);
      first = hn::IfThenElse(is_it_int, SplatInt(static_cast<std::int32_t>(candidate.first)), first);
    }
    const auto u = Held(x * scale - Splat(0.5F)), v = Held(y * scale - Splat(0.5F));
    const auto floor_u = hn::Floor(u), floor_v = hn::Floor(v);
    const auto i = hn::ConvertTo(di, floor_u), j = hn::ConvertTo(di, floor_v);
    const auto column = [&](IntVector at) HWY_ATTR { return Clamped(at, width); };
    const auto row = [&](IntVector at) HWY_ATTR { return first + Clamped(at, height) * width; };
    const auto left = column(i), right = column(i + SplatInt(1)), top = row(j), bottom = row(j + SplatInt(1));
    const auto weight = u - floor_u;
    return Mix(Mix(Texel(top + left), Texel(top + right), weight),
               Mix(Texel(bottom + left), Texel(bottom + right), weight), v - floor_v);
  }

  HWY_INLINE Moments Texel(IntVector index) const {
    const FloatTag d;
    const auto zero = Splat(0.0F);
    const float* moments = map_.moments();
    if (!has_negative_) {
      const auto at = index + index;
      return {hn::GatherIndex(d, moments, at), hn::GatherIndex(d, moments + 1, at), zero, zero};
    }
    const auto at = hn::ShiftLeft<2>(index);
    return {hn::GatherIndex(d, moments, at), hn::GatherIndex(d, moments + 1, at),
            hn::GatherIndex(d, moments + 2, at), hn::GatherIndex(d, moments + 3, at)};
  }

  HWY_INLINE IntVector Clamped(IntVector at, IntVector count) const {
    return hn::Min(hn::Max(at, SplatInt(0)), count - SplatInt(1));
  }
  // Coordinates far outside would not fit an int.
  HWY_INLINE FloatVector Held(FloatVector v) const {
    return hn::Min(hn::Max(v, Splat(-65536.0F)), Splat(65536.0F));
  }

  const MomentMap& map_;
  bool has_negative_;
};

// Chebyshev's bound; `least` is a floor under the variance.
HWY_INLINE FloatVector UpperBound(FloatVector mean, FloatVector square, FloatVector tested,
                                  FloatVector least) {
  const auto variance = hn::Max(square - mean * mean, least);
  const auto beyond = tested - mean;
  const auto bound = variance / (variance + beyond * beyond);
  return hn::IfThenElse(beyond <= Splat(0.0F), Splat(1.0F), bound);
}

// The variance that rounding of moments may hide, as a share of their squares.
constexpr float kRoundedAway = 4e-7F;

class VarianceReader {
 public:
  VarianceReader(const VarianceShadowTest& test, const BoundDepthMap& bound, const MomentMap& moments)
      : test_(test), bound_(bound), reader_(moments, test.kind) {}

  HWY_INLINE FloatVector Arrival(const Receiver& r, FloatVector footprint) const {
    const raster::RasterView& view = bound_.map->view();
    const auto one = Splat(1.0F);
    const auto depth = MeasuredDepth(test_.measure, view, r.q + ManualBias(r), r.x, r.y);
    // Of two texels side by side, one sees a surface half a texel nearer.
    const auto texel = bound_.is_orthographic ? Splat(bound_.texel_size) : Splat(bound_.texel_size) / r.q;
    const auto step = Splat(kStep * test_.measure.per_metre) * texel;
    const auto rounded = Splat(kRoundedAway);
    const Moments m = reader_.Find(r.x, r.y, footprint);
    FloatVector bound;
    if (test_.kind == ShadowMoments::variance) {
      bound = UpperBound(m.mean, m.square, depth, rounded + step * step);
    } else {
      const auto positive = PositiveWarp(depth), negative = NegativeWarp(depth);
      const auto along = [&](FloatVector warped, float exponent) HWY_ATTR {
        const auto slope = hn::Min(Splat(exponent) * step, one) * warped;
        return rounded * (warped * warped) + slope * slope;
      };
      bound = hn::Min(
          UpperBound(m.mean, m.square, positive, along(positive, kPositiveExponent)),
          UpperBound(m.negative_mean, m.negative_square, negative, along(negative, kNegativeExponent)));
    }
    return WithoutBleeding(bound);
  }

 private:
  // Texels of depth.
  static constexpr float kStep = 0.25F;

  // Metres and slopes that the settings ask for, as reversed depth; there is no automatic bias.
  HWY_INLINE FloatVector ManualBias(const Receiver& r) const {
    const ShadowBias& b = test_.hard.bias;
    if (b.uses_receiver_plane) return Splat(0.0F);
    const auto metres = Splat(b.metres) * (bound_.is_orthographic ? Splat(1.0F) : r.q * r.q);
    return metres + Splat(b.slope) * (hn::Abs(r.q_dx) + hn::Abs(r.q_dy));
  }

  // What is below the reduction is taken to have bled through a caster (Lauritzen 2007).
  HWY_INLINE FloatVector WithoutBleeding(FloatVector bound) const {
    const float kept = 1 - test_.bleeding_reduction;
    if (kept <= 0) return hn::IfThenElseZero(bound >= Splat(1.0F), Splat(1.0F));
    return Saturate((bound - Splat(test_.bleeding_reduction)) / Splat(kept));
  }

  const VarianceShadowTest& test_;
  const BoundDepthMap& bound_;
  MomentReader reader_;
};

void look_up_variance_shadow_map(const VarianceShadowTest& test, const SurfaceSamples& samples,
                                 std::span<const std::uint16_t> wanted, float* alpha) {
  const FloatTag d;
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
      if ((std::uint32_t{wanted[group]} >> k & ((1U << kLanes) - 1)) == 0) continue;
      const std::size_t i = group * kGroupSize + k;
      const Points points = LoadPoints(samples, i);
      const auto dq_dx = hn::Load(d, samples.dq_dx.data() + i), dq_dy = hn::Load(d, samples.dq_dy.data() + i);
      auto result = Splat(test.hard.outside_is_lit ? 1.0F : 0.0F);
      ForEachMap(test.hard, points, [&](const BoundDepthMap& map, const Share& share) HWY_ATTR {
        const auto here = share.here;
        const MapReader reader(test.hard, map, samples.position_error);
        const Receiver r = reader.Find(points);
        const auto zero = Splat(0.0F);
        const auto width = Splat(static_cast<float>(map.map->width())),
                   height = Splat(static_cast<float>(map.map->height()));
        const auto is_inside =
            hn::And(hn::And(r.x >= zero, r.x <= width), hn::And(r.y >= zero, r.y <= height));
        const VarianceReader variance(test, map,
                                      test.maps[static_cast<std::size_t>(&map - test.hard.maps.data())]);
        const auto arrival = variance.Arrival(r, FindFootprint(map, points, dq_dx, dq_dy));
        const auto covered = hn::And(here, hn::And(r.is_seen, is_inside));
        result = hn::IfThenElse(covered, arrival, result);
      });
      hn::Store(result, d, alpha + i);
    }
  }
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shadow {
LATERNA_KERNEL_TABLE(look_up_variance_shadow_map)
}  // namespace laterna::shadow
#endif
