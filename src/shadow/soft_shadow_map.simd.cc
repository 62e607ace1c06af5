// Look-ups as wide as penumbrae.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shadow/soft_shadow_map.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "shadow/depth_comparison-inl.h"
#include "shadow/map_reader-inl.h"
#include "shadow/refinement-inl.h"
#include "shadow/soft_shadow_map.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// What stands at reversed depth q_b hides the light's middle from a sample at reversed depth q_r where the map shows it in
// the sample's own place, and hides the point p of the light where it lies (q_b − q_r) p' away from there, p' being p
// as the sample sees it, carried to the light's plane, in texels at distance 1. So the light's shape, times that
// difference, is the shape on the map of all that may hide it: no other constants are needed, and perspective and
// parallel light are the same (with reversed depths in metres).
struct LightExtent {
  FloatVector x_of_a, x_of_b, y_of_a, y_of_b;  // texels per unit of the pattern and of reversed depth

  HWY_INLINE FloatVector X(FloatVector a, FloatVector b) const { return x_of_a * a + x_of_b * b; }
  HWY_INLINE FloatVector Y(FloatVector a, FloatVector b) const { return y_of_a * a + y_of_b * b; }
  // Texels from the middle to the farthest side; a little more where the axes are oblique.
  HWY_INLINE FloatVector Reach() const {
    return hn::Max(hn::Abs(x_of_a) + hn::Abs(x_of_b), hn::Abs(y_of_a) + hn::Abs(y_of_b));
  }
  // Texels from the middle to the side of a disc; of a rectangle the longer side.
  HWY_INLINE FloatVector Radius() const {
    const auto a = x_of_a * x_of_a + y_of_a * y_of_a, b = x_of_b * x_of_b + y_of_b * y_of_b;
    return hn::Sqrt(hn::Max(a, b));
  }
};

// A light's two axes as each sample sees them.
struct LightAxes {
  Vector3 a, b;
};

HWY_INLINE LightAxes FindAxes(const SoftShadowTest& test, const BoundDepthMap& bound, const Points& points) {
  if (test.shape == LightShape::plane) return {Splat3(test.half_x_ws), Splat3(test.half_y_ws)};
  // A ball shows every sample the disc that faces it. The map's own x axis is never the direction of sight.
  const Vector3 sight = Normalised(points.position_ws - Splat3(bound.eye_ws));
  const Vector3 x = Splat3(bound.direction_x_ws);
  const Vector3 a = Normalised(x - sight * Dot(x, sight));
  return {a * Splat(test.radius), Cross(sight, a) * Splat(test.radius)};
}

HWY_INLINE LightExtent FindExtent(const SoftDepthMap& map, const LightAxes& axes, const Receiver& r) {
  const Vector3 x_row = Splat3(map.x_row_ws), y_row = Splat3(map.y_row_ws), w_row = Splat3(map.w_row_ws);
  const auto x = r.x - Splat(map.origin_x), y = r.y - Splat(map.origin_y);
  const auto w_of_a = Dot(w_row, axes.a), w_of_b = Dot(w_row, axes.b);
  return {Dot(x_row, axes.a) - x * w_of_a, Dot(x_row, axes.b) - x * w_of_b, Dot(y_row, axes.a) - y * w_of_a,
          Dot(y_row, axes.b) - y * w_of_b};
}

// Penumbrae less than a texel wide are not soft.
constexpr float kSharpRadius = 0.5F;

// How much more reversed depth than a sample's anything can have that hides some of the light from it. What is nearer the
// light matters farther off, so that each bound on the one bounds the other.
HWY_INLINE FloatVector FindGreatestRise(const NearestPyramid& nearest, const LightExtent& extent,
                                        const Receiver& r, FloatMask asked) {
  constexpr int kRounds = 5;
  alignas(64) float x[kLanes], y[kLanes], q[kLanes], reach[kLanes], rise[kLanes];
  hn::Store(r.x, FloatTag(), x);
  hn::Store(r.y, FloatTag(), y);
  hn::Store(r.q, FloatTag(), q);
  hn::Store(extent.Reach(), FloatTag(), reach);
  const std::uint32_t bits = BitsOf(asked);
  for (std::size_t k = 0; k < kLanes; ++k) {
    rise[k] = 0;
    if ((bits >> k & 1U) == 0) continue;
    rise[k] = nearest.nearest() - q[k];
    for (int round = 0; round < kRounds && rise[k] > 0; ++round) {
      // A texel more, for what straddles the side.
      const float least = nearest.nearest_about(x[k], y[k], reach[k] * rise[k] + 1) - q[k];
      if (least >= rise[k]) break;
      rise[k] = least;
    }
    rise[k] = rise[k] > 0 ? rise[k] : 0;
  }
  return hn::Load(FloatTag(), rise);
}

// A light's map as samples with penumbrae read it.
class PenumbraReader {
 public:
  PenumbraReader(const SoftShadowTest& test, const MapReader& reader, const Receiver& receiver,
                 const LightExtent& extent)
      : test_(test),
        reader_(reader),
        receiver_(reader.Compared(receiver)),
        extent_(extent),
        bias_(reader.Bias(receiver)),
        texel_(Splat(1.0F) / hn::Max(extent.Radius(), Splat(1e-30F))) {
    // A cube's faces end where the next begins; beyond the little that they hold of it their rim stands for it.
    const float beyond = test.maps.size() == 1 ? 1e6F : -0.5F;
    low_ = Splat(-beyond);
    high_x_ = Splat(static_cast<float>(reader.map().width()) + beyond);
    high_y_ = Splat(static_cast<float>(reader.map().height()) + beyond);
  }

  struct Blockers {
    FloatVector mean_rise;  // of what hides some of the light
    FloatMask any,
        all;  // some of the taps found such things; all found something before the receiver's plane
  };
  // `rise`: see FindGreatestRise.
  HWY_INLINE Blockers Search(FloatVector rise) const {
    const TapPattern& pattern = *test_.pattern;
    const auto zero = Splat(0.0F), one = Splat(1.0F);
    auto sum = zero, count = zero;
    auto all = zero <= zero;
    for (int tap = 0; tap < TapPattern::kSearchTaps; ++tap) {
      const Receiver at = Moved(Splat(pattern.search_x[tap]) * rise, Splat(pattern.search_y[tap]) * rise);
      const MapReader::NearestTexel texel = reader_.FindNearest(at);
      const auto is_before = hn::AndNot(IsLit(texel.stored, texel.tested, bias_), texel.is_inside);
      all = hn::And(all, is_before);
      const auto its_rise = texel.stored - receiver_.q;
      const auto hides = hn::And(is_before, its_rise + texel_ >= Splat(pattern.search_size[tap]) * rise);
      sum = sum + hn::IfThenElseZero(hides, its_rise);
      count = count + hn::IfThenElseZero(hides, one);
    }
    return {sum / hn::Max(count, one), count > zero, all};
  }

  // The share of the light that is seen: taps by the mean of what hides it, each weighted between four texels. Where a tap
  // finds something of another depth, it is that depth at which the tap's point of the light would be hidden, so that is
  // where the tap moves to: casters one above the other, near and far, are told apart.
  HWY_INLINE FloatVector Filter(FloatVector mean_rise) const {
    const TapPattern& pattern = *test_.pattern;
    auto sum = Splat(0.0F);
    for (int tap = 0; tap < TapPattern::kFilterTaps; ++tap) {
      const auto a = Splat(pattern.filter_x[tap]), b = Splat(pattern.filter_y[tap]);
      const MapReader::NearestTexel texel = reader_.FindNearest(Moved(a * mean_rise, b * mean_rise));
      const auto is_before = hn::AndNot(IsLit(texel.stored, texel.tested, bias_), texel.is_inside);
      const auto its_rise = hn::Max(texel.stored - receiver_.q, Splat(0.0F));
      const auto rise = hn::IfThenElse(is_before, its_rise, mean_rise);
      sum = sum + FourTexels(Moved(a * rise, b * rise), Splat(kLeastShare * pattern.filter_size[tap]) * rise);
    }
    return sum * Splat(1.0F / TapPattern::kFilterTaps);
  }

 private:
  // What rises by less than this share of what a tap needs to hide its point of the light does not hide it: a wall beside
  // the sample, which the map shows near by, but which stands in the way of no ray. Not all of it is asked for, for
  // casters slope.
  static constexpr float kLeastShare = 0.5F;

  HWY_INLINE FloatVector FourTexels(const Receiver& at, FloatVector least_rise) const {
    const Quad quad = reader_.FindQuad(at);
    FloatVector rows[2];
    for (int j = 0; j < 2; ++j) {
      FloatVector lit[2];
      for (int i = 0; i < 2; ++i) {
        const auto [stored, tested] =
            reader_.DepthsAt(at, quad.column[i] + quad.row[j], quad.dx[i], quad.dy[j]);
        const auto is_low = stored - receiver_.q + texel_ < least_rise;
        const auto is_lit = hn::Or(IsLit(stored, tested, bias_), is_low);
        const auto is_inside = hn::And(quad.column_in[i], quad.row_in[j]);
        lit[i] = hn::IfThenElse(is_inside, hn::IfThenElseZero(is_lit, Splat(1.0F)), reader_.Outside());
      }
      rows[j] = lit[0] + (lit[1] - lit[0]) * quad.weight_x;
    }
    return rows[0] + (rows[1] - rows[0]) * quad.weight_y;
  }

  // Elsewhere on the receiver's plane: (a, b) on the light's shape, for what rises by 1.
  HWY_INLINE Receiver Moved(FloatVector a, FloatVector b) const {
    Receiver at = receiver_;
    at.x = hn::Min(hn::Max(at.x + extent_.X(a, b), low_), high_x_);
    at.y = hn::Min(hn::Max(at.y + extent_.Y(a, b), low_), high_y_);
    at.q = at.q + at.q_dx * (at.x - receiver_.x) + at.q_dy * (at.y - receiver_.y);
    return at;
  }

  const SoftShadowTest& test_;
  const MapReader& reader_;
  Receiver receiver_;
  const LightExtent& extent_;
  FloatVector bias_;
  FloatVector texel_;  // the rise for which the light's shape is a texel wide
  FloatVector low_, high_x_, high_y_;
};

// α of samples that see something before the light from afar, 1 for others, which are `sharp`: what shades them, if
// anything, does so with an edge finer than a texel.
struct SoftArrival {
  FloatVector alpha;
  FloatMask sharp;
};

HWY_INLINE SoftArrival FindSoftArrival(const SoftShadowTest& test, const SoftDepthMap& soft,
                                       const MapReader& reader, const Points& points, FloatMask asked) {
  const FloatTag d;
  const auto one = Splat(1.0F);
  const Receiver r = reader.Find(points);
  const LightExtent extent = FindExtent(soft, FindAxes(test, reader.bound(), points), r);
  const auto seen = hn::And(asked, reader.Covers(r));
  const auto rise = FindGreatestRise(*soft.nearest, extent, r, seen);
  const auto radius = extent.Radius();
  const auto may_be_soft = radius * rise >= Splat(kSharpRadius);
  if (hn::AllFalse(d, may_be_soft)) return {one, seen};
  const PenumbraReader penumbra(test, reader, r, extent);
  const PenumbraReader::Blockers blockers = penumbra.Search(rise);
  const auto is_soft =
      hn::And(may_be_soft, hn::And(blockers.any, radius * blockers.mean_rise >= Splat(kSharpRadius)));
  const auto is_partial = hn::AndNot(blockers.all, is_soft);
  auto alpha = one;
  if (!hn::AllFalse(d, is_partial)) alpha = penumbra.Filter(blockers.mean_rise);
  return {hn::IfThenZeroElse(hn::AndNot(is_partial, is_soft), alpha), hn::AndNot(is_soft, seen)};
}

void look_up_soft_shadow_map(const SoftShadowTest& test, const SurfaceSamples& samples,
                             std::span<const std::uint16_t> wanted, float* alpha) {
  const FloatTag d;
  const ShadowMapTest& hard = test.hard;
  RefinementList unsure;
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
      const std::uint32_t asked = std::uint32_t{wanted[group]} >> k & ((1U << kLanes) - 1);
      if (asked == 0) continue;
      const std::size_t i = group * kGroupSize + k;
      const Points points = LoadPoints(samples, i);
      auto result = Splat(hard.outside_is_lit ? 1.0F : 0.0F);
      auto is_unsure = Splat(0.0F) > Splat(1.0F);
      ForEachMap(hard, points, [&](const BoundDepthMap& map, const Share& share) HWY_ATTR {
        const auto here = share.here;
        const MapReader reader(hard, map, samples.position_error);
        const auto& soft_map = test.maps[static_cast<std::size_t>(&map - hard.maps.data())];
        const SoftArrival soft =
            FindSoftArrival(test, soft_map, reader, points, hn::And(here, MaskFromBits(asked)));
        auto arrival = soft.alpha;
        if (hard.filter == ShadowFilter::refined) {
          const Quick quick = QuickArrival(reader, points);
          arrival = hn::IfThenElse(soft.sharp, quick.alpha, arrival);
          is_unsure = hn::Or(is_unsure, hn::And(hn::And(here, soft.sharp), quick.unsure));
        } else {
          arrival = hn::IfThenElse(soft.sharp, reader.Arrival(reader.Find(points)), arrival);
        }
        const auto covered = reader.Covers(reader.Find(points));
        result = hn::IfThenElse(here, hn::IfThenElse(covered, arrival, reader.Outside()), result);
      });
      hn::Store(result, d, alpha + i);
      unsure.Add(i, is_unsure, asked);
    }
  }
  unsure.Refine(hard, samples, alpha);
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shadow {
LATERNA_KERNEL_TABLE(look_up_soft_shadow_map)
}  // namespace laterna::shadow
#endif
