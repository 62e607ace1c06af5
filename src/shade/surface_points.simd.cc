// From a triangle, a pixel and a reversed depth to everything shading needs to know of the surface there.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/surface_points.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "frame/surface_alpha-inl.h"
#include "frame/texture_coordinates-inl.h"
#include "frame/triangle_corners-inl.h"
#include "image/texture_lookup-inl.h"
#include "shade/surface_hits-inl.h"
#include "shade/surface_points.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using frame::HWY_NAMESPACE::AlphaInView;
using frame::HWY_NAMESPACE::CornerVectorsAndValues;
using frame::HWY_NAMESPACE::FindFootprint;
using frame::HWY_NAMESPACE::Interpolate;
using frame::HWY_NAMESPACE::kColorField;
using frame::HWY_NAMESPACE::kNormalField;
using frame::HWY_NAMESPACE::kTangentField;
using frame::HWY_NAMESPACE::TriangleCorners;
using image::HWY_NAMESPACE::LookUp;

HWY_INLINE Vector3 Product(const Vector3& a, const Vector3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

// Surface attributes at the samples of one vector.
template <bool kUniform, bool kOnRelief>
class SurfaceReader {
 public:
  HWY_INLINE SurfaceReader(const PointSource& source, const frame::Surface& surface,
                           const SurfaceHits<kUniform, kOnRelief>& hits)
      : source_(source),
        surface_(surface),
        frame_(*source.frame),
        corners_(hits.corners),
        facet_(hits.facet),
        hit_(hits.hit) {}

  HWY_INLINE Vector3 LookUpTexture(const frame::TextureBinding& binding) {
    if (placed_ == nullptr || !binding.lies_like(*placed_)) {
      footprint_ = FindFootprint(frame_, binding, corners_, hit_.weights);
      placed_ = &binding;
    }
    return LookUp(*binding.chain, binding.sampler, source_.anisotropy, footprint_);
  }

  // Base colour with everything that multiplies it.
  HWY_INLINE Vector3 BaseColor() {
    Vector3 color = Splat3(surface_.base_color.data());
    if (surface_.base_color_texture.chain != nullptr)
      color = Product(color, LookUpTexture(surface_.base_color_texture));
    const auto stream = corners_.StreamAt(kColorField);
    if (stream.IsMissing()) return color;
    const auto one = Splat(1.0F);
    const Vector3 c = Interpolate(corners_.At(frame_.colors.data(), stream.first).xyz, hit_.weights);
    // On a relief the point may lie beyond its triangle, where colours go on below nothing.
    const auto held = [&](FloatVector value)
                          HWY_ATTR { return hn::Max(stream.OrElse(value, one), Splat(0.0F)); };
    return Product(color, {held(c.x), held(c.y), held(c.z)});
  }

  // Interpolated normal, or the triangle's where there is none; turned to the viewer on double-sided surfaces.
  HWY_INLINE Vector3 ShadingNormal() {
    const auto stream = corners_.StreamAt(kNormalField);
    Vector3 normal = facet_.unit_normal;
    if (!stream.IsMissing()) {
      const Vector3 smooth =
          Normalised(Interpolate(corners_.At(frame_.normals_ws.data(), stream.first), hit_.weights));
      normal = {stream.OrElse(smooth.x, normal.x), stream.OrElse(smooth.y, normal.y),
                stream.OrElse(smooth.z, normal.z)};
    }
    if (surface_.normal_texture.chain != nullptr) {
      normal = Perturbed(normal);  // of a relief, too: it was made from the same heights
    } else if constexpr (kOnRelief) {
      normal = ReliefNormal(frame_, surface_.relief, corners_, facet_, hit_, normal);
    }
    return surface_.double_sided ? IfThenElse3(hit_.shows_back, normal * Splat(-1.0F), normal) : normal;
  }

 private:
  // The normal map's vector in the frame of tangent, bitangent and normal (glTF 2.0, 3.9.3).
  HWY_INLINE Vector3 Perturbed(const Vector3& normal) {
    const auto stream = corners_.StreamAt(kTangentField);
    if (stream.IsMissing()) return normal;
    const Vector3 t = LookUpTexture(surface_.normal_texture);
    const auto two = Splat(2.0F), one = Splat(1.0F), scale = Splat(surface_.normal_scale);
    const Vector3 local = {(t.x * two - one) * scale, (t.y * two - one) * scale, t.z * two - one};
    const CornerVectorsAndValues at_corners = corners_.At(frame_.tangents_ws.data(), stream.first);
    const Vector3 tangent = Interpolate(at_corners.xyz, hit_.weights);
    const auto sign = at_corners.w.a;
    const Vector3 bitangent = Cross(normal, tangent) * sign;
    const Vector3 mapped = Normalised((tangent * local.x + bitangent * local.y) + normal * local.z);
    const auto is_null = Dot(mapped, mapped) <= Splat(0.0F);
    const Vector3 usable = IfThenElse3(is_null, normal, mapped);
    return {stream.OrElse(usable.x, normal.x), stream.OrElse(usable.y, normal.y),
            stream.OrElse(usable.z, normal.z)};
  }

  const PointSource& source_;
  const frame::Surface& surface_;
  const frame::Frame& frame_;
  const TriangleCorners<kUniform>& corners_;
  const Facet& facet_;
  const Hit& hit_;
  // Of the binding that was read last.
  image::HWY_NAMESPACE::Footprint footprint_;
  const frame::TextureBinding* placed_ = nullptr;
};

HWY_INLINE void Store3(const Vector3& v, float* x, float* y, float* z, std::size_t i) {
  const FloatTag d;
  hn::Store(v.x, d, x + i);
  hn::Store(v.y, d, y + i);
  hn::Store(v.z, d, z + i);
}

// What is read at hits.
template <bool kUniform, bool kOnRelief>
HWY_INLINE void StorePoints(const PointSource& source, const frame::Surface& surface,
                            const SurfaceHits<kUniform, kOnRelief>& hits, shadow::SurfaceSamples& s,
                            SurfacePoints& p, std::size_t i) {
  const FloatTag d;
  const Facet& facet = hits.facet;
  const Hit& hit = hits.hit;
  SurfaceReader reader(source, surface, hits);
  const Vector3 seen_normal =
      IfThenElse3(hit.shows_back, facet.unit_normal * Splat(-1.0F), facet.unit_normal);
  Store3(hit.position_ws, s.x_ws.data(), s.y_ws.data(), s.z_ws.data(), i);
  Store3(seen_normal, s.normal_x_ws.data(), s.normal_y_ws.data(), s.normal_z_ws.data(), i);
  hn::Store(hit.dq_dx, d, s.dq_dx.data() + i);
  hn::Store(hit.dq_dy, d, s.dq_dy.data() + i);
  Store3(hit.to_eye_ws, p.to_eye_x_ws.data(), p.to_eye_y_ws.data(), p.to_eye_z_ws.data(), i);
  Store3(reader.ShadingNormal(), p.normal_x_ws.data(), p.normal_y_ws.data(), p.normal_z_ws.data(), i);

  Store3(reader.BaseColor(), p.base_r.data(), p.base_g.data(), p.base_b.data(), i);
  auto alpha = Splat(1.0F);
  if (surface.alpha_mode == AlphaMode::blend)
    alpha = AlphaInView(*source.frame, surface, hits.corners, hit.weights, source.anisotropy);
  hn::Store(alpha, d, p.alpha.data() + i);

  auto metallic = Splat(surface.metallic), roughness = Splat(surface.roughness), occlusion = Splat(1.0F);
  if (surface.metallic_roughness_texture.chain != nullptr) {
    const Vector3 t = reader.LookUpTexture(surface.metallic_roughness_texture);
    roughness = roughness * t.y;
    metallic = metallic * t.z;
  }
  if (surface.occlusion_texture.chain != nullptr) {
    const Vector3 t = reader.LookUpTexture(surface.occlusion_texture);
    occlusion = Splat(1.0F) + Splat(surface.occlusion_strength) * (t.x - Splat(1.0F));
  }
  hn::Store(metallic, d, p.metallic.data() + i);
  hn::Store(roughness, d, p.roughness.data() + i);
  hn::Store(occlusion, d, p.occlusion.data() + i);

  Vector3 emissive = Splat3(surface.emissive.data());
  if (surface.emissive_texture.chain != nullptr)
    emissive = Product(emissive, reader.LookUpTexture(surface.emissive_texture));
  Store3(emissive, p.emissive_r.data(), p.emissive_g.data(), p.emissive_b.data(), i);
}

void find_surface_points(const PointSource& source, const frame::Surface& surface,
                         shadow::SurfaceSamples& samples, SurfacePoints& points) {
  VisitSurfaceHits(source, surface, samples, [&](const auto& hits, std::size_t i) HWY_ATTR {
    StorePoints(source, surface, hits, samples, points, i);
  });
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shade {
LATERNA_KERNEL_TABLE(find_surface_points)
}  // namespace laterna::shade
#endif
