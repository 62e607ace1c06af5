// Points on the relief of a triangle: where a ray of sight meets it, and what the surface is like there.
#if defined(LATERNA_SHADE_RELIEF_HIT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADE_RELIEF_HIT_INL_H_
#undef LATERNA_SHADE_RELIEF_HIT_INL_H_
#else
#define LATERNA_SHADE_RELIEF_HIT_INL_H_
#endif

#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "frame/relief_ray-inl.h"
#include "shade/surface_hit-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using frame::HWY_NAMESPACE::LatticePoint;
using frame::HWY_NAMESPACE::ReliefCoordinates;

// A hit below or on the plane of its triangle. Texture coordinates, normals and the rest are those of the point of the
// triangle's plane straight above, which may lie beyond the triangle's own sides: weights are not held to them.
HWY_INLINE Hit FindReliefHit(const PixelRays& rays, const Facet& facet, FloatVector x, FloatVector y,
                             FloatVector q) {
  const Vector3 direction_x = Splat3(rays.direction_x), direction_y = Splat3(rays.direction_y);
  const Vector3 direction = Splat3(rays.direction_0) + (direction_x * x + direction_y * y);
  Hit hit;
  Vector3 dp_dx, dp_dy;
  if (rays.is_orthographic) {
    const Vector3 axis = Splat3(rays.axis);
    hit.position_ws = direction + axis * q;
    hit.dq_dx = facet.dq_dx;
    hit.dq_dy = facet.dq_dy;
    dp_dx = direction_x + axis * hit.dq_dx;
    dp_dy = direction_y + axis * hit.dq_dy;
    hit.to_eye_ws = axis;
  } else {
    const auto w = Splat(1.0F) / q;
    const Vector3 from_eye = direction * w;
    hit.position_ws = Splat3(rays.eye) + from_eye;
    const auto inverse = InverseUnless<false>(hn::Abs(Dot(facet.normal, from_eye)) <= Splat(1e-30F),
                                              Dot(facet.normal, from_eye));
    hit.dq_dx = Dot(facet.normal, direction_x) * inverse;
    hit.dq_dy = Dot(facet.normal, direction_y) * inverse;
    dp_dx = (direction_x - from_eye * hit.dq_dx) * w;
    dp_dy = (direction_y - from_eye * hit.dq_dy) * w;
    hit.to_eye_ws = Normalised(direction * Splat(-1.0F));
  }
  hit.shows_back = Dot(facet.normal, hit.to_eye_ws) < Splat(0.0F);
  const Vector3 p = hit.position_ws - facet.corners.a;
  hit.weights = {Dot(p, facet.to_b),     Dot(p, facet.to_c),     Dot(dp_dx, facet.to_b),
                 Dot(dp_dy, facet.to_b), Dot(dp_dx, facet.to_c), Dot(dp_dy, facet.to_c)};
  return hit;
}

// A sample of a triangle's plane, pushed back to the relief.
struct Displaced {
  FloatVector q;
  FloatVector t;  // share of the relief's depth
};

// Seen from the back the triangle is flat.
HWY_INLINE Displaced DisplaceSample(const PixelRays& rays, const Facet& facet,
                                    const frame::ReliefBinding& relief, const ReliefCoordinates& coordinates,
                                    FloatVector x, FloatVector y, FloatVector q) {
  const auto zero = Splat(0.0F);
  const Hit on_plane = FindReliefHit(rays, facet, x, y, q);
  // To grazing rays the surface is as if it were seen under a gradient of 1 : 10000.
  const auto facing = Dot(facet.unit_normal, on_plane.to_eye_ws);
  const auto into = hn::Max(facing, Splat(1e-4F));
  const auto length = Splat(relief.depth) / into;  // of the ray down to the full depth
  const Vector3 way = on_plane.to_eye_ws * hn::Neg(length);
  const frame::HWY_NAMESPACE::ReliefRay ray = {
      coordinates.At(on_plane.weights.b, on_plane.weights.c),
      coordinates.Change(Dot(way, facet.to_b), Dot(way, facet.to_c))};
  Displaced displaced;
  displaced.t = frame::HWY_NAMESPACE::TraceRelief(*relief.field, ray, Splat(1.0F), facing > zero);
  displaced.t = hn::IfThenElseZero(facing > zero, displaced.t);
  FloatVector pushed;
  if (rays.is_orthographic) {
    pushed = q - displaced.t * length;
  } else {
    // Distance along the axis: the ray's own vector is 1 long there, and to_eye 1 long in space.
    const Vector3 direction =
        Splat3(rays.direction_0) + (Splat3(rays.direction_x) * x + Splat3(rays.direction_y) * y);
    const auto along = hn::Sqrt(Dot(direction, direction));
    pushed = Splat(1.0F) / (Splat(1.0F) / q + displaced.t * length / along);
  }
  displaced.q = hn::IfThenElse(displaced.t > zero, hn::Min(pushed, q), q);
  return displaced;
}

// The normal of the relief, from what it is over the flat triangle: heights' slopes across a pixel, or across a texel where that
// is wider, are taken off it. Seen from the back the triangle is flat.
template <bool kUniform>
HWY_INLINE Vector3 ReliefNormal(const frame::Frame& frame, const frame::ReliefBinding& relief,
                                const frame::HWY_NAMESPACE::TriangleCorners<kUniform>& corners,
                                const Facet& facet, const Hit& hit, const Vector3& normal) {
  const auto half = Splat(0.5F);
  const Weights& weights = hit.weights;
  const ReliefCoordinates coordinates = frame::HWY_NAMESPACE::FindReliefCoordinates(frame, relief, corners);
  const LatticePoint p = coordinates.At(weights.b, weights.c);
  const LatticePoint per_x = coordinates.Change(weights.db_dx, weights.dc_dx),
                     per_y = coordinates.Change(weights.db_dy, weights.dc_dy);
  const auto reach_x = hn::Max(half * hn::Max(hn::Abs(per_x.x), hn::Abs(per_y.x)), half);
  const auto reach_y = hn::Max(half * hn::Max(hn::Abs(per_x.y), hn::Abs(per_y.y)), half);
  const auto depth = [&](FloatVector x, FloatVector y) HWY_ATTR {
    return frame::HWY_NAMESPACE::ReliefDepthAt(*relief.field, {x, y});
  };
  const auto scale = Splat(relief.depth) * half;
  const auto slope_x = (depth(p.x + reach_x, p.y) - depth(p.x - reach_x, p.y)) * (scale / reach_x);
  const auto slope_y = (depth(p.x, p.y + reach_y) - depth(p.x, p.y - reach_y)) * (scale / reach_y);
  // How lattice coordinates grow on the triangle's plane.
  const auto gradient = [&](const frame::HWY_NAMESPACE::CornerValues& v)
                            HWY_ATTR { return facet.to_b * (v.b - v.a) + facet.to_c * (v.c - v.a); };
  // Depth grows against the normal.
  const Vector3 tilted =
      Normalised(normal + (gradient(coordinates.x) * slope_x + gradient(coordinates.y) * slope_y));
  return IfThenElse3(hit.shows_back, normal, tilted);
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
