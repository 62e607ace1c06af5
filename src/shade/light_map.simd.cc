// Light that was baked: one look-up per sample.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/light_map.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "frame/texture_coordinates-inl.h"
#include "frame/triangle_corners-inl.h"
#include "image/texture_lookup-inl.h"
#include "shade/light_map.h"
#include "shade/surface_hit-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using frame::HWY_NAMESPACE::FindFootprint;
using frame::HWY_NAMESPACE::TriangleCorners;
using image::HWY_NAMESPACE::LookUp;
using shadow::kGroupSize;

template <class Values>
HWY_INLINE Vector3 Load3(const Values& x, const Values& y, const Values& z, std::size_t i) {
  const FloatTag d;
  return {hn::Load(d, x.data() + i), hn::Load(d, y.data() + i), hn::Load(d, z.data() + i)};
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

template <bool kUniform>
HWY_INLINE void AddAt(const PointSource& source, const ReflectionSettings& settings,
                      const frame::LightMapBinding& map, const PixelRays& rays,
                      const TriangleCorners<kUniform>& corners, const Facet& facet,
                      const shadow::SurfaceSamples& s, const SurfacePoints& points, Radiance& radiance,
                      std::size_t i) {
  const FloatTag d;
  const Hit hit = FindHit(rays, facet, hn::Load(d, s.x.data() + i), hn::Load(d, s.y.data() + i),
                          hn::Load(d, s.q.data() + i), source.interpolation);
  const auto look_up = [&](const frame::TextureBinding& side) HWY_ATTR {
    return LookUp(*side.chain, side.sampler, 1, FindFootprint(*source.frame, side, corners, hit.weights));
  };
  Vector3 irradiance = look_up(map.front);
  if (map.back.chain != nullptr && !hn::AllFalse(d, hit.shows_back))
    irradiance = IfThenElse3(hit.shows_back, look_up(map.back), irradiance);
  const Vector3 added = Multiply(MattReflectance(settings, points, i), irradiance * Splat(map.intensity)) +
                        Load3(radiance.r, radiance.g, radiance.b, i);
  hn::Store(added.x, d, radiance.r.data() + i);
  hn::Store(added.y, d, radiance.g.data() + i);
  hn::Store(added.z, d, radiance.b.data() + i);
}

void add_light_map(const PointSource& source, const ReflectionSettings& settings,
                   const frame::LightMapBinding& light_map, const shadow::SurfaceSamples& samples,
                   const SurfacePoints& points, Radiance& radiance) {
  const PixelRays rays(*source.view);
  const TriangleId* ids = samples.id.data();
  for (std::size_t first = 0; first < samples.group_count * kGroupSize; first += kGroupSize) {
    if (IsOneTriangle(ids + first)) {
      const TriangleCorners<true> corners(*source.frame, ids + first);
      const Facet facet = FindFacet<true>(rays, corners.Positions());
      for (std::size_t i = first; i < first + kGroupSize; i += kLanes)
        AddAt(source, settings, light_map, rays, corners, facet, samples, points, radiance, i);
    } else {
      for (std::size_t i = first; i < first + kGroupSize; i += kLanes) {
        const TriangleCorners<false> corners(*source.frame, ids + i);
        AddAt(source, settings, light_map, rays, corners, FindFacet<false>(rays, corners.Positions()),
              samples, points, radiance, i);
      }
    }
  }
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shade {
LATERNA_KERNEL_TABLE(add_light_map)
}  // namespace laterna::shade
#endif
