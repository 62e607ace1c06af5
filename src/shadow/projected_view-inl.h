// Equation 6, N samples at a time.
#if defined(LATERNA_SHADOW_PROJECTED_VIEW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADOW_PROJECTED_VIEW_INL_H_
#undef LATERNA_SHADOW_PROJECTED_VIEW_INL_H_
#else
#define LATERNA_SHADOW_PROJECTED_VIEW_INL_H_
#endif

#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "shadow/projected_view.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

HWY_INLINE FloatVector Evaluate(const ProjectedRow& row, FloatVector x, FloatVector y, FloatVector q) {
  return (Splat(row.at_0) + Splat(row.at_x) * x) + (Splat(row.at_y) * y + Splat(row.at_q) * q);
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
