// OpenCV's distortion of slide coordinates, N at a time.
#if defined(LATERNA_SHADE_SLIDE_LENS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADE_SLIDE_LENS_INL_H_
#undef LATERNA_SHADE_SLIDE_LENS_INL_H_
#else
#define LATERNA_SHADE_SLIDE_LENS_INL_H_
#endif

#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "image/texture_lookup-inl.h"
#include "shade/bound_lens.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// By how much the slide is stretched across and down where it is looked up, against a lens without distortion.
struct LensStretch {
  FloatVector u, v;
};

// Coordinates over the beam's image become coordinates over the slide, with their change from pixel to pixel. A projector
// is a camera run backward: from the direction of a surface to the place on the slide is the way in which OpenCV's
// formula is closed form (laterna/lens.h). Returns where the lens throws anything; elsewhere the coordinates are those of
// its axis.
HWY_INLINE FloatMask PassLens(const BoundLens& lens, image::HWY_NAMESPACE::Footprint& f,
                              LensStretch& stretch) {
  auto x = f.u * Splat(lens.x_scale) + Splat(lens.x_offset);
  auto y = f.v * Splat(lens.y_scale) + Splat(lens.y_offset);
  const auto is_thrown = x * x + y * y <= Splat(lens.field_squared);
  x = hn::IfThenElseZero(is_thrown, x);
  y = hn::IfThenElseZero(is_thrown, y);
  const auto k1 = Splat(lens.k1), k2 = Splat(lens.k2), k3 = Splat(lens.k3);
  const auto p1 = Splat(lens.p1), p2 = Splat(lens.p2);
  const auto one = Splat(1.0F), two = Splat(2.0F), three = Splat(3.0F), six = Splat(6.0F);
  const auto xx = x * x, yy = y * y, xy = x * y, r2 = xx + yy;
  const auto radial = one + r2 * (k1 + r2 * (k2 + r2 * k3));
  const auto x_thrown = x * radial + (p1 * (two * xy) + p2 * (r2 + two * xx));
  const auto y_thrown = y * radial + (p1 * (r2 + two * yy) + p2 * (two * xy));
  f.u = x_thrown * Splat(lens.s_scale) + Splat(lens.s_offset);
  f.v = y_thrown * Splat(lens.t_scale) + Splat(lens.t_offset);

  // The Jacobian is symmetric.
  const auto slope = two * (k1 + r2 * (two * k2 + r2 * (three * k3)));
  const auto x_by_x = radial + slope * xx + (two * p1 * y + six * p2 * x);
  const auto y_by_y = radial + slope * yy + (six * p1 * y + two * p2 * x);
  const auto y_by_x = slope * xy + two * (p1 * x + p2 * y);
  const auto change = [&](FloatVector& du, FloatVector& dv) HWY_ATTR {
    const auto dx = du * Splat(lens.x_scale), dy = dv * Splat(lens.y_scale);
    du = (x_by_x * dx + y_by_x * dy) * Splat(lens.s_scale);
    dv = (y_by_x * dx + y_by_y * dy) * Splat(lens.t_scale);
  };
  change(f.du_dx, f.dv_dx);
  change(f.du_dy, f.dv_dy);
  stretch = {hn::Abs(x_by_x), hn::Abs(y_by_y)};
  return is_thrown;
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
