// Holes of cut-outs: the alpha of base colour at its full size, at N points at a time.
#if defined(LATERNA_FRAME_SURFACE_ALPHA_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_FRAME_SURFACE_ALPHA_INL_H_
#undef LATERNA_FRAME_SURFACE_ALPHA_INL_H_
#else
#define LATERNA_FRAME_SURFACE_ALPHA_INL_H_
#endif

#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "frame/surface_alpha.h"
#include "frame/triangle_corners-inl.h"
#include "image/texture_lookup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::frame::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// Coordinates over the picture of a binding: mesh coordinates after KHR_texture_transform; (0, 0) before it where the
// mesh has none.
struct TexturePoint {
  FloatVector u, v;
};
template <bool kUniform>
HWY_INLINE TexturePoint FindTexturePoint(const Frame& frame, const TextureBinding& binding,
                                         const TriangleCorners<kUniform>& corners, const Weights& weights) {
  const auto set = static_cast<std::size_t>(binding.uv_set);
  const auto stream = corners.StreamAt(kUvField + set);
  const auto zero = Splat(0.0F);
  if (stream.IsMissing()) return {zero, zero};
  const auto read = [&](const AlignedVector<float>& values) HWY_ATTR {
    return stream.OrElse(Interpolate(corners.At(values.data(), stream.first), weights), zero);
  };
  const auto u = read(frame.uv_u[set]), v = read(frame.uv_v[set]);
  const std::array<float, 6>& m = binding.uv_from_mesh_uv;
  return {(Splat(m[0]) * u + Splat(m[1]) * v) + Splat(m[2]),
          (Splat(m[3]) * u + Splat(m[4]) * v) + Splat(m[5])};
}

// alpha_at() of N points, all on triangles of `surface`.
template <bool kUniform>
HWY_INLINE FloatVector AlphaAt(const Frame& frame, const Surface& surface,
                               const TriangleCorners<kUniform>& corners, const Weights& weights) {
  auto alpha = Splat(surface.base_color[3]);
  const TextureBinding& binding = surface.base_color_texture;
  if (binding.chain != nullptr) {
    const TexturePoint p = FindTexturePoint(frame, binding, corners, weights);
    alpha = alpha * image::HWY_NAMESPACE::LookUpFullSizeAlpha(*binding.chain, binding.sampler, p.u, p.v);
  }
  const auto stream = corners.StreamAt(kColorField);
  if (stream.IsMissing()) return alpha;
  const auto vertex_alpha = Interpolate(corners.At(frame.color_a.data(), stream.first), weights);
  return alpha * stream.OrElse(vertex_alpha, Splat(1.0F));
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
  const auto has_holes =
      hn::And(read(offsetof(Cluster, flags)),
              SplatInt(static_cast<std::int32_t>(kAlphaMask | kAlphaBlend))) != hn::Zero(di);
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
    const auto is_hole = AlphaAt(frame, surface, corners, weights) < Splat(cutoff_of(surface));
    holes = hn::Or(holes, hn::And(here, is_hole));
    left = hn::AndNot(here, left);
  }
  return holes;
}

}  // namespace laterna::frame::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
