// What an environment shows along directions, and how much of it rough surfaces mirror.
#if defined(LATERNA_SHADE_ENVIRONMENT_LOOKUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADE_ENVIRONMENT_LOOKUP_INL_H_
#undef LATERNA_SHADE_ENVIRONMENT_LOOKUP_INL_H_
#else
#define LATERNA_SHADE_ENVIRONMENT_LOOKUP_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "base/vectors-inl.h"
#include "image/octahedral_lookup-inl.h"
#include "shade/environment_light.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using image::HWY_NAMESPACE::LookUpOctahedral;
using image::HWY_NAMESPACE::OctahedralPoint;
using image::HWY_NAMESPACE::OctahedralPointOf;

template <class Samples>
HWY_INLINE Vector3 Load3(const Samples& x, const Samples& y, const Samples& z, std::size_t i) {
  const FloatTag d;
  return {hn::Load(d, x.data() + i), hn::Load(d, y.data() + i), hn::Load(d, z.data() + i)};
}

HWY_INLINE Vector3 Multiply(const Vector3& a, const Vector3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

HWY_INLINE Vector3 ToEnvironment(const EnvironmentLight& light, const Vector3& v) {
  const auto row = [&](int i) HWY_ATTR { return Dot(Splat3(light.environment_from_world[i]), v); };
  return {row(0), row(1), row(2)};
}

// How far along a ray from within a box one of three pairs of its sides is.
HWY_INLINE FloatVector DistanceToSides(FloatVector at, FloatVector along, float low, float high) {
  const auto side = hn::IfThenElse(along < Splat(0.0F), Splat(low), Splat(high));
  const auto is_parallel = hn::Abs(along) < Splat(1e-20F);
  return hn::IfThenElse(is_parallel, Splat(1e30F),
                        (side - at) / hn::IfThenElse(is_parallel, Splat(1.0F), along));
}

// Where a ray from a point meets what the environment shows, as a direction from where it was taken: Lagarde & Zanuttini
// 2012, Local image-based lighting with parallax-corrected cubemaps. From outside the box or sphere: the ray's own.
HWY_INLINE Vector3 CorrectParallax(const EnvironmentLight& light, const Vector3& point_ws,
                                   const Vector3& along) {
  const auto zero = Splat(0.0F);
  FloatMask is_inside;
  FloatVector distance;
  if (light.distance == EnvironmentDistance::box) {
    const float *low = light.box_low_ws, *high = light.box_high_ws;
    const auto within = [](FloatVector at, float from, float to)
                            HWY_ATTR { return hn::And(at >= Splat(from), at <= Splat(to)); };
    is_inside = hn::And(within(point_ws.x, low[0], high[0]),
                        hn::And(within(point_ws.y, low[1], high[1]), within(point_ws.z, low[2], high[2])));
    distance = hn::Min(DistanceToSides(point_ws.x, along.x, low[0], high[0]),
                       hn::Min(DistanceToSides(point_ws.y, along.y, low[1], high[1]),
                               DistanceToSides(point_ws.z, along.z, low[2], high[2])));
  } else {
    const Vector3 from_center = point_ws - Splat3(light.center_ws);
    const auto b = Dot(from_center, along);
    const auto c = Dot(from_center, from_center) - Splat(light.radius_squared);
    is_inside = c <= zero;
    distance = hn::Sqrt(hn::Max(b * b - c, zero)) - b;
  }
  const Vector3 seen = point_ws + along * distance - Splat3(light.center_ws);
  return IfThenElse3(is_inside, seen, along);
}

// The environment as a mirror of a roughness shows it, times its intensity. `along`: unit, from `point_ws`.
HWY_INLINE Vector3 Mirrored(const EnvironmentLight& light, const Vector3& point_ws, const Vector3& along,
                            FloatVector roughness) {
  const FloatTag d;
  const IntTag di;
  const Vector3 seen =
      light.distance == EnvironmentDistance::infinite ? along : CorrectParallax(light, point_ws, along);
  const OctahedralPoint point = OctahedralPointOf(ToEnvironment(light, seen));
  const auto last = static_cast<float>(light.mirrored->levels.size() - 1);
  const auto level = Saturate(roughness) * Splat(last);
  const auto sharper = hn::Min(hn::Floor(level), Splat(std::max(last - 1, 0.0F)));
  const auto number = hn::ConvertTo(di, sharper);
  const auto blend = level - sharper;
  Vector3 radiance = LookUpOctahedral(*light.mirrored, number, point);
  if (!hn::AllTrue(d, blend == Splat(0.0F))) {
    const Vector3 rougher = LookUpOctahedral(*light.mirrored, number + SplatInt(1), point);
    radiance = radiance + (rougher - radiance) * blend;
  }
  return radiance * Splat(light.intensity);
}

// What a white matt surface shows: Ramamoorthi & Hanrahan 2001, equation 10, over π. Harmonics of order 2 may fall below 0
// opposite a bright light.
HWY_INLINE Vector3 Matt(const EnvironmentLight& light, const Vector3& normal_ws) {
  const Vector3 n = ToEnvironment(light, normal_ws);
  const FloatVector basis[9] = {Splat(0.282094792F),
                                Splat(0.488602512F) * n.y,
                                Splat(0.488602512F) * n.z,
                                Splat(0.488602512F) * n.x,
                                Splat(1.092548431F) * n.x * n.y,
                                Splat(1.092548431F) * n.y * n.z,
                                Splat(0.315391565F) * (Splat(3.0F) * n.z * n.z - Splat(1.0F)),
                                Splat(1.092548431F) * n.x * n.z,
                                Splat(0.546274215F) * (n.x * n.x - n.y * n.y)};
  const auto channel = [&](const float* coefficients) HWY_ATTR {
    auto sum = basis[0] * Splat(coefficients[0]);
    for (int i = 1; i < 9; ++i) sum = sum + basis[i] * Splat(coefficients[i]);
    return hn::Max(sum, Splat(0.0F));
  };
  return {channel(light.matt[0]), channel(light.matt[1]), channel(light.matt[2])};
}

// A table's column across n·v and row down roughness, both from 0 to 1.
struct TablePlace {
  IntVector at;
  FloatVector u, v;
};

template <int kSide>
HWY_INLINE TablePlace FindTablePlace(FloatVector n_v, FloatVector roughness) {
  const IntTag di;
  const auto x = Saturate(n_v) * Splat(kSide - 1.0F), y = Saturate(roughness) * Splat(kSide - 1.0F);
  const auto column = hn::Min(hn::Floor(x), Splat(kSide - 2.0F)),
             row = hn::Min(hn::Floor(y), Splat(kSide - 2.0F));
  return {hn::ConvertTo(di, row) * SplatInt(kSide) + hn::ConvertTo(di, column), x - column, y - row};
}

template <int kSide>
HWY_INLINE FloatVector LookUpTable(const float* values, const TablePlace& place) {
  const FloatTag d;
  const auto upper_left = hn::GatherIndex(d, values, place.at);
  const auto upper = upper_left + (hn::GatherIndex(d, values + 1, place.at) - upper_left) * place.u;
  const auto lower_left = hn::GatherIndex(d, values + kSide, place.at);
  const auto lower = lower_left + (hn::GatherIndex(d, values + kSide + 1, place.at) - lower_left) * place.u;
  return upper + (lower - upper) * place.v;
}

struct ScaleAndBiasVectors {
  FloatVector scale, bias;
};

HWY_INLINE ScaleAndBiasVectors LookUpSplitSum(const SplitSum& table, FloatVector n_v, FloatVector roughness) {
  const TablePlace place = FindTablePlace<SplitSum::kSide>(n_v, roughness);
  return {LookUpTable<SplitSum::kSide>(table.scale.data(), place),
          LookUpTable<SplitSum::kSide>(table.bias.data(), place)};
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
