// Look-ups of directions in octahedral maps, N at a time. Included once per target by *.simd.cc files.
#if defined(LATERNA_IMAGE_OCTAHEDRAL_LOOKUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_IMAGE_OCTAHEDRAL_LOOKUP_INL_H_
#undef LATERNA_IMAGE_OCTAHEDRAL_LOOKUP_INL_H_
#else
#define LATERNA_IMAGE_OCTAHEDRAL_LOOKUP_INL_H_
#endif

#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "image/octahedral_levels.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::image::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// Places in the chart, a to the right and b downward, from −1 to 1 (image/environment_chart.h).
struct OctahedralPoint {
  FloatVector a, b;
};

// Of directions of any length; the zero vector is taken for +Y.
HWY_INLINE OctahedralPoint OctahedralPointOf(const Vector3& direction) {
  const auto zero = Splat(0.0F), one = Splat(1.0F);
  const auto length = hn::Abs(direction.x) + hn::Abs(direction.y) + hn::Abs(direction.z);
  const auto inverse = one / hn::Max(length, Splat(1e-30F));
  const auto x = direction.x * inverse, z = direction.z * inverse;
  const auto is_below = direction.y < zero;
  const auto folded_x = hn::CopySign(one - hn::Abs(z), x), folded_z = hn::CopySign(one - hn::Abs(x), z);
  return {hn::IfThenElse(is_below, folded_x, x), hn::IfThenElse(is_below, folded_z, z)};
}

// The unit direction that is seen there.
HWY_INLINE Vector3 DirectionOf(const OctahedralPoint& point) {
  const auto zero = Splat(0.0F), one = Splat(1.0F);
  const auto a = hn::Abs(point.a), b = hn::Abs(point.b);
  const auto y = one - a - b;
  const auto is_below = y < zero;
  return Normalised({hn::IfThenElse(is_below, hn::CopySign(one - b, point.a), point.a), y,
                     hn::IfThenElse(is_below, hn::CopySign(one - a, point.b), point.b)});
}

// Where each of N directions is read: of one row of texels and the next.
struct OctahedralTaps {
  IntVector upper, lower;  // indices of the left one
  FloatVector u, v;        // weights of the right and the lower one
};

HWY_INLINE OctahedralTaps FindOctahedralTaps(IntVector side, IntVector first, const OctahedralPoint& point) {
  const FloatTag d;
  const IntTag di;
  const auto last = hn::ConvertTo(d, side);
  const auto half_side = last * Splat(0.5F), half = Splat(0.5F);
  // Counted from the border's texels, which stand before the first.
  const auto x = (point.a + Splat(1.0F)) * half_side + half, y = (point.b + Splat(1.0F)) * half_side + half;
  const auto column = hn::Min(hn::Max(hn::Floor(x), Splat(0.0F)), last);
  const auto row = hn::Min(hn::Max(hn::Floor(y), Splat(0.0F)), last);
  const auto stride = side + SplatInt(2);
  const auto upper = hn::ConvertTo(di, row) * stride + hn::ConvertTo(di, column) + first;
  return {upper, upper + stride, x - column, y - row};
}

HWY_INLINE FloatVector Interpolate(const float* plane, const OctahedralTaps& taps) {
  const FloatTag d;
  const auto upper_left = hn::GatherIndex(d, plane, taps.upper);
  const auto upper_right = hn::GatherIndex(d, plane + 1, taps.upper);
  const auto lower_left = hn::GatherIndex(d, plane, taps.lower);
  const auto lower_right = hn::GatherIndex(d, plane + 1, taps.lower);
  const auto top = upper_left + (upper_right - upper_left) * taps.u;
  const auto bottom = lower_left + (lower_right - lower_left) * taps.u;
  return top + (bottom - top) * taps.v;
}

HWY_INLINE Vector3 Interpolate(const OctahedralLevels& map, const OctahedralTaps& taps) {
  return {Interpolate(map.r.data(), taps), Interpolate(map.g.data(), taps), Interpolate(map.b.data(), taps)};
}

// Bilinear, in one level.
HWY_INLINE Vector3 LookUpOctahedral(const OctahedralLevels& map, std::size_t level,
                                    const OctahedralPoint& point) {
  const OctahedralLevels::Level& l = map.levels[level];
  return Interpolate(
      map, FindOctahedralTaps(SplatInt(l.side), SplatInt(static_cast<std::int32_t>(l.first)), point));
}

// Bilinear, in a level of each direction's own.
HWY_INLINE Vector3 LookUpOctahedral(const OctahedralLevels& map, IntVector level,
                                    const OctahedralPoint& point) {
  static_assert(sizeof(OctahedralLevels::Level) == 2 * sizeof(std::int32_t));
  const IntTag di;
  const auto* fields = reinterpret_cast<const std::int32_t*>(map.levels.data());
  const auto at = level + level;
  return Interpolate(
      map, FindOctahedralTaps(hn::GatherIndex(di, fields, at), hn::GatherIndex(di, fields + 1, at), point));
}

}  // namespace laterna::image::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
