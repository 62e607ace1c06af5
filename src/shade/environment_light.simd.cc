// Light from all around.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/environment_light.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
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
using shadow::kGroupSize;

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

// Everything that reflection asks about N samples.
struct Reflecting {
  Vector3 point_ws, normal, to_eye, base;
  FloatVector metallic, roughness;
};

HWY_INLINE Vector3 MirroredAbout(const EnvironmentLight& light, const Reflecting& in, FloatVector n_v,
                                 FloatVector roughness) {
  const Vector3 along = in.normal * (Splat(2.0F) * n_v) - in.to_eye;
  return Mirrored(light, in.point_ws, along, roughness);
}

HWY_INLINE Vector3 NormalReflectance(const Reflecting& in) {
  const auto dielectric = Splat(0.04F);
  const auto channel = [&](FloatVector base)
                           HWY_ATTR { return dielectric + (base - dielectric) * in.metallic; };
  return {channel(in.base.x), channel(in.base.y), channel(in.base.z)};
}

HWY_INLINE Vector3 ReflectPhong(const EnvironmentLight& light, const Reflecting& in,
                                const std::optional<PhongHighlight>& highlight) {
  const auto n_v = Dot(in.normal, in.to_eye);
  const Vector3 matt = Matt(light, in.normal);
  if (highlight) {
    const Vector3 mirrored = MirroredAbout(light, in, n_v, Splat(light.highlight_roughness));
    return Multiply(in.base, matt) + mirrored * Splat(highlight->specular);
  }
  const Vector3 mirrored = MirroredAbout(light, in, n_v, in.roughness);
  return Multiply(in.base, matt) * (Splat(1.0F) - in.metallic) + Multiply(NormalReflectance(in), mirrored);
}

struct ScaleAndBiasVectors {
  FloatVector scale, bias;
};

HWY_INLINE ScaleAndBiasVectors LookUpSplitSum(const SplitSum& table, FloatVector n_v, FloatVector roughness) {
  const FloatTag d;
  const IntTag di;
  constexpr int kSide = SplitSum::kSide;
  const auto x = Saturate(n_v) * Splat(kSide - 1.0F), y = Saturate(roughness) * Splat(kSide - 1.0F);
  const auto column = hn::Min(hn::Floor(x), Splat(kSide - 2.0F)),
             row = hn::Min(hn::Floor(y), Splat(kSide - 2.0F));
  const auto at = hn::ConvertTo(di, row) * SplatInt(kSide) + hn::ConvertTo(di, column);
  const auto u = x - column, v = y - row;
  const auto interpolate = [&](const float* values) HWY_ATTR {
    const auto upper_left = hn::GatherIndex(d, values, at);
    const auto upper = upper_left + (hn::GatherIndex(d, values + 1, at) - upper_left) * u;
    const auto lower_left = hn::GatherIndex(d, values + kSide, at);
    const auto lower = lower_left + (hn::GatherIndex(d, values + kSide + 1, at) - lower_left) * u;
    return upper + (lower - upper) * v;
  };
  return {interpolate(table.scale.data()), interpolate(table.bias.data())};
}

// The split sum, and light that is reflected more than once between a rough surface's facets: Fdez-Agüera 2019, A
// multiple-scattering microfacet model for real-time image-based lighting. What is not mirrored is reflected diffusely,
// so that a white surface shows as much as falls on it.
HWY_INLINE Vector3 ReflectPbr(const EnvironmentLight& light, const Reflecting& in) {
  const auto one = Splat(1.0F);
  const auto n_v = Dot(in.normal, in.to_eye);
  const Vector3 mirrored = MirroredAbout(light, in, n_v, in.roughness);
  const Vector3 matt = Matt(light, in.normal);
  const ScaleAndBiasVectors entry = LookUpSplitSum(*light.split_sum, n_v, in.roughness);
  const auto missing = one - (entry.scale + entry.bias);
  const Vector3 f0 = NormalReflectance(in);
  const auto diffuse_share = one - in.metallic;
  const auto channel = [&](FloatVector reflectance, FloatVector base, FloatVector mirror,
                           FloatVector matt_light) HWY_ATTR {
    const auto once = reflectance * entry.scale + entry.bias;
    const auto mean_fresnel = reflectance + (one - reflectance) * Splat(1.0F / 21);
    const auto again = missing * once * mean_fresnel / (one - mean_fresnel * missing);
    const auto diffuse = base * diffuse_share * (one - (once + again));
    return once * mirror + (again + diffuse) * matt_light;
  };
  return {channel(f0.x, in.base.x, mirrored.x, matt.x), channel(f0.y, in.base.y, mirrored.y, matt.y),
          channel(f0.z, in.base.z, mirrored.z, matt.z)};
}

HWY_INLINE Vector3 Reflect(const EnvironmentLight& light, const ReflectionSettings& settings,
                           const Reflecting& in) {
  switch (settings.model) {
    case ShadingModel::papers:
      return Multiply(in.base, Matt(light, in.normal));
    case ShadingModel::phong:
      return ReflectPhong(light, in, settings.phong);
    case ShadingModel::pbr:
      break;
  }
  return ReflectPbr(light, in);
}

void reflect_environment(const EnvironmentLight& light, const ReflectionSettings& settings,
                         const shadow::SurfaceSamples& samples, const SurfacePoints& points, bool add,
                         Radiance& radiance) {
  const FloatTag d;
  for (std::size_t i = 0; i < samples.group_count * kGroupSize; i += kLanes) {
    Reflecting in;
    in.point_ws = Load3(samples.x_ws, samples.y_ws, samples.z_ws, i);
    in.normal = Load3(points.normal_x_ws, points.normal_y_ws, points.normal_z_ws, i);
    in.to_eye = Load3(points.to_eye_x_ws, points.to_eye_y_ws, points.to_eye_z_ws, i);
    in.base = Load3(points.base_r, points.base_g, points.base_b, i);
    in.metallic = hn::Load(d, points.metallic.data() + i);
    in.roughness = hn::Load(d, points.roughness.data() + i);
    Vector3 out = Reflect(light, settings, in) * hn::Load(d, points.occlusion.data() + i);
    if (add) out = Load3(radiance.r, radiance.g, radiance.b, i) + out;
    hn::Store(out.x, d, radiance.r.data() + i);
    hn::Store(out.y, d, radiance.g.data() + i);
    hn::Store(out.z, d, radiance.b.data() + i);
  }
}

void show_environment(const EnvironmentLight& light, const PixelRays& rays, const float* x, const float* y,
                      float* r, float* g, float* b) {
  const FloatTag d;
  for (std::size_t i = 0; i < kGroupSize; i += kLanes) {
    const Vector3 at = Splat3(rays.direction_0) + Splat3(rays.direction_x) * hn::Load(d, x + i) +
                       Splat3(rays.direction_y) * hn::Load(d, y + i);
    // A perspective view's rays leave its eye; an orthographic one's are parallel, from before the scene.
    const Vector3 along = rays.is_orthographic ? Splat3(rays.axis) * Splat(-1.0F) : Normalised(at);
    const Vector3 from = rays.is_orthographic ? at : Splat3(rays.eye);
    const Vector3 seen = Mirrored(light, from, along, Splat(0.0F));
    hn::Store(seen.x, d, r + i);
    hn::Store(seen.y, d, g + i);
    hn::Store(seen.z, d, b + i);
  }
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shade {
LATERNA_KERNEL_TABLE(reflect_environment)
LATERNA_KERNEL_TABLE(show_environment)
}  // namespace laterna::shade
#endif
