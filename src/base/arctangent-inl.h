// The direction of vectors in a plane, the same on every instruction set. Included once per target by *.simd.cc files.
#if defined(LATERNA_BASE_ARCTANGENT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_BASE_ARCTANGENT_INL_H_
#undef LATERNA_BASE_ARCTANGENT_INL_H_
#else
#define LATERNA_BASE_ARCTANGENT_INL_H_
#endif

#include <hwy/highway.h>

#include "base/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::HWY_NAMESPACE {

// Angle of (x, y) from +X in degrees, in [−180, 180]; 0 for (0, 0). Error below 3e-5 degrees. The series of atan up to
// tan(π/8), beyond it atan(t) = π/4 + atan((t − 1) / (t + 1)), and the octants by symmetry.
HWY_INLINE FloatVector DegreesOf(FloatVector y, FloatVector x) {
  const auto ax = hn::Abs(x), ay = hn::Abs(y);
  const auto longer = hn::Max(ax, ay), shorter = hn::Min(ax, ay);
  const auto t = shorter / hn::Max(longer, Splat(1e-30F));
  const auto is_steep = t > Splat(0.414213562F);
  const auto u = hn::IfThenElse(is_steep, (t - Splat(1.0F)) / (t + Splat(1.0F)), t);
  const auto z = u * u;
  auto sum = Splat(-1.0F / 15);
  sum = sum * z + Splat(1.0F / 13);
  sum = sum * z + Splat(-1.0F / 11);
  sum = sum * z + Splat(1.0F / 9);
  sum = sum * z + Splat(-1.0F / 7);
  sum = sum * z + Splat(1.0F / 5);
  sum = sum * z + Splat(-1.0F / 3);
  const auto series = (u + u * z * sum) * Splat(57.2957795F);
  auto angle = hn::IfThenElse(is_steep, Splat(45.0F) + series, series);
  angle = hn::IfThenElse(ay > ax, Splat(90.0F) - angle, angle);
  angle = hn::IfThenElse(x < Splat(0.0F), Splat(180.0F) - angle, angle);
  return hn::IfThenElse(y < Splat(0.0F), Splat(0.0F) - angle, angle);
}

}  // namespace laterna::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
