// A packet's triangles set up side by side in single precision, to pass by what darkens nothing.
#if defined(LATERNA_SHADOW_ROUGH_TRIANGLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADOW_ROUGH_TRIANGLES_INL_H_
#undef LATERNA_SHADOW_ROUGH_TRIANGLES_INL_H_
#else
#define LATERNA_SHADOW_ROUGH_TRIANGLES_INL_H_
#endif

#include <hwy/highway.h>

#include <cstring>

#include "shadow/caster_tree.h"
#include "shadow/edge_functions-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// A packet's triangles, roughly: what is needed to pass by those that darken no group of a bundle. Bounds on errors are in
// it already.
struct RoughTriangles {
  // Edge functions as in EdgeFunctions, each negative only where it surely is.
  alignas(64) float x[3][kTreeWidth], y[3][kTreeWidth], c[3][kTreeWidth];
  // A point beyond the plane as the light sees it has normal · point ≥ plane; and how steeply light meets it.
  alignas(64) float normal[3][kTreeWidth], plane[kTreeWidth], facing[kTreeWidth];
};

// Rounding of single precision in a product of three differences, summed up, with sizes for lengths: 66 roundings of the
// largest product, and some to spare.
constexpr float kRoughError = 6e-6F;

HWY_INLINE FloatVector Size(const Vector3& v) {
  return hn::Max(hn::Max(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
}
HWY_INLINE Vector3 Abs3(const Vector3& v) { return {hn::Abs(v.x), hn::Abs(v.y), hn::Abs(v.z)}; }
HWY_INLINE Vector3 IfThenTurned(FloatMask turned, const Vector3& v) {
  const auto zero = Splat(0.0F);
  return {hn::IfThenElse(turned, zero - v.x, v.x), hn::IfThenElse(turned, zero - v.y, v.y),
          hn::IfThenElse(turned, zero - v.z, v.z)};
}

// Sets up lanes k and on; `corner` from the bundle's middle, in its axes. Returns those that may darken some of the bundle.
template <bool kParallel>
HWY_INLINE std::uint32_t SetUpRough(const Bundle& bundle, const Vector3* corner, std::size_t k,
                                    RoughTriangles& out) {
  const FloatTag d;
  const auto zero = Splat(0.0F);
  const Vector3 m = {Splat(static_cast<float>(bundle.centre.x)), Splat(static_cast<float>(bundle.centre.y)),
                     Splat(static_cast<float>(bundle.centre.z))};
  const auto slope_x = Splat(static_cast<float>(bundle.middle_x)),
             slope_y = Splat(static_cast<float>(bundle.middle_y));
  const auto reach = Splat(bundle.reach_x + bundle.reach_y);
  const Vector3 side[3] = {corner[2] - corner[1], corner[0] - corner[2], corner[1] - corner[0]};

  // The plane. Each component with an error of its own: of surfaces along the axes, most are nought.
  const Vector3 normal = Cross(side[1], side[2]);
  const Vector3 s = Abs3(side[1]), t = Abs3(side[2]);
  const Vector3 wrong = {s.y * t.z + s.z * t.y, s.z * t.x + s.x * t.z, s.x * t.y + s.y * t.x};
  const Vector3 at = corner[0];
  const auto few = Splat(kSingleError);
  FloatVector facing, doubt;
  if constexpr (kParallel) {
    facing = normal.x * slope_x + normal.y * slope_y + normal.z;
    doubt = few * (wrong.x + wrong.y + wrong.z);
  } else {
    const Vector3 from_light = at + m;
    facing = Dot(normal, from_light);
    doubt = few * Dot(wrong, Abs3(at) + Abs3(m));
  }
  const auto is_turned = facing < zero;
  const auto is_edge_on = hn::Abs(facing) <= doubt;
  const Vector3 outward = IfThenTurned(is_turned, normal);
  const auto room = Splat(bundle.half_of_all);
  const Vector3 size = Abs3(at);
  const auto plane_doubt =
      few * (Dot(wrong, {size.x + room, size.y + room, size.z + room}) + Dot(Abs3(normal), size));
  const auto plane = Dot(outward, at) - plane_doubt;
  const auto sure_facing = hn::Max(hn::Abs(facing) - doubt, zero);
  const auto most = hn::Abs(normal.x) * Splat(bundle.half[0]) + hn::Abs(normal.y) * Splat(bundle.half[1]) +
                    hn::Abs(normal.z) * Splat(bundle.half[2]);
  auto may = most >= plane + sure_facing * Splat(bundle.nearest_of_all);

  // The edges.
  for (int edge = 0; edge < 3; ++edge) {
    const Vector3& from = corner[(edge + 1) % 3];
    const Vector3& to = corner[(edge + 2) % 3];
    FloatVector x, y, c, bound;
    if constexpr (kParallel) {
      const auto from_x = from.x - slope_x * from.z, from_y = from.y - slope_y * from.z;
      const auto to_x = to.x - slope_x * to.z, to_y = to.y - slope_y * to.z;
      x = from_y - to_y;
      y = to_x - from_x;
      c = from_x * to_y - from_y * to_x;
      bound = Splat(kRoughError) * (Size(from) + reach) * (Size(to) + reach);
    } else {
      const Vector3 p = from + m;
      x = p.y * side[edge].z - p.z * side[edge].y;
      y = p.z * side[edge].x - p.x * side[edge].z;
      const auto per_depth = Splat(static_cast<float>(1 / bundle.centre.z));
      c = Dot(m, Cross(from, to)) * per_depth;
      bound = Splat(kRoughError) *
              (Size(p) * Size(side[edge]) * reach + Size(m) * Size(from) * Size(to) * per_depth);
    }
    x = hn::IfThenElse(is_turned, zero - x, x);
    y = hn::IfThenElse(is_turned, zero - y, y);
    c = hn::IfThenElse(is_turned, zero - c, c) + bound;
    // Which way round it is cannot be told: nothing is outside.
    c = hn::IfThenElse(is_edge_on, Splat(3e38F), c);
    x = hn::IfThenZeroElse(is_edge_on, x);
    y = hn::IfThenZeroElse(is_edge_on, y);
    hn::Store(x, d, out.x[edge] + k);
    hn::Store(y, d, out.y[edge] + k);
    hn::Store(c, d, out.c[edge] + k);
    const auto highest = hn::Max(x * Splat(bundle.low_x), x * Splat(bundle.high_x)) +
                         hn::Max(y * Splat(bundle.low_y), y * Splat(bundle.high_y)) + c;
    may = hn::And(may, highest >= zero);
  }
  hn::Store(outward.x, d, out.normal[0] + k);
  hn::Store(outward.y, d, out.normal[1] + k);
  hn::Store(outward.z, d, out.normal[2] + k);
  hn::Store(hn::IfThenElse(is_edge_on, Splat(-3e38F), plane), d, out.plane + k);
  hn::Store(hn::IfThenElse(is_edge_on, zero, sure_facing), d, out.facing + k);
  return BitsOf(hn::Or(may, is_edge_on));
}

// Groups that the triangle may darken, a bit each.
HWY_INLINE std::uint32_t GroupsBehind(const Bundle& bundle, const RoughTriangles& t, std::size_t lane) {
  const FloatTag d;
  std::uint32_t bits = 0;
  for (std::size_t g = 0; g < bundle.count; g += kLanes) {
    const auto along = [&](const float* values, float factor)
                           HWY_ATTR { return Splat(factor) * hn::Load(d, values + g); };
    auto may = along(bundle.box[0], t.normal[0][lane]) + along(bundle.box[1], t.normal[1][lane]) +
                   along(bundle.box[2], t.normal[2][lane]) +
                   along(bundle.half_box[0], std::abs(t.normal[0][lane])) +
                   along(bundle.half_box[1], std::abs(t.normal[1][lane])) +
                   along(bundle.half_box[2], std::abs(t.normal[2][lane])) >=
               Splat(t.plane[lane]) + along(bundle.nearest, t.facing[lane]);
    for (int edge = 0; edge < 3; ++edge) {
      const float x = t.x[edge][lane], y = t.y[edge][lane];
      const auto highest = along(bundle.x, x) + along(bundle.y, y) + along(bundle.half_x, std::abs(x)) +
                           along(bundle.half_y, std::abs(y)) + Splat(t.c[edge][lane]);
      may = hn::And(may, highest >= Splat(0.0F));
    }
    bits |= BitsOf(may) << g;
  }
  return bits;
}

// The same for one group and all triangles.
HWY_INLINE std::uint32_t TrianglesBefore(const Bundle& bundle, std::size_t group, const RoughTriangles& t) {
  const FloatTag d;
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < kTreeWidth; k += kLanes) {
    auto most = Splat(0.0F);
    for (int axis = 0; axis < 3; ++axis) {
      const auto normal = hn::Load(d, t.normal[axis] + k);
      most = most + (normal * Splat(bundle.box[axis][group]) +
                     hn::Abs(normal) * Splat(bundle.half_box[axis][group]));
    }
    auto may = most >= hn::Load(d, t.plane + k) + hn::Load(d, t.facing + k) * Splat(bundle.nearest[group]);
    for (int edge = 0; edge < 3; ++edge) {
      const auto x = hn::Load(d, t.x[edge] + k), y = hn::Load(d, t.y[edge] + k);
      const auto highest =
          x * Splat(bundle.x[group]) + y * Splat(bundle.y[group]) +
          (hn::Abs(x) * Splat(bundle.half_x[group]) + hn::Abs(y) * Splat(bundle.half_y[group])) +
          hn::Load(d, t.c[edge] + k);
      may = hn::And(may, highest >= Splat(0.0F));
    }
    bits |= BitsOf(may) << k;
  }
  return bits;
}

// The 16 samples of a group that do not lie beside the triangle, nor on it as their own.
HWY_INLINE std::uint32_t SamplesBehind(const SampleView& view, const TriangleId* ids, std::size_t first,
                                       const RoughTriangles& t, std::size_t lane, TriangleId id) {
  const FloatTag d;
  const IntTag di;
  std::uint32_t bits = 0;
  const auto own = SplatInt(static_cast<std::int32_t>(id));
  for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
    const std::size_t i = first + k;
    const auto x = hn::Load(d, view.x.data() + i), y = hn::Load(d, view.y.data() + i);
    const auto side = [&](int edge) HWY_ATTR {
      return Splat(t.x[edge][lane]) * x + Splat(t.y[edge][lane]) * y + Splat(t.c[edge][lane]);
    };
    const auto least = hn::Min(hn::Min(side(0), side(1)), side(2));
    const auto sample_ids = hn::Load(di, reinterpret_cast<const std::int32_t*>(ids + i));
    bits |= BitsOf(hn::AndNot(hn::RebindMask(d, sample_ids == own), least >= Splat(0.0F))) << k;
  }
  return bits;
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
