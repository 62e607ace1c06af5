// Where a view's ray meets a triangle: position, weights of the corners and their slopes.
#if defined(LATERNA_SHADE_SURFACE_HIT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADE_SURFACE_HIT_INL_H_
#undef LATERNA_SHADE_SURFACE_HIT_INL_H_
#else
#define LATERNA_SHADE_SURFACE_HIT_INL_H_
#endif

#include <hwy/highway.h>

#include <cmath>

#include "base/vectors-inl.h"
#include "frame/triangle_corners-inl.h"
#include "laterna/shading.h"
#include "shade/pixel_rays.h"
#include "shadow/surface_samples.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using frame::HWY_NAMESPACE::CornerVectors;
using frame::HWY_NAMESPACE::Weights;

// What all samples of a triangle share.
struct Facet {
  CornerVectors corners;
  Vector3 normal, unit_normal;  // on the side where the corners run counter-clockwise
  Vector3 to_b, to_c;           // dot products of a point, seen from corner a, with these are its weights
  FloatVector dq_dx, dq_dy;
};

// The point of a triangle that a sample sees.
struct Hit {
  Vector3 position_ws, to_eye_ws;  // to_eye: unit
  FloatMask shows_back;            // of the triangle
  Weights weights;
  FloatVector dq_dx,
      dq_dy;  // change of depth from pixel to pixel, on the plane of the triangle or on one parallel to it
};

// 1 / v and √v of numbers that are the same in all lanes where kUniform: vectors take far longer than one number.
template <bool kUniform>
HWY_INLINE FloatVector Inverse(FloatVector v) {
  return kUniform ? Splat(1.0F / hn::GetLane(v)) : Splat(1.0F) / v;
}
template <bool kUniform>
HWY_INLINE FloatVector SquareRoot(FloatVector v) {
  return kUniform ? Splat(std::sqrt(hn::GetLane(v))) : hn::Sqrt(v);
}

template <bool kUniform>
HWY_INLINE FloatVector InverseUnless(FloatMask is_nothing, FloatVector v) {
  return hn::IfThenZeroElse(is_nothing, Inverse<kUniform>(hn::IfThenElse(is_nothing, Splat(1.0F), v)));
}

// kUniform: all lanes have one triangle.
template <bool kUniform>
HWY_INLINE Facet FindFacet(const PixelRays& rays, const CornerVectors& corners) {
  Facet facet;
  facet.corners = corners;
  const Vector3 u = corners.b - corners.a, v = corners.c - corners.a;
  const Vector3 n = Cross(u, v);
  const auto n_squared = Dot(n, n);
  const auto inverse_n_squared = InverseUnless<kUniform>(n_squared <= Splat(1e-36F), n_squared);
  facet.normal = n;
  facet.unit_normal = n * SquareRoot<kUniform>(inverse_n_squared);
  // point − a = b u + c v; crossing with n isolates b and c.
  facet.to_b = Cross(v, n) * inverse_n_squared;
  facet.to_c = Cross(n, u) * inverse_n_squared;
  const Vector3 direction_x = Splat3(rays.direction_x), direction_y = Splat3(rays.direction_y);
  if (rays.is_orthographic) {
    const auto along = Dot(n, Splat3(rays.axis));
    const auto inverse = InverseUnless<kUniform>(hn::Abs(along) <= Splat(1e-30F), along);
    facet.dq_dx = hn::Neg(Dot(n, direction_x) * inverse);
    facet.dq_dy = hn::Neg(Dot(n, direction_y) * inverse);
  } else {
    // On the plane q = n·direction / n·(corner − eye), and all its points have the same n·(point − eye).
    const auto distance = Dot(n, corners.a - Splat3(rays.eye));
    const auto inverse = InverseUnless<kUniform>(hn::Abs(distance) <= Splat(1e-30F), distance);
    facet.dq_dx = Dot(n, direction_x) * inverse;
    facet.dq_dy = Dot(n, direction_y) * inverse;
  }
  return facet;
}

// Weights that vary linearly on the screen, for triangles wholly in front of the near plane.
HWY_INLINE void MakeAffine(const PixelRays& rays, const CornerVectors& corners, FloatVector x, FloatVector y,
                           Weights& weights) {
  struct Projected {
    FloatVector x, y, w;
  };
  const auto project = [&](const Vector3& p_ws) HWY_ATTR {
    const Vector3 p = p_ws - Splat3(rays.eye);
    const auto w = rays.is_orthographic ? Splat(1.0F) : Dot(Splat3(rays.w_row), p);
    const auto inverse = Splat(1.0F) / hn::IfThenElse(w == Splat(0.0F), Splat(1.0F), w);
    return Projected{Dot(Splat3(rays.x_row), p) * inverse + Splat(rays.x_add),
                     Dot(Splat3(rays.y_row), p) * inverse + Splat(rays.y_add), w};
  };
  const Projected a = project(corners.a), b = project(corners.b), c = project(corners.c);
  const auto ux = b.x - a.x, uy = b.y - a.y, vx = c.x - a.x, vy = c.y - a.y;
  const auto area = ux * vy - vx * uy;
  const auto near = Splat(rays.is_orthographic ? 0.5F : rays.near);
  const auto is_usable =
      hn::And(hn::And(a.w >= near, b.w >= near), hn::And(c.w >= near, hn::Abs(area) > Splat(1e-12F)));
  const auto inverse = Splat(1.0F) / hn::IfThenElse(is_usable, area, Splat(1.0F));
  const auto px = x - a.x, py = y - a.y;
  const auto choose = [&](FloatVector affine, FloatVector& kept)
                          HWY_ATTR { kept = hn::IfThenElse(is_usable, affine, kept); };
  choose((px * vy - vx * py) * inverse, weights.b);
  choose((ux * py - px * uy) * inverse, weights.c);
  choose(vy * inverse, weights.db_dx);
  choose(hn::Neg(vx) * inverse, weights.db_dy);
  choose(hn::Neg(uy) * inverse, weights.dc_dx);
  choose(ux * inverse, weights.dc_dy);
}

HWY_INLINE Hit FindHit(const PixelRays& rays, const Facet& facet, FloatVector x, FloatVector y, FloatVector q,
                       Interpolation interpolation) {
  const auto one = Splat(1.0F);
  const Vector3 direction_x = Splat3(rays.direction_x), direction_y = Splat3(rays.direction_y);
  const Vector3 direction = Splat3(rays.direction_0) + (direction_x * x + direction_y * y);
  Hit hit;
  hit.dq_dx = facet.dq_dx;
  hit.dq_dy = facet.dq_dy;
  Vector3 dp_dx, dp_dy;  // how the point moves on the plane from one pixel to the next
  if (rays.is_orthographic) {
    const Vector3 axis = Splat3(rays.axis);
    hit.position_ws = direction + axis * q;
    dp_dx = direction_x + axis * facet.dq_dx;
    dp_dy = direction_y + axis * facet.dq_dy;
    hit.to_eye_ws = axis;
  } else {
    const auto w = one / q;
    const Vector3 from_eye = direction * w;
    hit.position_ws = Splat3(rays.eye) + from_eye;
    dp_dx = (direction_x - from_eye * facet.dq_dx) * w;
    dp_dy = (direction_y - from_eye * facet.dq_dy) * w;
    hit.to_eye_ws = Normalised(direction * Splat(-1.0F));
  }
  hit.shows_back = Dot(facet.normal, hit.to_eye_ws) < Splat(0.0F);

  const Vector3 p = hit.position_ws - facet.corners.a;
  // Snapping lets a covered sample lie a little outside: it takes the attributes of the rim.
  hit.weights.b = Saturate(Dot(p, facet.to_b));
  hit.weights.c = hn::Min(hn::Max(Dot(p, facet.to_c), Splat(0.0F)), one - hit.weights.b);
  hit.weights.db_dx = Dot(dp_dx, facet.to_b);
  hit.weights.db_dy = Dot(dp_dy, facet.to_b);
  hit.weights.dc_dx = Dot(dp_dx, facet.to_c);
  hit.weights.dc_dy = Dot(dp_dy, facet.to_c);
  if (interpolation == Interpolation::affine) MakeAffine(rays, facet.corners, x, y, hit.weights);
  return hit;
}

// Whether all samples of a group lie on one.
HWY_INLINE bool IsOneTriangle(const TriangleId* ids) {
  const UintTag du;
  const auto first = hn::Set(du, ids[0]);
  for (std::size_t k = 0; k < shadow::kGroupSize; k += kLanes) {
    if (!hn::AllTrue(du, hn::LoadU(du, ids + k) == first)) return false;
  }
  return true;
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
