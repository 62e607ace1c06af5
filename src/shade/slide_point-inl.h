// Where samples lie on a projector's slide, N at a time.
#if defined(LATERNA_SHADE_SLIDE_POINT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADE_SLIDE_POINT_INL_H_
#undef LATERNA_SHADE_SLIDE_POINT_INL_H_
#else
#define LATERNA_SHADE_SLIDE_POINT_INL_H_
#endif

#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "image/texture_lookup-inl.h"
#include "shade/illumination.h"
#include "shadow/projected_view-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using image::HWY_NAMESPACE::Footprint;
using shadow::HWY_NAMESPACE::Evaluate;

// Slide coordinates with their change from pixel to pixel, and whether the lens is behind the point.
struct SlidePoint {
  Footprint footprint;
  FloatMask is_ahead;
};

HWY_INLINE SlidePoint FindSlidePoint(const BoundLight& light, const shadow::SurfaceSamples& samples,
                                     std::size_t i) {
  const FloatTag d;
  const auto x = hn::Load(d, samples.x.data() + i), y = hn::Load(d, samples.y.data() + i),
             q = hn::Load(d, samples.q.data() + i);
  const auto q_dx = hn::Load(d, samples.dq_dx.data() + i), q_dy = hn::Load(d, samples.dq_dy.data() + i);
  const shadow::ProjectedView& v = light.slide_position;
  // Orthographic: w^l is 1, and what is divided by is the samples' own fourth coordinate: equation 8 (row 4).
  const shadow::ProjectedRow& divisor_row = light.is_orthographic ? light.homogeneous : v.divisor;
  const auto S = Evaluate(v.x, x, y, q), T = Evaluate(v.y, x, y, q), W = Evaluate(divisor_row, x, y, q);
  const auto h = Evaluate(light.homogeneous, x, y, q);
  SlidePoint point;
  point.is_ahead = W > h * Splat(1e-6F);
  const auto inverse = Splat(1.0F) / hn::IfThenElse(point.is_ahead, W, h);
  Footprint& f = point.footprint;
  f.u = S * inverse;
  f.v = T * inverse;
  const auto slope = [&](const shadow::ProjectedRow& row, float at, FloatVector dq)
                         HWY_ATTR { return Splat(at) + Splat(row.at_q) * dq; };
  const auto w_dx = slope(divisor_row, divisor_row.at_x, q_dx),
             w_dy = slope(divisor_row, divisor_row.at_y, q_dy);
  f.du_dx = (slope(v.x, v.x.at_x, q_dx) - f.u * w_dx) * inverse;
  f.dv_dx = (slope(v.y, v.y.at_x, q_dx) - f.v * w_dx) * inverse;
  f.du_dy = (slope(v.x, v.x.at_y, q_dy) - f.u * w_dy) * inverse;
  f.dv_dy = (slope(v.y, v.y.at_y, q_dy) - f.v * w_dy) * inverse;
  return point;
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
