// What panes let through.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shadow/panes.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "base/vectors-inl.h"
#include "frame/surface_alpha-inl.h"
#include "frame/surface_lobes.h"
#include "frame/texture_coordinates-inl.h"
#include "frame/triangle_corners-inl.h"
#include "image/texture_lookup-inl.h"
#include "shadow/panes.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using frame::HWY_NAMESPACE::TriangleCorners;
using frame::HWY_NAMESPACE::Weights;

HWY_INLINE Vector3 Product(const Vector3& a, const Vector3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

// Base colour at full texture size, of N points on triangles of `surface`.
HWY_INLINE Vector3 BaseColorOf(const frame::Frame& frame, const frame::Surface& surface,
                               const TriangleCorners<false>& corners, const Weights& weights) {
  Vector3 color = Splat3(surface.base_color.data());
  const frame::TextureBinding& binding = surface.base_color_texture;
  if (binding.chain != nullptr) {
    const auto footprint = frame::HWY_NAMESPACE::FindFootprint(frame, binding, corners, weights);
    color = Product(color, image::HWY_NAMESPACE::LookUp(*binding.chain, binding.sampler, 1, footprint));
  }
  const auto stream = corners.StreamAt(frame::HWY_NAMESPACE::kColorField);
  if (stream.IsMissing()) return color;
  const auto one = Splat(1.0F);
  const Vector3 c =
      frame::HWY_NAMESPACE::Interpolate(corners.At(frame.colors.data(), stream.first).xyz, weights);
  return Product(color, {stream.OrElse(c.x, one), stream.OrElse(c.y, one), stream.OrElse(c.z, one)});
}

// 1 − alpha (1 − color); nothing from alpha 1 on.
HWY_INLINE Vector3 Transmitted(const Vector3& color, FloatVector alpha) {
  const auto zero = Splat(0.0F), one = Splat(1.0F);
  const auto a = hn::Min(hn::Max(alpha, zero), one);
  const auto is_open = a < one;
  const auto channel = [&](FloatVector c) HWY_ATTR {
    const auto held = hn::Min(hn::Max(c, zero), one);
    return hn::IfThenElseZero(is_open, one - a * (one - held));
  };
  return {channel(color.x), channel(color.y), channel(color.z)};
}

// A picture's linear numbers at full texture size; 1 where there is none.
HWY_INLINE Vector3 NumbersOf(const frame::Frame& frame, const frame::TextureBinding& binding,
                             const TriangleCorners<false>& corners, const Weights& weights) {
  const auto one = Splat(1.0F);
  if (binding.chain == nullptr) return {one, one, one};
  const auto footprint = frame::HWY_NAMESPACE::FindFootprint(frame, binding, corners, weights);
  return image::HWY_NAMESPACE::LookUp(*binding.chain, binding.sampler, 1, footprint);
}

// What goes through where it covers: transmission × base colour × Beer and Lambert's law over the thickness, of what is no
// metal. A volume is entered and left again, and each crossing takes the root of it. What glass mirrors away (about 4 %)
// and where it bends light to play no part.
HWY_INLINE Vector3 TransmittedWithin(const frame::Frame& frame, const frame::Surface& surface,
                                     const TriangleCorners<false>& corners, const Weights& weights,
                                     const Vector3& color, FloatVector scale) {
  const auto zero = Splat(0.0F), one = Splat(1.0F);
  const frame::SurfaceLobes& lobes = *surface.lobes;
  const auto metallic =
      Splat(surface.metallic) * NumbersOf(frame, surface.metallic_roughness_texture, corners, weights).z;
  const auto share = (one - metallic) * (Splat(lobes.values.transmission.factor) *
                                         NumbersOf(frame, lobes.transmission, corners, weights).x);
  const VolumeLobe& volume = lobes.values.volume;
  const auto thickness =
      Splat(volume.thickness) * scale * NumbersOf(frame, lobes.thickness, corners, weights).y;
  const auto lengths = thickness * Splat(1 / volume.attenuation_distance);
  const auto channel = [&](FloatVector c, float attenuation) HWY_ATTR {
    const auto held = hn::Min(hn::Max(c, zero), one);
    const auto kept = hn::IfThenElse(lengths > zero, Power(Splat(attenuation), lengths), one);
    const auto through = share * held * kept;
    return hn::IfThenElse(thickness > zero, hn::Sqrt(through), through);
  };
  return {channel(color.x, volume.attenuation_color.x), channel(color.y, volume.attenuation_color.y),
          channel(color.z, volume.attenuation_color.z)};
}

// What a transmissive surface lets through, of what its alpha leaves open all.
HWY_INLINE Vector3 ThroughCoverage(const frame::Surface& surface, const Vector3& within, FloatVector alpha) {
  const auto zero = Splat(0.0F), one = Splat(1.0F);
  auto coverage = one;
  if (surface.alpha_mode == AlphaMode::blend) coverage = hn::Min(hn::Max(alpha, zero), one);
  if (surface.alpha_mode == AlphaMode::mask)
    coverage = hn::IfThenElse(alpha < Splat(surface.alpha_cutoff), zero, one);
  const auto channel = [&](FloatVector c) HWY_ATTR { return one - coverage * (one - c); };
  return {channel(within.x), channel(within.y), channel(within.z)};
}

// N crossings of any surfaces; those of one surface are looked up together.
HWY_INLINE Vector3 TransmitOne(const frame::Frame& frame, const TriangleId* ids, const Weights& weights) {
  const FloatTag d;
  alignas(64) float material[kLanes], scale[kLanes];
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Cluster& cluster = frame.clusters[cluster_of(ids[k])];
    material[k] = static_cast<float>(cluster.material);
    scale[k] = frame.object_scales[cluster.object];
  }
  const auto materials = hn::Load(d, material);
  const TriangleCorners<false> corners(frame, ids);
  Vector3 result = Splat3(std::array<float, 3>{1, 1, 1}.data());
  auto left = Splat(0.0F) <= Splat(0.0F);
  for (auto lane = hn::FindFirstTrue(d, left); lane >= 0; lane = hn::FindFirstTrue(d, left)) {
    const float index = material[lane];
    const frame::Surface& surface = frame.surfaces[static_cast<std::size_t>(index)];
    const auto here = hn::And(left, materials == Splat(index));
    const auto alpha = frame::HWY_NAMESPACE::AlphaAtFullSize(frame, surface, corners, weights);
    const Vector3 color = BaseColorOf(frame, surface, corners, weights);
    if (surface.lobes != nullptr && surface.lobes->has_transmission) {
      const Vector3 within = TransmittedWithin(frame, surface, corners, weights, color, hn::Load(d, scale));
      result = IfThenElse3(here, ThroughCoverage(surface, within, alpha), result);
    } else {
      result = IfThenElse3(here, Transmitted(color, alpha), result);
    }
    left = hn::AndNot(here, left);
  }
  return result;
}

void transmit_through(const frame::Frame& frame, std::span<const PaneCrossing> crossings, PaneColor* colors) {
  const FloatTag d;
  const auto zero = Splat(0.0F);
  for (std::size_t first = 0; first < crossings.size(); first += kLanes) {
    const std::size_t count = std::min(kLanes, crossings.size() - first);
    alignas(64) TriangleId ids[kLanes];
    alignas(64) float b[kLanes], c[kLanes], r[kLanes], g[kLanes], blue[kLanes];
    for (std::size_t k = 0; k < kLanes; ++k) {
      const PaneCrossing& crossing = crossings[first + std::min(k, count - 1)];
      ids[k] = crossing.id;
      b[k] = crossing.b;
      c[k] = crossing.c;
    }
    const Weights weights = {hn::Load(d, b), hn::Load(d, c), zero, zero, zero, zero};
    const Vector3 color = TransmitOne(frame, ids, weights);
    hn::Store(color.x, d, r);
    hn::Store(color.y, d, g);
    hn::Store(color.z, d, blue);
    for (std::size_t k = 0; k < count; ++k) colors[first + k] = {r[k], g[k], blue[k]};
  }
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shadow {
LATERNA_KERNEL_TABLE(transmit_through)
}  // namespace laterna::shadow
#endif
