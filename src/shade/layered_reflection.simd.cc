// Light of lamps, suns and projectors on surfaces with lobes.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/layered_reflection.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "shade/layered_reflection.h"
#include "shade/layered_surface-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using shadow::kGroupSize;

// One light at N samples.
struct Incidence {
  Vector3 to_light, half;
  FloatVector cosine;  // n·l
};

// Cosines at a normal.
struct LobeAngles {
  FloatVector n_l, n_v, n_h;
};

HWY_INLINE LobeAngles AnglesAt(const Vector3& normal, const Vector3& to_eye, const Incidence& in) {
  return {Saturate(Dot(normal, in.to_light)), Saturate(Dot(normal, to_eye)), Saturate(Dot(normal, in.half))};
}

HWY_INLINE FloatVector BaseFacets(const LayeredSurface& surface, const LayeredSample& s, const Incidence& in,
                                  const LobeAngles& angles, std::size_t i) {
  if (!surface.lobes->has_anisotropy) return Facets(angles.n_l, angles.n_v, angles.n_h, s.roughness);
  const LobePoints& p = *surface.lobe_points;
  const Vector3 along = Load3(p.along_x_ws, p.along_y_ws, p.along_z_ws, i);
  const Vector3 across = Cross(s.normal, along);
  const auto in_frame = [&](const Vector3& w, FloatVector normal) HWY_ATTR {
    return BrushedCosines{Dot(along, w), Dot(across, w), normal};
  };
  return BrushedFacets(in_frame(in.to_light, angles.n_l), in_frame(s.to_eye, angles.n_v),
                       in_frame(in.half, angles.n_h), s.roughness,
                       hn::Load(FloatTag(), p.anisotropy.data() + i));
}

// What of the light from one side goes to the eye, times n·l. kHighlights: false leaves what is scattered diffusely.
template <bool kHighlights>
HWY_INLINE Vector3 ReflectLayers(const LayeredSurface& surface, const LayeredSample& s, const Incidence& in,
                                 std::size_t i) {
  const FloatTag d;
  const frame::SurfaceLobes& lobes = *surface.lobes;
  const LobePoints& p = *surface.lobe_points;
  LobeAngles angles = AnglesAt(s.normal, s.to_eye, in);
  angles.n_l = Saturate(in.cosine);
  const auto v_h = Saturate(Dot(s.to_eye, in.half));
  const Fresnel fresnel = FindFresnel(surface, s, v_h, i);

  const Vector3 scattered = DiffuseShare(s, fresnel) * Splat(kInversePi);
  Vector3 base = scattered;
  if constexpr (kHighlights) {
    base = base + fresnel.mirrored * BaseFacets(surface, s, in, angles, i);
  }
  Vector3 sum = base * angles.n_l;
  if (lobes.has_sheen) {
    const Sheen sheen = LoadSheen(surface, i);
    // The less of both ways, so that light may go either way alike.
    const auto rest = hn::Min(sheen.rest_at(angles.n_v), sheen.rest_at(angles.n_l));
    sum = sum * rest;
    if constexpr (kHighlights) {
      const auto fibres = SheenFibres(angles.n_l, angles.n_v, angles.n_h, sheen.roughness);
      sum = sum + sheen.color * (fibres * angles.n_l);
    }
  }
  if (lobes.has_clearcoat) {
    const Vector3 normal = Load3(p.coat_normal_x_ws, p.coat_normal_y_ws, p.coat_normal_z_ws, i);
    const auto share = CoatShare(hn::Load(d, p.clearcoat.data() + i), normal, s.to_eye);
    sum = sum * (Splat(1.0F) - share);
    if constexpr (kHighlights) {
      const LobeAngles coat = AnglesAt(normal, s.to_eye, in);
      const auto lobe =
          Facets(coat.n_l, coat.n_v, coat.n_h, hn::Load(d, p.clearcoat_roughness.data() + i)) * coat.n_l;
      sum = sum + Grey(share * lobe);
    }
  }
  return sum;
}

HWY_INLINE Vector3 ArrivingAt(const shadow::Arrival& arrival, std::size_t i) {
  if (arrival.is_tinted) return Load3(arrival.r, arrival.g, arrival.b, i);
  return Grey(hn::Load(FloatTag(), arrival.alpha.data() + i));
}

void reflect_layered(const LayeredSurface& surface, std::size_t groups, const Irradiance& irradiance,
                     const shadow::Arrival& arrival, float fill, bool add, Radiance& radiance) {
  const FloatTag d;
  const Vector3 nothing = Grey(Splat(0.0F)), all = Grey(Splat(1.0F));
  for (std::size_t group = 0; group < groups; ++group) {
    for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
      const std::size_t i = group * kGroupSize + k;
      const auto is_lit = MaskFromBits(std::uint32_t{irradiance.lit[group]} >> k);
      if (hn::AllFalse(d, is_lit)) {
        if (!add) StoreRadiance(nothing, radiance, i);
        continue;
      }
      const LayeredSample s = LoadSample(surface, i);
      Incidence in;
      in.to_light = Load3(irradiance.to_light_x_ws, irradiance.to_light_y_ws, irradiance.to_light_z_ws, i);
      in.half = Normalised(s.to_eye + in.to_light);
      in.cosine = hn::Load(d, irradiance.cosine.data() + i);
      const Vector3 unhindered = Load3(irradiance.r, irradiance.g, irradiance.b, i);
      const Vector3 arriving = ArrivingAt(arrival, i);
      Vector3 out = Times(Times(unhindered, arriving), ReflectLayers<true>(surface, s, in, i));
      if (fill > 0) {
        const Vector3 missing = Times(unhindered, all - arriving) * Splat(fill);
        out = out + Times(missing, ReflectLayers<false>(surface, s, in, i));
      }
      out = IfThenElse3(is_lit, out, nothing);
      StoreRadiance(add ? Load3(radiance.r, radiance.g, radiance.b, i) + out : out, radiance, i);
    }
  }
}

void light_coat(const shadow::SurfaceSamples& samples, const LobePoints& lobes, Irradiance& irradiance) {
  const auto zero = Splat(0.0F);
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    std::uint32_t lit = 0;
    for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
      const std::size_t i = group * kGroupSize + k;
      const Vector3 color = Load3(irradiance.r, irradiance.g, irradiance.b, i);
      const Vector3 normal = Load3(lobes.coat_normal_x_ws, lobes.coat_normal_y_ws, lobes.coat_normal_z_ws, i);
      const Vector3 to_light =
          Load3(irradiance.to_light_x_ws, irradiance.to_light_y_ws, irradiance.to_light_z_ws, i);
      lit |= BitsOf(hn::And(Largest(color) > zero, Dot(normal, to_light) > zero)) << k;
    }
    irradiance.lit[group] = static_cast<std::uint16_t>(irradiance.lit[group] | (lit & samples.active[group]));
  }
}

void find_layered_ambient(const ReflectionSettings& settings, const LayeredSurface& surface,
                          std::size_t groups, Radiance& radiance) {
  const FloatTag d;
  const auto one = Splat(1.0F);
  const SurfacePoints& points = *surface.points;
  for (std::size_t i = 0; i < groups * kGroupSize; i += kLanes) {
    const LayeredSample s = LoadSample(surface, i);
    const Vector3 ambient = Splat3(settings.ambient) * hn::Load(d, points.occlusion.data() + i);
    const auto kept = one - s.transmission * (one - s.metallic);
    Vector3 sum =
        Times(s.base, ambient) * kept + Load3(points.emissive_r, points.emissive_g, points.emissive_b, i);
    if (surface.lobes->has_clearcoat) sum = sum * (one - LoadCoatShare(surface, s, i));
    StoreRadiance(sum, radiance, i);
  }
}

void reflect_layered_baked(const LayeredSurface& surface, std::size_t groups,
                           const BakedIrradiance& irradiance, Radiance& radiance) {
  const auto one = Splat(1.0F);
  for (std::size_t i = 0; i < groups * kGroupSize; i += kLanes) {
    const LayeredSample s = LoadSample(surface, i);
    Vector3 share = DiffuseShare(s, FindFresnel(surface, s, one, i)) * Splat(kInversePi);
    if (surface.lobes->has_sheen)
      share = share * LoadSheen(surface, i).rest_at(Saturate(Dot(s.normal, s.to_eye)));
    if (surface.lobes->has_clearcoat) share = share * (one - LoadCoatShare(surface, s, i));
    const Vector3 reflected = Times(share, Load3(irradiance.r, irradiance.g, irradiance.b, i));
    StoreRadiance(Load3(radiance.r, radiance.g, radiance.b, i) + reflected, radiance, i);
  }
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shade {
LATERNA_KERNEL_TABLE(light_coat)
LATERNA_KERNEL_TABLE(reflect_layered)
LATERNA_KERNEL_TABLE(find_layered_ambient)
LATERNA_KERNEL_TABLE(reflect_layered_baked)
}  // namespace laterna::shade
#endif
