// Factors and textures of a surface's lobes at its samples.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/lobe_points.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cmath>

#include "base/elementary.h"
#include "base/vectors-inl.h"
#include "frame/texture_coordinates-inl.h"
#include "frame/triangle_corners-inl.h"
#include "image/texture_lookup-inl.h"
#include "shade/lobe_points.h"
#include "shade/surface_hits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using frame::HWY_NAMESPACE::FindFootprint;
using frame::HWY_NAMESPACE::Interpolate;
using frame::HWY_NAMESPACE::kNormalField;
using frame::HWY_NAMESPACE::kTangentField;
using frame::HWY_NAMESPACE::TriangleCorners;

template <class Samples>
HWY_INLINE Vector3 Load3(const Samples& x, const Samples& y, const Samples& z, std::size_t i) {
  const FloatTag d;
  return {hn::Load(d, x.data() + i), hn::Load(d, y.data() + i), hn::Load(d, z.data() + i)};
}
template <class Samples>
HWY_INLINE void Store3(const Vector3& v, Samples& x, Samples& y, Samples& z, std::size_t i) {
  const FloatTag d;
  hn::Store(v.x, d, x.data() + i);
  hn::Store(v.y, d, y.data() + i);
  hn::Store(v.z, d, z.data() + i);
}

// What all samples of a surface share.
struct LobeFactors {
  explicit LobeFactors(const frame::SurfaceLobes& lobes) {
    const float ior = lobes.values.ior;
    const float ratio = (ior - 1) / (ior + 1);
    f0 = ior == 0 ? 1 : ratio * ratio;
    const auto angle = static_cast<double>(lobes.values.anisotropy.rotation);
    rotation_cosine = static_cast<float>(cosine(angle));
    rotation_sine = static_cast<float>(sine(angle));
  }
  float f0, rotation_cosine, rotation_sine;
};

// A frame across the normal; mesh tangents where there are any, else one that depends on the normal alone (Duff et al.
// 2017, Building an orthonormal basis, revisited).
struct TangentFrame {
  Vector3 tangent, bitangent;
};

HWY_INLINE Vector3 AnyPerpendicular(const Vector3& n) {
  const auto one = Splat(1.0F);
  const auto sign = hn::IfThenElse(n.z < Splat(0.0F), Splat(-1.0F), one);
  const auto a = Splat(-1.0F) / (sign + n.z);
  return {one + sign * (n.x * n.x) * a, sign * (n.x * n.y * a), hn::Neg(sign * n.x)};
}

template <bool kUniform, bool kOnRelief>
class LobeReader {
 public:
  HWY_INLINE LobeReader(const PointSource& source, const SurfaceHits<kUniform, kOnRelief>& hits)
      : source_(source), frame_(*source.frame), corners_(hits.corners), facet_(hits.facet), hit_(hits.hit) {}

  HWY_INLINE Vector3 Color(const frame::TextureBinding& binding) const {
    return image::HWY_NAMESPACE::LookUp(*binding.chain, binding.sampler, source_.anisotropy,
                                        FindFootprint(frame_, binding, corners_, hit_.weights));
  }
  HWY_INLINE FloatVector Alpha(const frame::TextureBinding& binding) const {
    return image::HWY_NAMESPACE::LookUpAlpha(*binding.chain, binding.sampler, source_.anisotropy,
                                             FindFootprint(frame_, binding, corners_, hit_.weights));
  }

  // Interpolated, or the triangle's where there is none; not turned to the viewer.
  HWY_INLINE Vector3 GeometricNormal() const {
    const auto stream = corners_.StreamAt(kNormalField);
    const Vector3 flat = facet_.unit_normal;
    if (stream.IsMissing()) return flat;
    const Vector3 smooth =
        Normalised(Interpolate(corners_.At(frame_.normals_ws.data(), stream.first), hit_.weights));
    return {stream.OrElse(smooth.x, flat.x), stream.OrElse(smooth.y, flat.y),
            stream.OrElse(smooth.z, flat.z)};
  }

  // Tangent and bitangent as normal maps use them (glTF 2.0, 3.7.2.1), the tangent brought square to `normal`.
  HWY_INLINE TangentFrame FrameAcross(const Vector3& normal) const {
    const auto one = Splat(1.0F);
    const Vector3 any = AnyPerpendicular(normal);
    const auto stream = corners_.StreamAt(kTangentField);
    if (stream.IsMissing()) return {any, Cross(normal, any)};
    const auto at_corners = corners_.At(frame_.tangents_ws.data(), stream.first);
    const Vector3 t = Interpolate(at_corners.xyz, hit_.weights);
    const Vector3 across = Normalised(t - normal * Dot(normal, t));
    const auto is_null = Dot(across, across) <= Splat(0.5F);
    const Vector3 usable = IfThenElse3(is_null, any, across);
    const Vector3 tangent = {stream.OrElse(usable.x, any.x), stream.OrElse(usable.y, any.y),
                             stream.OrElse(usable.z, any.z)};
    const auto sign = stream.OrElse(at_corners.w.a, one);
    return {tangent, Cross(normal, tangent) * sign};
  }

  // The coat's normal, on the side that is seen (KHR_materials_clearcoat): the geometry's, whatever normal map the layers
  // beneath have. A relief is geometry, unless the coat has a normal map of its own, which says it all.
  HWY_INLINE Vector3 CoatNormal(const frame::Surface& surface) const {
    const frame::SurfaceLobes& lobes = *surface.lobes;
    Vector3 normal = GeometricNormal();
    if constexpr (kOnRelief) {
      if (lobes.clearcoat_normal.chain == nullptr)
        normal = ReliefNormal(frame_, surface.relief, corners_, facet_, hit_, normal);
    }
    if (lobes.clearcoat_normal.chain != nullptr && !corners_.StreamAt(kTangentField).IsMissing()) {
      const Vector3 t = Color(lobes.clearcoat_normal);
      const auto two = Splat(2.0F), one = Splat(1.0F), scale = Splat(lobes.values.clearcoat.normal_scale);
      const TangentFrame frame = FrameAcross(normal);
      const Vector3 mapped = Normalised(
          (frame.tangent * ((t.x * two - one) * scale) + frame.bitangent * ((t.y * two - one) * scale)) +
          normal * (t.z * two - one));
      normal = IfThenElse3(Dot(mapped, mapped) <= Splat(0.0F), normal, mapped);
    }
    return surface.double_sided ? IfThenElse3(hit_.shows_back, normal * Splat(-1.0F), normal) : normal;
  }

 private:
  const PointSource& source_;
  const frame::Frame& frame_;
  const TriangleCorners<kUniform>& corners_;
  const Facet& facet_;
  const Hit& hit_;
};

template <class Reader>
HWY_INLINE void FindSpecular(const frame::SurfaceLobes& lobes, const LobeFactors& factors,
                             const Reader& reader, LobePoints& p, std::size_t i) {
  const auto one = Splat(1.0F), f0 = Splat(factors.f0);
  const SpecularLobe& values = lobes.values.specular;
  Vector3 color = {Splat(values.color.x), Splat(values.color.y), Splat(values.color.z)};
  if (lobes.specular_color.chain != nullptr) {
    const Vector3 t = reader.Color(lobes.specular_color);
    color = {color.x * t.x, color.y * t.y, color.z * t.z};
  }
  Store3({hn::Min(f0 * color.x, one), hn::Min(f0 * color.y, one), hn::Min(f0 * color.z, one)}, p.f0_r, p.f0_g,
         p.f0_b, i);
  auto weight = Splat(values.factor);
  if (lobes.specular.chain != nullptr) weight = weight * reader.Alpha(lobes.specular);
  hn::Store(weight, FloatTag(), p.specular.data() + i);
}

template <class Reader>
HWY_INLINE void FindClearcoat(const frame::Surface& surface, const Reader& reader, LobePoints& p,
                              std::size_t i) {
  const FloatTag d;
  const frame::SurfaceLobes& lobes = *surface.lobes;
  auto factor = Splat(lobes.values.clearcoat.factor), roughness = Splat(lobes.values.clearcoat.roughness);
  if (lobes.clearcoat.chain != nullptr) factor = factor * reader.Color(lobes.clearcoat).x;
  if (lobes.clearcoat_roughness.chain != nullptr)
    roughness = roughness * reader.Color(lobes.clearcoat_roughness).y;
  hn::Store(factor, d, p.clearcoat.data() + i);
  hn::Store(roughness, d, p.clearcoat_roughness.data() + i);
  Store3(reader.CoatNormal(surface), p.coat_normal_x_ws, p.coat_normal_y_ws, p.coat_normal_z_ws, i);
}

template <class Reader>
HWY_INLINE void FindSheen(const frame::SurfaceLobes& lobes, const Reader& reader, LobePoints& p,
                          std::size_t i) {
  const SheenLobe& values = lobes.values.sheen;
  Vector3 color = {Splat(values.color.x), Splat(values.color.y), Splat(values.color.z)};
  auto roughness = Splat(values.roughness);
  if (lobes.sheen_color.chain != nullptr) {
    const Vector3 t = reader.Color(lobes.sheen_color);
    color = {color.x * t.x, color.y * t.y, color.z * t.z};
  }
  if (lobes.sheen_roughness.chain != nullptr) roughness = roughness * reader.Alpha(lobes.sheen_roughness);
  Store3(color, p.sheen_r, p.sheen_g, p.sheen_b, i);
  hn::Store(roughness, FloatTag(), p.sheen_roughness.data() + i);
}

// KHR_materials_anisotropy: the texture's direction, turned by the rotation.
template <class Reader>
HWY_INLINE void FindAnisotropy(const frame::SurfaceLobes& lobes, const LobeFactors& factors,
                               const Reader& reader, const Vector3& normal, LobePoints& p, std::size_t i) {
  const auto one = Splat(1.0F), two = Splat(2.0F);
  auto x = one, y = Splat(0.0F), strength = Splat(lobes.values.anisotropy.strength);
  if (lobes.anisotropy.chain != nullptr) {
    const Vector3 t = reader.Color(lobes.anisotropy);
    x = t.x * two - one;
    y = t.y * two - one;
    strength = strength * t.z;
  }
  const auto c = Splat(factors.rotation_cosine), s = Splat(factors.rotation_sine);
  const TangentFrame frame = reader.FrameAcross(normal);
  const Vector3 along = Normalised(frame.tangent * (c * x - s * y) + frame.bitangent * (s * x + c * y));
  const auto is_null = Dot(along, along) <= Splat(0.5F);
  Store3(IfThenElse3(is_null, frame.tangent, along), p.along_x_ws, p.along_y_ws, p.along_z_ws, i);
  hn::Store(strength, FloatTag(), p.anisotropy.data() + i);
}

template <class Reader>
HWY_INLINE void FindFilm(const frame::SurfaceLobes& lobes, const Reader& reader, LobePoints& p,
                         std::size_t i) {
  const FloatTag d;
  const IridescenceLobe& values = lobes.values.iridescence;
  auto factor = Splat(values.factor), thickness = Splat(values.thickness_maximum);
  if (lobes.iridescence.chain != nullptr) factor = factor * reader.Color(lobes.iridescence).x;
  if (lobes.iridescence_thickness.chain != nullptr) {
    const auto minimum = Splat(values.thickness_minimum);
    thickness = minimum + (thickness - minimum) * reader.Color(lobes.iridescence_thickness).y;
  }
  hn::Store(factor, d, p.iridescence.data() + i);
  hn::Store(thickness, d, p.film_thickness.data() + i);
}

template <class Reader>
HWY_INLINE void FindTransmission(const PointSource& source, const frame::SurfaceLobes& lobes,
                                 const Reader& reader, const TriangleId* ids, LobePoints& p, std::size_t i) {
  const FloatTag d;
  auto factor = Splat(lobes.values.transmission.factor), thickness = Splat(lobes.values.volume.thickness);
  if (lobes.transmission.chain != nullptr) factor = factor * reader.Color(lobes.transmission).x;
  if (lobes.thickness.chain != nullptr) thickness = thickness * reader.Color(lobes.thickness).y;
  alignas(64) float scales[kLanes];
  for (std::size_t k = 0; k < kLanes; ++k)
    scales[k] = source.frame->object_scales[source.frame->clusters[cluster_of(ids[k])].object];
  hn::Store(factor, d, p.transmission.data() + i);
  hn::Store(thickness * hn::Load(d, scales), d, p.thickness.data() + i);
}

template <bool kUniform, bool kOnRelief>
HWY_INLINE void FindLobes(const PointSource& source, const frame::Surface& surface,
                          const LobeFactors& factors, const SurfaceHits<kUniform, kOnRelief>& hits,
                          const TriangleId* ids, const SurfacePoints& points, LobePoints& p, std::size_t i) {
  const frame::SurfaceLobes& lobes = *surface.lobes;
  const LobeReader reader(source, hits);
  FindSpecular(lobes, factors, reader, p, i);
  if (lobes.has_clearcoat) FindClearcoat(surface, reader, p, i);
  if (lobes.has_sheen) FindSheen(lobes, reader, p, i);
  if (lobes.has_anisotropy) {
    const Vector3 normal = Load3(points.normal_x_ws, points.normal_y_ws, points.normal_z_ws, i);
    FindAnisotropy(lobes, factors, reader, normal, p, i);
  }
  if (lobes.has_iridescence) FindFilm(lobes, reader, p, i);
  if (lobes.has_transmission) FindTransmission(source, lobes, reader, ids, p, i);
}

void find_lobe_points(const PointSource& source, const frame::Surface& surface,
                      const shadow::SurfaceSamples& samples, const SurfacePoints& points, LobePoints& lobes) {
  const LobeFactors factors(*surface.lobes);
  VisitSurfaceHits(source, surface, samples, [&](const auto& hits, std::size_t i) HWY_ATTR {
    FindLobes(source, surface, factors, hits, samples.id.data() + i, points, lobes, i);
  });
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shade {
LATERNA_KERNEL_TABLE(find_lobe_points)
}  // namespace laterna::shade
#endif
