// Intensity of a measured lamp by direction. Included once per target by *.simd.cc files.
#if defined(LATERNA_SHADE_LAMP_LOOKUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADE_LAMP_LOOKUP_INL_H_
#undef LATERNA_SHADE_LAMP_LOOKUP_INL_H_
#else
#define LATERNA_SHADE_LAMP_LOOKUP_INL_H_
#endif

#include <hwy/highway.h>

#include "base/arctangent-inl.h"
#include "base/vectors-inl.h"
#include "frame/lamp_table.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

struct LampPlace {
  IntVector cell;
  FloatVector share;
  FloatMask is_inside;
};

HWY_INLINE LampPlace FindLampPlace(const frame::LampAxis& axis, FloatVector angle) {
  const FloatTag d;
  const IntTag di;
  // Rounding of the angle itself must not make the ends of the grid dark.
  const auto slack = Splat(1e-4F);
  const auto first = Splat(axis.angle_deg.front()), last = Splat(axis.angle_deg.back());
  LampPlace place;
  place.is_inside = hn::And(angle >= first - slack, angle <= last + slack);
  const auto held = hn::Min(hn::Max(angle, first), last);
  const auto bin =
      hn::Min(hn::ConvertTo(di, (held - first) * Splat(axis.bins_per_degree)), SplatInt(axis.last_bin()));
  const auto last_cell = SplatInt(axis.last_cell());
  place.cell = hn::GatherIndex(di, axis.cell_of_bin.data(), bin);
  for (int step = 0; step < axis.steps; ++step) {
    const auto next = hn::Min(place.cell + SplatInt(1), last_cell);
    const auto is_beyond = held >= hn::GatherIndex(d, axis.angle_deg.data(), next);
    place.cell = hn::IfThenElse(hn::RebindMask(di, is_beyond), next, place.cell);
  }
  place.share = Saturate((held - hn::GatherIndex(d, axis.angle_deg.data(), place.cell)) *
                         hn::GatherIndex(d, axis.inverse_width.data(), place.cell));
  return place;
}

// Share of the lamp's peak toward directions given along the light's right, up and forward: the equations of
// PhotometricType, solved for the angles.
HWY_INLINE FloatVector LampShare(const frame::LampTable& lamp, const Vector3& direction_ls) {
  const FloatTag d;
  const auto x = direction_ls.x, y = direction_ls.y, forward = direction_ls.z;
  const auto minus_y = Splat(0.0F) - y;
  FloatVector vertical, horizontal;
  switch (lamp.type) {
    case PhotometricType::type_a:
      vertical = DegreesOf(x, hn::Sqrt(y * y + forward * forward));
      horizontal = DegreesOf(minus_y, forward);
      break;
    case PhotometricType::type_b:
      vertical = DegreesOf(x, forward);
      horizontal = DegreesOf(minus_y, hn::Sqrt(x * x + forward * forward));
      break;
    default:
      vertical = DegreesOf(hn::Sqrt(x * x + y * y), forward);
      horizontal = DegreesOf(y, x);
      horizontal = hn::IfThenElse(horizontal < Splat(0.0F), horizontal + Splat(360.0F), horizontal);
      break;
  }
  const LampPlace v = FindLampPlace(lamp.vertical, vertical), h = FindLampPlace(lamp.horizontal, horizontal);
  const auto rows = SplatInt(static_cast<std::int32_t>(lamp.vertical.angle_deg.size()));
  const auto corner = h.cell * rows + v.cell;
  const auto at = [&](IntVector index) HWY_ATTR { return hn::GatherIndex(d, lamp.share.data(), index); };
  const auto mix = [](FloatVector a, FloatVector b, FloatVector share)
                       HWY_ATTR { return a + (b - a) * share; };
  const auto one = SplatInt(1);
  const auto here = mix(at(corner), at(corner + one), v.share);
  const auto beside = mix(at(corner + rows), at(corner + rows + one), v.share);
  return hn::IfThenElseZero(hn::And(v.is_inside, h.is_inside), mix(here, beside, h.share));
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
