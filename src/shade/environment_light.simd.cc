// Light from all around.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/environment_light.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "base/vectors-inl.h"
#include "shade/environment_light.h"
#include "shade/environment_lookup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using shadow::kGroupSize;

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
