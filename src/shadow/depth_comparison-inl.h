// The comparison of depth_comparison.h, for one number or N at a time. There is no other: every filter asks it.
#if defined(LATERNA_SHADOW_DEPTH_COMPARISON_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADOW_DEPTH_COMPARISON_INL_H_
#undef LATERNA_SHADOW_DEPTH_COMPARISON_INL_H_
#else
#define LATERNA_SHADOW_DEPTH_COMPARISON_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {

// Value: float or FloatVector. All three are reversed depths, which grow toward the light.
template <class Value>
HWY_INLINE auto IsLit(Value stored, Value tested, Value bias) {
  return stored <= tested + bias;
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
