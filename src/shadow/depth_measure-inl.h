// Depths as moment maps measure them, and what is made of them, N at a time.
#if defined(LATERNA_SHADOW_DEPTH_MEASURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADOW_DEPTH_MEASURE_INL_H_
#undef LATERNA_SHADOW_DEPTH_MEASURE_INL_H_
#else
#define LATERNA_SHADOW_DEPTH_MEASURE_INL_H_
#endif

#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "shadow/moment_map.h"
#include "shadow/ray_length-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// `q` is a reversed depth at (x, y), or kNothingSeen. Between −1 and 1.
HWY_INLINE FloatVector MeasuredDepth(const DepthMeasure& measure, const raster::RasterView& view,
                                     FloatVector q, FloatVector x, FloatVector y) {
  const auto is_nothing = q <= Splat(kNothingSeen);
  const auto nearest = Splat(measure.nearest);
  FloatVector metres;
  if (measure.is_orthographic) {
    metres = nearest - q;
  } else {
    auto distance = Splat(1.0F) / hn::Max(q, Splat(1e-30F));
    if (measure.is_radial) distance = distance * RayLength(view, x, y);
    metres = distance - nearest;
  }
  const auto depth = hn::Min(metres * Splat(measure.per_metre), Splat(2.0F)) - Splat(1.0F);
  return hn::IfThenElse(is_nothing, Splat(1.0F), hn::Max(depth, Splat(-1.0F)));
}

constexpr float kLog2E = 1.44269504F;
static_assert(2 * kPositiveExponent * kLog2E < 127, "squares must fit single precision");

HWY_INLINE FloatVector PositiveWarp(FloatVector depth) {
  return Exponential2(depth * Splat(kPositiveExponent * kLog2E));
}
HWY_INLINE FloatVector NegativeWarp(FloatVector depth) {
  return hn::Neg(Exponential2(depth * Splat(-kNegativeExponent * kLog2E)));
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
