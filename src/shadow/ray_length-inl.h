// How long the rays of a perspective view are beside its axis: what turns depth into distance (row 61).
#if defined(LATERNA_SHADOW_RAY_LENGTH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADOW_RAY_LENGTH_INL_H_
#undef LATERNA_SHADOW_RAY_LENGTH_INL_H_
#else
#define LATERNA_SHADOW_RAY_LENGTH_INL_H_
#endif

#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "raster/raster_view.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// Length of the rays through places (x, y) of a map, as multiples of the distance along its axis.
HWY_INLINE FloatVector RayLength(const raster::RasterView& view, FloatVector x, FloatVector y) {
  const auto across = x - Splat(static_cast<float>(view.origin_x)),
             down = y - Splat(static_cast<float>(view.origin_y));
  const auto along = [&](int k) HWY_ATTR {
    return Splat(static_cast<float>(view.direction_0[k])) +
           Splat(static_cast<float>(view.direction_x[k])) * across +
           Splat(static_cast<float>(view.direction_y[k])) * down;
  };
  const auto a = along(0), b = along(1), c = along(2);
  return hn::Sqrt(a * a + b * b + c * c);
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
