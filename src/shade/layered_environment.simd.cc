// Light from all around, and from behind, at surfaces with lobes.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/layered_environment.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "base/vectors-inl.h"
#include "image/texture_lookup-inl.h"
#include "shade/environment_lookup-inl.h"
#include "shade/layered_reflection.h"
#include "shade/layered_surface-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using shadow::kGroupSize;

// What the base mirrors of light of 1 from everywhere.
struct BaseAlbedo {
  Vector3 once, again;  // off one facet, and off several (Fdez-Agüera 2019)
};

// As a plain surface's, with F₀ and F₉₀ of its own. A film counts by what it mirrors at the angle of sight, as a Schlick
// term that has that value there.
HWY_INLINE BaseAlbedo FindBaseAlbedo(const LayeredSurface& surface, const LayeredSample& s,
                                     const SplitSum& table, FloatVector n_v, std::size_t i) {
  const FloatTag d;
  const auto one = Splat(1.0F);
  const LobePoints& p = *surface.lobe_points;
  const auto weight = hn::Load(d, p.specular.data() + i);
  Vector3 dielectric = Load3(p.f0_r, p.f0_g, p.f0_b, i), metal = s.base;
  if (surface.lobes->has_iridescence) {
    const auto share = hn::Load(d, p.iridescence.data() + i);
    const ThinFilm film = {Splat(surface.lobes->values.iridescence.ior),
                           hn::Load(d, p.film_thickness.data() + i)};
    const auto cosine = Saturate(n_v);
    dielectric = Mixed(dielectric, NormalOf(FilmReflectance(film, cosine, dielectric), cosine), share);
    metal = Mixed(metal, NormalOf(FilmReflectance(film, cosine, metal), cosine), share);
  }
  const ScaleAndBiasVectors entry = LookUpSplitSum(table, n_v, s.roughness);
  const auto missing = one - (entry.scale + entry.bias);
  const auto f90 = weight + (one - weight) * s.metallic;
  const Vector3 f0 = Mixed(dielectric * weight, metal, s.metallic);
  const auto once = [&](FloatVector reflectance)
                        HWY_ATTR { return reflectance * entry.scale + f90 * entry.bias; };
  const auto again = [&](FloatVector reflectance) HWY_ATTR {
    const auto mean_fresnel = reflectance + (f90 - reflectance) * Splat(1.0F / 21);
    return missing * once(reflectance) * mean_fresnel / (one - mean_fresnel * missing);
  };
  return {{once(f0.x), once(f0.y), once(f0.z)}, {again(f0.x), again(f0.y), again(f0.z)}};
}

// What goes past the mirror: 1 − the largest channel of what is no metal, channel by channel of what is.
HWY_INLINE Vector3 RestOf(const BaseAlbedo& albedo, FloatVector metallic) {
  const auto zero = Splat(0.0F), one = Splat(1.0F);
  const Vector3 sum = albedo.once + albedo.again;
  const Vector3 kept = Mixed(Grey(Largest(sum)), sum, metallic);
  return {hn::Max(one - kept.x, zero), hn::Max(one - kept.y, zero), hn::Max(one - kept.z, zero)};
}

// The direction whose light is mirrored: of brushed surfaces about a normal bent toward the plane across the brush, as
// KHR_materials_anisotropy's implementation note has it (Revie 2012).
HWY_INLINE Vector3 MirroredDirection(const LayeredSurface& surface, const LayeredSample& s, FloatVector n_v,
                                     std::size_t i) {
  const auto two = Splat(2.0F), one = Splat(1.0F);
  if (!surface.lobes->has_anisotropy) return s.normal * (two * n_v) - s.to_eye;
  const LobePoints& p = *surface.lobe_points;
  const Vector3 across = Cross(s.normal, Load3(p.along_x_ws, p.along_y_ws, p.along_z_ws, i));
  const Vector3 bent = Normalised(Cross(Cross(across, s.to_eye), across));
  const auto strength = hn::Load(FloatTag(), p.anisotropy.data() + i);
  const auto a = one - strength * (one - s.roughness);
  const auto squared = a * a;
  const Vector3 normal = Normalised(Mixed(bent, s.normal, squared * squared));
  return normal * (two * Dot(normal, s.to_eye)) - s.to_eye;
}

HWY_INLINE Vector3 ReflectLayers(const EnvironmentLight& light, const LayeredSurface& surface,
                                 const Vector3& point_ws, std::size_t i) {
  const FloatTag d;
  const auto zero = Splat(0.0F), one = Splat(1.0F), two = Splat(2.0F);
  const LayeredSample s = LoadSample(surface, i);
  const auto n_v = Dot(s.normal, s.to_eye);
  const BaseAlbedo albedo = FindBaseAlbedo(surface, s, *light.split_sum, n_v, i);
  const Vector3 mirrored = Mirrored(light, point_ws, MirroredDirection(surface, s, n_v, i), s.roughness);
  const Vector3 matt = Matt(light, s.normal);
  const Vector3 scattered =
      Times(s.base, RestOf(albedo, s.metallic)) * ((one - s.metallic) * (one - s.transmission));
  Vector3 sum = Times(albedo.once, mirrored) + Times(albedo.again + scattered, matt);
  if (surface.lobes->has_sheen) {
    const Sheen sheen = LoadSheen(surface, i);
    const Vector3 direction = s.normal * (two * n_v) - s.to_eye;
    const Vector3 seen = Mirrored(light, point_ws, direction, sheen.roughness);
    sum = sum * sheen.rest_at(n_v) + Times(sheen.color * sheen.albedo_at(n_v), seen);
  }
  if (surface.lobes->has_clearcoat) {
    const LobePoints& p = *surface.lobe_points;
    const Vector3 normal = Load3(p.coat_normal_x_ws, p.coat_normal_y_ws, p.coat_normal_z_ws, i);
    const auto share = LoadCoatShare(surface, s, i);
    const auto cosine = Dot(normal, s.to_eye);
    const auto roughness = hn::Load(d, p.clearcoat_roughness.data() + i);
    const ScaleAndBiasVectors entry = LookUpSplitSum(*light.split_sum, cosine, roughness);
    const Vector3 seen = Mirrored(light, point_ws, normal * (two * cosine) - s.to_eye, roughness);
    sum = sum * (one - share) + seen * (share * hn::Max(entry.scale + entry.bias, zero));
  }
  return sum;
}

void reflect_layered_environment(const EnvironmentLight& light, const LayeredSurface& surface,
                                 const shadow::SurfaceSamples& samples, bool add, Radiance& radiance) {
  const FloatTag d;
  for (std::size_t i = 0; i < samples.group_count * kGroupSize; i += kLanes) {
    const Vector3 point_ws = Load3(samples.x_ws, samples.y_ws, samples.z_ws, i);
    Vector3 out =
        ReflectLayers(light, surface, point_ws, i) * hn::Load(d, surface.points->occlusion.data() + i);
    if (add) out = Load3(radiance.r, radiance.g, radiance.b, i) + out;
    StoreRadiance(out, radiance, i);
  }
}

// ---------------------------------------------------------------------------------------------- what lies behind

// Where a ray that enters the surface leaves it again: a thickness further along the refracted ray (Snell's law).
HWY_INLINE Vector3 ExitPoint(const LayeredSample& s, const Vector3& point_ws, float ior,
                             FloatVector thickness) {
  const float ratio = ior > 0 ? 1 / ior : 1;
  const auto eta = Splat(ratio), one = Splat(1.0F);
  const auto n_v = Dot(s.normal, s.to_eye);
  const auto k = one - eta * eta * (one - n_v * n_v);
  const Vector3 refracted = s.normal * (eta * n_v - hn::Sqrt(hn::Max(k, Splat(0.0F)))) - s.to_eye * eta;
  return point_ws + Normalised(refracted) * thickness;
}

// The earlier view about a point, over more of it the rougher the surface is: KHR_materials_transmission's own way of
// rasterisers, mip levels by log₂(width) · roughness, which counts the less the less is refracted.
HWY_INLINE Vector3 LookBehind(const EarlierView& behind, const Vector3& exit_ws, const Vector3& point_ws,
                              float ior, FloatVector roughness) {
  const auto zero = Splat(0.0F), one = Splat(1.0F);
  const PixelRays& rays = behind.rays;
  const auto width = Splat(static_cast<float>(behind.radiance.width()));
  const auto height = Splat(static_cast<float>(behind.radiance.height()));
  const auto depth_of = [&](const Vector3& p) HWY_ATTR {
    return rays.is_orthographic ? one : Dot(Splat3(rays.w_row), p - Splat3(rays.eye));
  };
  // Rays that leave behind the eye show what is straight behind.
  const auto is_ahead = depth_of(exit_ws) > Splat(rays.is_orthographic ? 0.0F : rays.near);
  const Vector3 from_eye = IfThenElse3(is_ahead, exit_ws, point_ws) - Splat3(rays.eye);
  const auto depth = rays.is_orthographic ? one : Dot(Splat3(rays.w_row), from_eye);
  const auto inverse = one / hn::Max(depth, Splat(1e-30F));
  const auto x = Dot(Splat3(rays.x_row), from_eye) * inverse + Splat(rays.x_add + behind.origin_x);
  const auto y = Dot(Splat3(rays.y_row), from_eye) * inverse + Splat(rays.y_add + behind.origin_y);
  const float bending = std::min(std::max(2 * ior - 2, 0.0F), 1.0F);
  const auto pixels = Power(width, Saturate(roughness) * Splat(bending));
  const image::HWY_NAMESPACE::Footprint footprint = {x / width, y / height, pixels / width,
                                                     zero,      zero,       pixels / height};
  constexpr Sampler kSampler = {Wrap::clamp, Wrap::clamp, Filter::linear, Filter::linear, MipFilter::linear};
  return image::HWY_NAMESPACE::LookUp(behind.radiance, kSampler, 1, footprint);
}

// Beer and Lambert: a distance turns white light to the attenuation colour, twice as much to its square.
HWY_INLINE Vector3 Attenuation(const VolumeLobe& volume, FloatVector distance) {
  const auto lengths = distance * Splat(1 / volume.attenuation_distance);
  const glm::vec3& color = volume.attenuation_color;
  const auto channel = [&](float c) HWY_ATTR {
    return hn::IfThenElse(lengths > Splat(0.0F), Power(Splat(c), lengths), Splat(1.0F));
  };
  return {channel(color.x), channel(color.y), channel(color.z)};
}

void transmit(const EarlierView& behind, const SplitSum& split_sum, const LayeredSurface& surface,
              const shadow::SurfaceSamples& samples, Radiance& radiance) {
  const FloatTag d;
  const auto one = Splat(1.0F);
  const frame::SurfaceLobes& lobes = *surface.lobes;
  for (std::size_t i = 0; i < samples.group_count * kGroupSize; i += kLanes) {
    const LayeredSample s = LoadSample(surface, i);
    const Vector3 point_ws = Load3(samples.x_ws, samples.y_ws, samples.z_ws, i);
    const auto thickness = hn::Load(d, surface.lobe_points->thickness.data() + i);
    const Vector3 exit_ws = ExitPoint(s, point_ws, lobes.values.ior, thickness);
    const Vector3 seen = LookBehind(behind, exit_ws, point_ws, lobes.values.ior, s.roughness);
    const auto n_v = Dot(s.normal, s.to_eye);
    const BaseAlbedo albedo = FindBaseAlbedo(surface, s, split_sum, n_v, i);
    Vector3 share =
        Times(Times(s.base, RestOf(albedo, s.metallic)), Attenuation(lobes.values.volume, thickness)) *
        (s.transmission * (one - s.metallic));
    if (lobes.has_sheen) share = share * LoadSheen(surface, i).rest_at(n_v);
    if (lobes.has_clearcoat) share = share * (one - LoadCoatShare(surface, s, i));
    StoreRadiance(Load3(radiance.r, radiance.g, radiance.b, i) + Times(share, seen), radiance, i);
  }
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shade {
LATERNA_KERNEL_TABLE(reflect_layered_environment)
LATERNA_KERNEL_TABLE(transmit)
}  // namespace laterna::shade
#endif
