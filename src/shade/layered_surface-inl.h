// N samples of a surface with lobes, and how its layers share out light.
#if defined(LATERNA_SHADE_LAYERED_SURFACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADE_LAYERED_SURFACE_INL_H_
#undef LATERNA_SHADE_LAYERED_SURFACE_INL_H_
#else
#define LATERNA_SHADE_LAYERED_SURFACE_INL_H_
#endif

#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "shade/environment_lookup-inl.h"
#include "shade/layered_reflection.h"
#include "shade/lobe_formulas-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

HWY_INLINE void StoreRadiance(const Vector3& v, Radiance& radiance, std::size_t i) {
  const FloatTag d;
  hn::Store(v.x, d, radiance.r.data() + i);
  hn::Store(v.y, d, radiance.g.data() + i);
  hn::Store(v.z, d, radiance.b.data() + i);
}

struct LayeredSample {
  Vector3 normal, to_eye, base;
  FloatVector metallic, roughness, transmission;
};

HWY_INLINE LayeredSample LoadSample(const LayeredSurface& surface, std::size_t i) {
  const FloatTag d;
  const SurfacePoints& p = *surface.points;
  LayeredSample s;
  s.normal = Load3(p.normal_x_ws, p.normal_y_ws, p.normal_z_ws, i);
  s.to_eye = Load3(p.to_eye_x_ws, p.to_eye_y_ws, p.to_eye_z_ws, i);
  s.base = Load3(p.base_r, p.base_g, p.base_b, i);
  s.metallic = hn::Load(d, p.metallic.data() + i);
  s.roughness = hn::Load(d, p.roughness.data() + i);
  s.transmission = Splat(0.0F);
  if (surface.lobes->has_transmission)
    s.transmission = hn::Load(d, surface.lobe_points->transmission.data() + i);
  return s;
}

// What is mirrored at an angle, and what of it is kept from going on into what is no metal.
struct Fresnel {
  Vector3 mirrored, kept;
};

// mix(dielectric, metal, metallic) of glTF 2.0, appendix B.3.5, with F₀ and F₉₀ of KHR_materials_ior and _specular, whose
// largest channel is what the layer beneath does not get; a film over both (KHR_materials_iridescence).
HWY_INLINE Fresnel FindFresnel(const LayeredSurface& surface, const LayeredSample& s, FloatVector cosine,
                               std::size_t i) {
  const FloatTag d;
  const LobePoints& p = *surface.lobe_points;
  const Vector3 f0 = Load3(p.f0_r, p.f0_g, p.f0_b, i);
  const auto weight = hn::Load(d, p.specular.data() + i);
  Vector3 dielectric = Schlick(f0, cosine), metal = Schlick(s.base, cosine);
  if (surface.lobes->has_iridescence) {
    const auto share = hn::Load(d, p.iridescence.data() + i);
    const ThinFilm film = {Splat(surface.lobes->values.iridescence.ior),
                           hn::Load(d, p.film_thickness.data() + i)};
    dielectric = Mixed(dielectric, FilmReflectance(film, cosine, f0), share);
    metal = Mixed(metal, FilmReflectance(film, cosine, s.base), share);
  }
  dielectric = dielectric * weight;
  return {Mixed(dielectric, metal, s.metallic), Mixed(Grey(Largest(dielectric)), metal, s.metallic)};
}

// Of the base colour, what is scattered diffusely.
HWY_INLINE Vector3 DiffuseShare(const LayeredSample& s, const Fresnel& fresnel) {
  const auto zero = Splat(0.0F), one = Splat(1.0F);
  const auto share = (one - s.metallic) * (one - s.transmission);
  const auto channel = [&](FloatVector base, FloatVector kept)
                           HWY_ATTR { return hn::Max(one - kept, zero) * (base * share); };
  return {channel(s.base.x, fresnel.kept.x), channel(s.base.y, fresnel.kept.y),
          channel(s.base.z, fresnel.kept.z)};
}

struct Sheen {
  Vector3 color;
  FloatVector roughness, largest;
  const SheenAlbedo* table;

  // E of the lobe at a cosine.
  [[nodiscard]] HWY_INLINE FloatVector albedo_at(FloatVector cosine) const {
    const TablePlace place = FindTablePlace<SheenAlbedo::kSide>(cosine, roughness);
    return LookUpTable<SheenAlbedo::kSide>(table->share.data(), place);
  }
  // What it leaves to the layers beneath.
  [[nodiscard]] HWY_INLINE FloatVector rest_at(FloatVector cosine) const {
    return Splat(1.0F) - largest * albedo_at(cosine);
  }
};

HWY_INLINE Sheen LoadSheen(const LayeredSurface& surface, std::size_t i) {
  const LobePoints& p = *surface.lobe_points;
  const Vector3 color = Load3(p.sheen_r, p.sheen_g, p.sheen_b, i);
  return {color, hn::Load(FloatTag(), p.sheen_roughness.data() + i), Largest(color), surface.sheen};
}

HWY_INLINE FloatVector LoadCoatShare(const LayeredSurface& surface, const LayeredSample& s, std::size_t i) {
  const LobePoints& p = *surface.lobe_points;
  const Vector3 normal = Load3(p.coat_normal_x_ws, p.coat_normal_y_ws, p.coat_normal_z_ws, i);
  return CoatShare(hn::Load(FloatTag(), p.clearcoat.data() + i), normal, s.to_eye);
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
