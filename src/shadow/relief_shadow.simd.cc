// The way of light into a relief.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shadow/relief_shadow.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "frame/relief_ray-inl.h"
#include "frame/triangle_corners-inl.h"
#include "shadow/relief_shadow.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using frame::HWY_NAMESPACE::CornerVectors;
using frame::HWY_NAMESPACE::TriangleCorners;

// Light that rises less than this over the triangle's plane is taken to come from below it.
constexpr float kLeastRise = 1e-4F;
// A point of the relief is not shaded by what is this near to it, in shares of the depth: its own depth comes from its position,
// which is rounded.
constexpr float kReliefTolerance = 1.0F / 2048;

// The flat triangles of N samples.
struct Polygon {
  CornerVectors corners;
  Vector3 unit_normal, to_b, to_c;  // as in shade/surface_hit-inl.h

  explicit HWY_INLINE Polygon(const CornerVectors& of) : corners(of) {
    const auto one = Splat(1.0F);
    const Vector3 u = of.b - of.a, v = of.c - of.a, n = Cross(u, v);
    const auto squared = Dot(n, n);
    const auto is_nothing = squared <= Splat(1e-36F);
    const auto inverse = hn::IfThenZeroElse(is_nothing, one / hn::IfThenElse(is_nothing, one, squared));
    unit_normal = n * hn::Sqrt(inverse);
    to_b = Cross(v, n) * inverse;
    to_c = Cross(n, u) * inverse;
  }
};

HWY_INLINE Vector3 Load3(const float* x, const float* y, const float* z, std::size_t i) {
  const FloatTag d;
  return {hn::Load(d, x + i), hn::Load(d, y + i), hn::Load(d, z + i)};
}

// Where the camera sees points, and whether it does.
struct Seen {
  FloatVector x, y, q;
  FloatMask is_seen;
};
HWY_INLINE Seen See(const ReliefLight& light, const Vector3& position_ws) {
  const Vector3 p = position_ws - Splat3(light.eye_ws);
  const auto w = Dot(Splat3(light.w_row), p) + Splat(light.w_add);
  const auto across = Dot(Splat3(light.x_row), p) + Splat(light.x_add);
  const auto down = Dot(Splat3(light.y_row), p) + Splat(light.y_add);
  Seen seen;
  if (light.is_orthographic) {
    seen = {across, down, w, w == w};
  } else {
    const auto is_ahead = w > Splat(1e-4F);
    const auto q = Splat(1.0F) / hn::IfThenElse(is_ahead, w, Splat(1.0F));
    seen = {across * q, down * q, q, is_ahead};
  }
  const auto within = [&](FloatVector v, float low, float high) HWY_ATTR {
    seen.is_seen = hn::And(seen.is_seen, hn::And(v >= Splat(low), v < Splat(high)));
  };
  // Beyond, floats tell no pixels apart.
  constexpr float kFarthest = 1e6F;
  within(seen.x, light.stays_in_picture ? light.low_x : -kFarthest,
         light.stays_in_picture ? light.high_x : kFarthest);
  within(seen.y, light.stays_in_picture ? light.low_y : -kFarthest,
         light.stays_in_picture ? light.high_y : kFarthest);
  return seen;
}

HWY_INLINE void StoreEntry(const ReliefLight& light, const SurfaceSamples& s, const Polygon& polygon,
                           const Vector3& entry_ws, FloatMask is_moved, SurfaceSamples& e, std::size_t i) {
  const FloatTag d;
  const Seen seen = See(light, entry_ws);
  const auto moved = hn::And(is_moved, seen.is_seen);
  const auto put = [&](FloatVector entry, const SampleArray<float>& from, SampleArray<float>& to) HWY_ATTR {
    hn::Store(hn::IfThenElse(moved, entry, hn::Load(d, from.data() + i)), d, to.data() + i);
  };
  put(seen.x, s.x, e.x);
  put(seen.y, s.y, e.y);
  put(seen.q, s.q, e.q);
  put(entry_ws.x, s.x_ws, e.x_ws);
  put(entry_ws.y, s.y_ws, e.y_ws);
  put(entry_ws.z, s.z_ws, e.z_ws);
  put(hn::Load(d, s.normal_x_ws.data() + i), s.normal_x_ws, e.normal_x_ws);
  put(hn::Load(d, s.normal_y_ws.data() + i), s.normal_y_ws, e.normal_y_ws);
  put(hn::Load(d, s.normal_z_ws.data() + i), s.normal_z_ws, e.normal_z_ws);
  // Reversed depth over the picture, of the triangle's own plane.
  const auto n = polygon.unit_normal;
  const auto across = light.is_orthographic ? hn::Neg(Dot(n, Splat3(light.axis_ws)))
                                            : Dot(n, polygon.corners.a - Splat3(light.eye_ws));
  const auto is_edge_on = hn::Abs(across) <= Splat(1e-30F);
  const auto inverse =
      hn::IfThenZeroElse(is_edge_on, Splat(1.0F) / hn::IfThenElse(is_edge_on, Splat(1.0F), across));
  put(Dot(n, Splat3(light.direction_x)) * inverse, s.dq_dx, e.dq_dx);
  put(Dot(n, Splat3(light.direction_y)) * inverse, s.dq_dy, e.dq_dy);
}

// Samples i … i + kLanes − 1; returns the bits of those that the relief shades.
HWY_INLINE std::uint32_t FindEntries(const frame::Frame& frame, const frame::ReliefBinding& relief,
                                     const ReliefLight& light, const SurfaceSamples& s, SurfaceSamples& e,
                                     std::size_t i) {
  const auto zero = Splat(0.0F), one = Splat(1.0F);
  const TriangleCorners<false> corners(frame, s.id.data() + i);
  const Polygon polygon(corners.Positions());
  const Vector3 p = Load3(s.x_ws.data(), s.y_ws.data(), s.z_ws.data(), i);
  const Vector3 seen_normal = Load3(s.normal_x_ws.data(), s.normal_y_ws.data(), s.normal_z_ws.data(), i);
  const auto shows_front = Dot(seen_normal, polygon.unit_normal) > zero;
  const auto below =
      hn::Min(hn::Max(Dot(polygon.unit_normal, polygon.corners.a - p), zero), Splat(relief.depth));
  const Vector3 way = light.is_parallel ? Splat3(light.to_light_ws) : Splat3(light.position_ws) - p;
  const Vector3 to_light = Normalised(way);
  const auto rise = Dot(to_light, polygon.unit_normal);
  // A lamp within the relief, as well as one behind it, is taken to shine on the flat triangle.
  auto comes_in = rise > Splat(kLeastRise);
  if (!light.is_parallel) comes_in = hn::And(comes_in, Dot(way, polygon.unit_normal) > below);
  const auto safe_rise = hn::IfThenElse(comes_in, rise, one);
  const Vector3 slanting = to_light * (below / safe_rise), straight = polygon.unit_normal * below;
  const Vector3 entry = p + IfThenElse3(comes_in, slanting, straight);
  StoreEntry(light, s, polygon, entry, shows_front, e, i);
  if (!relief.self_shadow) return 0;

  const auto coordinates = frame::HWY_NAMESPACE::FindReliefCoordinates(frame, relief, corners);
  const Vector3 from_a = entry - polygon.corners.a;
  const Vector3 down = to_light * hn::Neg(Splat(relief.depth) / safe_rise);
  const frame::HWY_NAMESPACE::ReliefRay ray = {
      coordinates.At(Dot(from_a, polygon.to_b), Dot(from_a, polygon.to_c)),
      coordinates.Change(Dot(down, polygon.to_b), Dot(down, polygon.to_c))};
  const float inverse_depth = 1 / relief.depth;
  const auto tolerance = Splat(kReliefTolerance + 2 * s.position_error * inverse_depth);
  const auto end = below * Splat(inverse_depth) - tolerance;
  const auto asked = hn::And(hn::And(shows_front, comes_in), end > zero);
  const auto t = frame::HWY_NAMESPACE::TraceRelief(*relief.field, ray, end, asked);
  return BitsOf(hn::And(asked, t < end));
}

void find_relief_entries(const frame::Frame& frame, const frame::Surface& surface, const ReliefLight& light,
                         const SurfaceSamples& samples, SurfaceSamples& entries, std::uint16_t* shaded) {
  entries.ray = samples.ray;
  entries.group_count = samples.group_count;
  entries.active = samples.active;
  // Positions are rounded once more.
  entries.position_error = 2 * samples.position_error;
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    const std::size_t first = group * kGroupSize;
    std::copy_n(samples.id.data() + first, kGroupSize, entries.id.data() + first);
    std::copy_n(samples.pixel.data() + first, kGroupSize, entries.pixel.data() + first);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < kGroupSize; k += kLanes)
      bits |= FindEntries(frame, surface.relief, light, samples, entries, first + k) << k;
    shaded[group] = static_cast<std::uint16_t>(bits & samples.active[group]);
  }
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shadow {
LATERNA_KERNEL_TABLE(find_relief_entries)
}  // namespace laterna::shadow
#endif
