// Layers of colour.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/blend_layers.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "base/vectors-inl.h"
#include "frame/texture_coordinates-inl.h"
#include "image/texture_lookup-inl.h"
#include "shade/blend_layers.h"
#include "shade/blend_modes-inl.h"
#include "shade/slide_lens-inl.h"
#include "shade/slide_point-inl.h"
#include "shade/surface_hits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using frame::HWY_NAMESPACE::FindFootprint;
using image::HWY_NAMESPACE::LookUp;
using image::HWY_NAMESPACE::LookUpAlpha;
using shadow::kGroupSize;

template <class Values>
HWY_INLINE Vector3 Load3(const Values& x, const Values& y, const Values& z, std::size_t i) {
  const FloatTag d;
  return {hn::Load(d, x.data() + i), hn::Load(d, y.data() + i), hn::Load(d, z.data() + i)};
}

template <class Values>
HWY_INLINE void Store3(const Vector3& v, Values& x, Values& y, Values& z, std::size_t i) {
  const FloatTag d;
  hn::Store(v.x, d, x.data() + i);
  hn::Store(v.y, d, y.data() + i);
  hn::Store(v.z, d, z.data() + i);
}

// ---------------------------------------------------------------------------------------------- what layers show

// A picture's colour and alpha; without a picture, white.
HWY_INLINE void StorePicture(const image::MipChain* chain, const Sampler& sampler, int anisotropy,
                             const Footprint& footprint, LayerColor& color, std::size_t i) {
  const auto one = Splat(1.0F);
  Vector3 found = {one, one, one};
  auto alpha = one;
  if (chain != nullptr) {
    found = LookUp(*chain, sampler, anisotropy, footprint);
    alpha = LookUpAlpha(*chain, sampler, anisotropy, footprint);
  }
  Store3(found, color.r, color.g, color.b, i);
  hn::Store(alpha, FloatTag(), color.alpha.data() + i);
  hn::Store(one, FloatTag(), color.presence.data() + i);
}

HWY_INLINE FloatMask IsInPicture(const Footprint& f) {
  const auto zero = Splat(0.0F), one = Splat(1.0F);
  return hn::And(hn::And(f.u >= zero, f.u <= one), hn::And(f.v >= zero, f.v <= one));
}

void find_texture_color(const PointSource& source, const frame::Surface& surface,
                        const frame::LayerBinding& layer, const shadow::SurfaceSamples& samples,
                        LayerColor& color) {
  color.covered.fill(0);
  VisitSurfaceHits(source, surface, samples, [&](const auto& hits, std::size_t i) HWY_ATTR {
    const Footprint footprint = FindFootprint(*source.frame, layer.texture, hits.corners, hits.hit.weights);
    StorePicture(layer.texture.chain, layer.texture.sampler, source.anisotropy, footprint, color, i);
    const std::uint32_t on = layer.once ? BitsOf(IsInPicture(footprint)) : 0xFFFFU;
    color.covered[i / kGroupSize] |=
        static_cast<std::uint16_t>((on << (i % kGroupSize)) & samples.active[i / kGroupSize]);
  });
}

// Whether surfaces show the projector the side that is seen.
HWY_INLINE FloatMask Faces(const BoundLight& projector, const shadow::SurfaceSamples& samples,
                           std::size_t i) {
  const Vector3 normal = Load3(samples.normal_x_ws, samples.normal_y_ws, samples.normal_z_ws, i);
  const Vector3 from_lens = projector.is_orthographic ? Splat3(projector.forward_ws)
                                                      : Load3(samples.x_ws, samples.y_ws, samples.z_ws, i) -
                                                            Splat3(projector.position_ws);
  return Dot(normal, from_lens) < Splat(0.0F);
}

// Parallel projectors paint nothing behind their lens, or behind where their frustum begins (row 58).
HWY_INLINE FloatMask IsBeforeLens(const BoundLight& projector, const shadow::SurfaceSamples& samples,
                                  std::size_t i) {
  const Vector3 from_lens =
      Load3(samples.x_ws, samples.y_ws, samples.z_ws, i) - Splat3(projector.position_ws);
  const auto lens = static_cast<float>(std::min(projector.light->projection.near, 0.0));
  return Dot(from_lens, Splat3(projector.forward_ws)) > Splat(lens);
}

void find_decal_color(const BoundLight& projector, const shadow::SurfaceSamples& samples, LayerColor& color) {
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    std::uint32_t covered = 0;
    for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
      const std::size_t i = group * kGroupSize + k;
      SlidePoint point = FindSlidePoint(projector, samples, i);
      auto is_on = hn::And(point.is_ahead, Faces(projector, samples, i));
      LensStretch unused;
      if (projector.lens) is_on = hn::And(is_on, PassLens(*projector.lens, point.footprint, unused));
      if (projector.is_orthographic) is_on = hn::And(is_on, IsBeforeLens(projector, samples, i));
      if (projector.light->outside == Outside::black) is_on = hn::And(is_on, IsInPicture(point.footprint));
      if (hn::AllFalse(FloatTag(), is_on)) continue;
      StorePicture(projector.slide, projector.slide_sampler, projector.anisotropy, point.footprint, color, i);
      covered |= BitsOf(is_on) << k;
    }
    color.covered[group] = static_cast<std::uint16_t>(covered & samples.active[group]);
  }
}

// ---------------------------------------------------------------------------------------------- what becomes of it

HWY_INLINE Vector3 Multiply(const Vector3& a, const Vector3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

void blend_layer(const frame::LayerBinding& layer, std::size_t groups, const LayerColor& color,
                 SurfacePoints& points) {
  const FloatTag d;
  const auto one = Splat(1.0F), most = Splat(static_cast<float>(kMaxRadiance));
  const Vector3 factor = Splat3(layer.color.data());
  for (std::size_t group = 0; group < groups; ++group) {
    if (color.covered[group] == 0) continue;
    for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
      const auto is_on = MaskFromBits(std::uint32_t{color.covered[group]} >> k);
      if (hn::AllFalse(d, is_on)) continue;
      const std::size_t i = group * kGroupSize + k;
      const Vector3 below = Load3(points.base_r, points.base_g, points.base_b, i);
      const Vector3 shown = Multiply(Load3(color.r, color.g, color.b, i), factor);
      const auto alpha = hn::Load(d, color.alpha.data() + i);
      auto share = Splat(layer.opacity) * hn::Load(d, color.presence.data() + i);
      if (layer.blend != BlendMode::alpha_attenuate) share = share * alpha;
      const Vector3 mixed = below * (one - share) + BlendColors(layer.blend, below, shown, alpha) * share;
      // Products of many bright layers stay numbers.
      const Vector3 held = {hn::Min(mixed.x, most), hn::Min(mixed.y, most), hn::Min(mixed.z, most)};
      Store3(IfThenElse3(is_on, held, below), points.base_r, points.base_g, points.base_b, i);
    }
  }
}

HWY_INLINE FloatVector Ratio(FloatVector value, FloatVector white) {
  const auto is_dark = white <= Splat(0.0F);
  return hn::IfThenZeroElse(is_dark, value / hn::IfThenElse(is_dark, Splat(1.0F), white));
}
HWY_INLINE Vector3 Ratio(const Vector3& value, const Vector3& white) {
  return {Ratio(value.x, white.x), Ratio(value.y, white.y), Ratio(value.z, white.z)};
}

// The sum with a projector's light. Modes that double where both lights do (all but three) need no white.
HWY_INLINE Vector3 CombineLights(BlendMode mode, const Vector3& open, const Vector3& own,
                                 const Vector3& earlier) {
  const auto one = Splat(1.0F);
  switch (mode) {
    case BlendMode::modulate:
      return Multiply(earlier, Ratio(own, open));
    case BlendMode::screen: {
      const auto channel = [one](FloatVector c, FloatVector e, FloatVector white) HWY_ATTR {
        return (c + e) - hn::Min(c, white) * hn::Min(Ratio(e, white), one);
      };
      return {channel(earlier.x, own.x, open.x), channel(earlier.y, own.y, open.y),
              channel(earlier.z, own.z, open.z)};
    }
    case BlendMode::dot3:
      return Multiply(Dot3(Ratio(earlier, open), Ratio(own, open)), open);
    default:
      return BlendColors(mode, earlier, own, one);
  }
}

void blend_light(BlendMode mode, std::size_t groups, const Radiance& open, const Radiance& own,
                 Radiance& earlier, Radiance& change) {
  for (std::size_t i = 0; i < groups * kGroupSize; i += kLanes) {
    const Vector3 before = Load3(earlier.r, earlier.g, earlier.b, i);
    const Vector3 after =
        CombineLights(mode, Load3(open.r, open.g, open.b, i), Load3(own.r, own.g, own.b, i), before);
    const Vector3 difference = after - before;
    Store3(difference, change.r, change.g, change.b, i);
    // What is added up elsewhere is the change: that sum is the one to go on from.
    Store3(before + difference, earlier.r, earlier.g, earlier.b, i);
  }
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shade {
LATERNA_KERNEL_TABLE(find_texture_color)
LATERNA_KERNEL_TABLE(find_decal_color)
LATERNA_KERNEL_TABLE(blend_layer)
LATERNA_KERNEL_TABLE(blend_light)
}  // namespace laterna::shade
#endif
