// The formulas of BlendMode, N colours at a time.
#if defined(LATERNA_SHADE_BLEND_MODES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADE_BLEND_MODES_INL_H_
#undef LATERNA_SHADE_BLEND_MODES_INL_H_
#else
#define LATERNA_SHADE_BLEND_MODES_INL_H_
#endif

#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "laterna/blend.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

template <class Formula>
HWY_INLINE Vector3 ByChannel(const Vector3& c, const Vector3& t, const Formula& formula) {
  return {formula(c.x, t.x), formula(c.y, t.y), formula(c.z, t.z)};
}

// 4 Σ (c − ½)(t − ½), held to [0, 1]: GL_DOT3_RGB (OpenGL 1.3, table 3.22).
HWY_INLINE Vector3 Dot3(const Vector3& c, const Vector3& t) {
  const auto half = Splat(0.5F);
  const Vector3 middle = {half, half, half};
  const auto cosine = Saturate(Splat(4.0F) * Dot(c - middle, t - middle));
  return {cosine, cosine, cosine};
}

// f of BlendMode: colour `c` below a layer of colour `t` and alpha `a`.
HWY_INLINE Vector3 BlendColors(BlendMode mode, const Vector3& c, const Vector3& t, FloatVector a) {
  using V = FloatVector;
  const auto zero = Splat(0.0F), one = Splat(1.0F);
  switch (mode) {
    case BlendMode::over:
      return t;
    case BlendMode::modulate:
      return ByChannel(c, t, [](V x, V y) HWY_ATTR { return x * y; });
    case BlendMode::add:
      return c + t;
    case BlendMode::alpha_attenuate:
      return c * a;
    case BlendMode::subtract:
      return ByChannel(c, t, [zero](V x, V y) HWY_ATTR { return hn::Max(x - y, zero); });
    case BlendMode::reverse_subtract:
      return ByChannel(c, t, [zero](V x, V y) HWY_ATTR { return hn::Max(y - x, zero); });
    case BlendMode::difference:
      return ByChannel(c, t, [](V x, V y) HWY_ATTR { return hn::Abs(x - y); });
    case BlendMode::screen:
      return ByChannel(c, t,
                       [one](V x, V y) HWY_ATTR { return (x + y) - hn::Min(x, one) * hn::Min(y, one); });
    case BlendMode::min:
      return ByChannel(c, t, [](V x, V y) HWY_ATTR { return hn::Min(x, y); });
    case BlendMode::max:
      return ByChannel(c, t, [](V x, V y) HWY_ATTR { return hn::Max(x, y); });
    case BlendMode::dot3:
      break;
  }
  return Dot3(c, t);
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
