// Where points of triangles lie in the pictures of their surface.
#if defined(LATERNA_FRAME_TEXTURE_COORDINATES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_FRAME_TEXTURE_COORDINATES_INL_H_
#undef LATERNA_FRAME_TEXTURE_COORDINATES_INL_H_
#else
#define LATERNA_FRAME_TEXTURE_COORDINATES_INL_H_
#endif

#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "frame/triangle_corners-inl.h"
#include "image/texture_lookup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::frame::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// Mesh coordinates after KHR_texture_transform; (0, 0) where the mesh has none.
template <bool kUniform>
HWY_INLINE image::HWY_NAMESPACE::Footprint FindFootprint(const Frame& frame, const TextureBinding& binding,
                                                         const TriangleCorners<kUniform>& corners,
                                                         const Weights& weights) {
  const auto set = static_cast<std::size_t>(binding.uv_set);
  const auto stream = corners.StreamAt(kUvField + set);
  const auto zero = Splat(0.0F);
  if (stream.IsMissing()) return {zero, zero, zero, zero, zero, zero};
  const auto interpolate = [&](const CornerValues& values) HWY_ATTR {
    const Interpolated i = InterpolateWithSlope(values, weights);
    return Interpolated{stream.OrElse(i.value, zero), stream.OrElse(i.d_dx, zero),
                        stream.OrElse(i.d_dy, zero)};
  };
  const CornerPairs uv = corners.At(frame.uvs[set].data(), stream.first);
  const Interpolated u = interpolate(uv.x), v = interpolate(uv.y);
  const std::array<float, 6>& m = binding.uv_from_mesh_uv;
  const auto row = [&](std::size_t r, FloatVector a, FloatVector b)
                       HWY_ATTR { return Splat(m[r]) * a + Splat(m[r + 1]) * b; };
  return {row(0, u.value, v.value) + Splat(m[2]),
          row(3, u.value, v.value) + Splat(m[5]),
          row(0, u.d_dx, v.d_dx),
          row(3, u.d_dx, v.d_dx),
          row(0, u.d_dy, v.d_dy),
          row(3, u.d_dy, v.d_dy)};
}

}  // namespace laterna::frame::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
