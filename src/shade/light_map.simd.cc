// Light that was baked: one look-up per sample, reflected as a matt surface does.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/light_map.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "frame/texture_coordinates-inl.h"
#include "image/texture_lookup-inl.h"
#include "shade/light_map.h"
#include "shade/surface_hits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using frame::HWY_NAMESPACE::FindFootprint;
using image::HWY_NAMESPACE::LookUp;
using shadow::kGroupSize;

template <class Values>
HWY_INLINE Vector3 Load3(const Values& x, const Values& y, const Values& z, std::size_t i) {
  const FloatTag d;
  return {hn::Load(d, x.data() + i), hn::Load(d, y.data() + i), hn::Load(d, z.data() + i)};
}

template <class Values>
HWY_INLINE void Store3(const Vector3& v, Values& to, std::size_t i) {
  const FloatTag d;
  hn::Store(v.x, d, to.r.data() + i);
  hn::Store(v.y, d, to.g.data() + i);
  hn::Store(v.z, d, to.b.data() + i);
}

HWY_INLINE Vector3 Multiply(const Vector3& a, const Vector3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

// Radiance under an irradiance of 1.
HWY_INLINE Vector3 MattReflectance(const ReflectionSettings& settings, const SurfacePoints& points,
                                   std::size_t i) {
  const Vector3 base = Load3(points.base_r, points.base_g, points.base_b, i);
  if (settings.model == ShadingModel::papers) return base;
  const auto one = Splat(1.0F);
  const auto metallic = hn::Load(FloatTag(), points.metallic.data() + i);
  if (settings.model == ShadingModel::phong) return settings.phong ? base : base * (one - metallic);
  const auto share = (one - metallic) * Splat(0.318309886F);
  const auto channel = [&](FloatVector b) HWY_ATTR {
    const auto f0 = Splat(0.04F) + (b - Splat(0.04F)) * metallic;
    return (one - f0) * b * share;
  };
  return {channel(base.x), channel(base.y), channel(base.z)};
}

void find_baked_irradiance(const PointSource& source, const frame::Surface& surface,
                           const shadow::SurfaceSamples& samples, BakedIrradiance& irradiance) {
  const frame::LightMapBinding& map = surface.light_map;
  VisitSurfaceHits(source, surface, samples, [&](const auto& hits, std::size_t i) HWY_ATTR {
    const auto look_up = [&](const frame::TextureBinding& side) HWY_ATTR {
      return LookUp(*side.chain, side.sampler, 1,
                    FindFootprint(*source.frame, side, hits.corners, hits.hit.weights));
    };
    Vector3 found = look_up(map.front);
    if (map.back.chain != nullptr && !hn::AllFalse(FloatTag(), hits.hit.shows_back))
      found = IfThenElse3(hits.hit.shows_back, look_up(map.back), found);
    Store3(found * Splat(map.intensity), irradiance, i);
  });
}

void reflect_baked(const ReflectionSettings& settings, std::size_t groups, const SurfacePoints& points,
                   const BakedIrradiance& irradiance, Radiance& radiance) {
  for (std::size_t i = 0; i < groups * kGroupSize; i += kLanes) {
    const Vector3 reflected =
        Multiply(MattReflectance(settings, points, i), Load3(irradiance.r, irradiance.g, irradiance.b, i));
    Store3(reflected + Load3(radiance.r, radiance.g, radiance.b, i), radiance, i);
  }
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shade {
LATERNA_KERNEL_TABLE(find_baked_irradiance)
LATERNA_KERNEL_TABLE(reflect_baked)
}  // namespace laterna::shade
#endif
