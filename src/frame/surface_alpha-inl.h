// The alpha of surfaces at N points at a time, and the holes of cut-outs.
#if defined(LATERNA_FRAME_SURFACE_ALPHA_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_FRAME_SURFACE_ALPHA_INL_H_
#undef LATERNA_FRAME_SURFACE_ALPHA_INL_H_
#else
#define LATERNA_FRAME_SURFACE_ALPHA_INL_H_
#endif

#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "frame/surface_alpha.h"
#include "frame/texture_coordinates-inl.h"
#include "frame/triangle_corners-inl.h"
#include "image/texture_lookup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::frame::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// Base colour's alpha at N points, all on triangles of `surface`; `look_up` reads a picture's at a footprint.
template <bool kUniform, class LookUp>
HWY_INLINE FloatVector AlphaOf(const Frame& frame, const Surface& surface,
                               const TriangleCorners<kUniform>& corners, const Weights& weights,
                               const LookUp& look_up) {
  auto alpha = Splat(surface.base_color[3]);
  const TextureBinding& binding = surface.base_color_texture;
  if (binding.chain != nullptr) alpha = alpha * look_up(FindFootprint(frame, binding, corners, weights));
  const auto stream = corners.StreamAt(kColorField);
  if (stream.IsMissing()) return alpha;
  const auto vertex_alpha = Interpolate(corners.At(frame.colors.data(), stream.first).w, weights);
  return alpha * stream.OrElse(vertex_alpha, Splat(1.0F));
}

// alpha_at() of N points: slopes of the weights are not used.
template <bool kUniform>
HWY_INLINE FloatVector AlphaAtFullSize(const Frame& frame, const Surface& surface,
                                       const TriangleCorners<kUniform>& corners, const Weights& weights) {
  const TextureBinding& binding = surface.base_color_texture;
  return AlphaOf(frame, surface, corners, weights, [&](const image::HWY_NAMESPACE::Footprint& f) HWY_ATTR {
    return image::HWY_NAMESPACE::LookUpFullSizeAlpha(*binding.chain, binding.sampler, f.u, f.v);
  });
}

// The same as a view sees it, filtered for its pixels.
template <bool kUniform>
HWY_INLINE FloatVector AlphaInView(const Frame& frame, const Surface& surface,
                                   const TriangleCorners<kUniform>& corners, const Weights& weights,
                                   int anisotropy) {
  const TextureBinding& binding = surface.base_color_texture;
  return AlphaOf(frame, surface, corners, weights, [&](const image::HWY_NAMESPACE::Footprint& f) HWY_ATTR {
    return image::HWY_NAMESPACE::LookUpAlpha(*binding.chain, binding.sampler, anisotropy, f);
  });
}

// Which of the `asked` points lie in holes of their triangles. Surfaces are looked up one after the other: neighbours
// seldom lie on more than one that has holes.
HWY_INLINE FloatMask FindHoles(const Frame& frame, const TriangleCorners<false>& corners,
                               const Weights& weights, FloatMask asked) {
  const FloatTag d;
  const IntTag di;
  const auto* words = reinterpret_cast<const std::int32_t*>(frame.clusters.data());
  const auto read = [&](std::size_t offset) HWY_ATTR {
    return hn::GatherIndex(di, words + offset / sizeof(std::int32_t),
                           corners.Clusters() * SplatInt(sizeof(Cluster) / sizeof(std::int32_t)));
  };
  const auto has_holes = hn::And(read(offsetof(Cluster, flags)),
                                 SplatInt(static_cast<std::int32_t>(kAlphaMask))) != hn::Zero(di);
  auto left = hn::And(asked, hn::RebindMask(d, has_holes));
  auto holes = Splat(0.0F) > Splat(1.0F);
  if (hn::AllFalse(d, left)) return holes;
  const auto material = read(offsetof(Cluster, material));
  alignas(64) std::int32_t materials[kLanes];
  hn::Store(material, di, materials);
  for (auto lane = hn::FindFirstTrue(d, left); lane >= 0; lane = hn::FindFirstTrue(d, left)) {
    const std::int32_t index = materials[lane];
    const Surface& surface = frame.surfaces[static_cast<std::size_t>(index)];
    const auto here = hn::And(left, hn::RebindMask(d, material == SplatInt(index)));
    const auto is_hole = AlphaAtFullSize(frame, surface, corners, weights) < Splat(surface.alpha_cutoff);
    holes = hn::Or(holes, hn::And(here, is_hole));
    left = hn::AndNot(here, left);
  }
  return holes;
}

}  // namespace laterna::frame::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
