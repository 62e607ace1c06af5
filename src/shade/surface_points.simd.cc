// From a triangle, a pixel and a reversed depth to everything shading needs to know of the surface there.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/surface_points.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "frame/triangle_corners-inl.h"
#include "image/texture_lookup-inl.h"
#include "shade/surface_points.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using frame::HWY_NAMESPACE::CornerVectors;
using frame::HWY_NAMESPACE::Interpolate;
using frame::HWY_NAMESPACE::Interpolated;
using frame::HWY_NAMESPACE::InterpolateWithSlope;
using frame::HWY_NAMESPACE::kColorField;
using frame::HWY_NAMESPACE::kNormalField;
using frame::HWY_NAMESPACE::kTangentField;
using frame::HWY_NAMESPACE::kUvField;
using frame::HWY_NAMESPACE::TriangleCorners;
using frame::HWY_NAMESPACE::Weights;
using image::HWY_NAMESPACE::Footprint;
using image::HWY_NAMESPACE::LookUp;
using image::HWY_NAMESPACE::Texel4;
using shadow::kGroupSize;

// A view's pixel rays, in floats.
struct PixelRays {
  explicit PixelRays(const raster::RasterView& v) : is_orthographic(v.is_orthographic) {
    for (int i = 0; i < 3; ++i) {
      eye[i] = static_cast<float>(v.eye_ws[i]);
      axis[i] = static_cast<float>(v.axis_ws[i]);
      direction_0[i] = static_cast<float>(v.direction_0[i]);
      direction_x[i] = static_cast<float>(v.direction_x[i]);
      direction_y[i] = static_cast<float>(v.direction_y[i]);
      x_row[i] = static_cast<float>(v.x_row[i]);
      y_row[i] = static_cast<float>(v.y_row[i]);
      w_row[i] = static_cast<float>(v.w_row[i]);
    }
    x_add = static_cast<float>(v.x_add);
    y_add = static_cast<float>(v.y_add);
    near = static_cast<float>(v.view.projection.near);
  }
  HWY_INLINE Vector3 Direction(FloatVector x, FloatVector y) const {
    return Splat3(direction_0) + (Splat3(direction_x) * x + Splat3(direction_y) * y);
  }
  bool is_orthographic;
  float eye[3], axis[3], direction_0[3], direction_x[3], direction_y[3];
  float x_row[3], y_row[3], w_row[3], x_add, y_add, near;
};

// The point of a triangle that a sample sees.
struct Hit {
  Vector3 position_ws, to_eye_ws;  // to_eye: unit
  Vector3 normal_ws;               // unit, on the side that is seen
  FloatMask shows_back;            // which is the triangle's back
  FloatVector dq_dx, dq_dy;
  Weights weights;
};

// Weights that vary linearly on the screen, for triangles wholly in front of the near plane.
HWY_INLINE void MakeAffine(const PixelRays& rays, const CornerVectors& corners, FloatVector x, FloatVector y,
                           Weights& weights) {
  struct Projected {
    FloatVector x, y, w;
  };
  const auto project = [&](const Vector3& p_ws) HWY_ATTR {
    const Vector3 p = p_ws - Splat3(rays.eye);
    const auto w = rays.is_orthographic ? Splat(1.0F) : Dot(Splat3(rays.w_row), p);
    const auto inverse = Splat(1.0F) / hn::IfThenElse(w == Splat(0.0F), Splat(1.0F), w);
    return Projected{Dot(Splat3(rays.x_row), p) * inverse + Splat(rays.x_add),
                     Dot(Splat3(rays.y_row), p) * inverse + Splat(rays.y_add), w};
  };
  const Projected a = project(corners.a), b = project(corners.b), c = project(corners.c);
  const auto ux = b.x - a.x, uy = b.y - a.y, vx = c.x - a.x, vy = c.y - a.y;
  const auto area = ux * vy - vx * uy;
  const auto near = Splat(rays.is_orthographic ? 0.5F : rays.near);
  const auto is_usable =
      hn::And(hn::And(a.w >= near, b.w >= near), hn::And(c.w >= near, hn::Abs(area) > Splat(1e-12F)));
  const auto inverse = Splat(1.0F) / hn::IfThenElse(is_usable, area, Splat(1.0F));
  const auto px = x - a.x, py = y - a.y;
  const auto choose = [&](FloatVector affine, FloatVector& kept)
                          HWY_ATTR { kept = hn::IfThenElse(is_usable, affine, kept); };
  choose((px * vy - vx * py) * inverse, weights.b);
  choose((ux * py - px * uy) * inverse, weights.c);
  choose(vy * inverse, weights.db_dx);
  choose(hn::Neg(vx) * inverse, weights.db_dy);
  choose(hn::Neg(uy) * inverse, weights.dc_dx);
  choose(ux * inverse, weights.dc_dy);
}

HWY_INLINE Hit FindHit(const PixelRays& rays, const CornerVectors& corners, FloatVector x, FloatVector y,
                       FloatVector q, Interpolation interpolation) {
  const auto one = Splat(1.0F);
  const Vector3 direction = rays.Direction(x, y);
  const Vector3 direction_x = Splat3(rays.direction_x), direction_y = Splat3(rays.direction_y);
  const Vector3 u = corners.b - corners.a, v = corners.c - corners.a;
  const Vector3 n = Cross(u, v);
  const auto n_squared = Dot(n, n);
  const auto is_flat = n_squared <= Splat(1e-36F);
  const auto inverse_n_squared = hn::IfThenZeroElse(is_flat, one / hn::IfThenElse(is_flat, one, n_squared));

  Hit hit;
  Vector3 dp_dx, dp_dy;  // how the point moves on the plane from one pixel to the next
  if (rays.is_orthographic) {
    const Vector3 axis = Splat3(rays.axis);
    hit.position_ws = direction + axis * q;
    const auto along = Dot(n, axis);
    const auto is_edge_on = hn::Abs(along) <= Splat(1e-30F);
    const auto inverse = hn::IfThenZeroElse(is_edge_on, one / hn::IfThenElse(is_edge_on, one, along));
    hit.dq_dx = hn::Neg(Dot(n, direction_x) * inverse);
    hit.dq_dy = hn::Neg(Dot(n, direction_y) * inverse);
    dp_dx = direction_x + axis * hit.dq_dx;
    dp_dy = direction_y + axis * hit.dq_dy;
    hit.to_eye_ws = axis;
  } else {
    const auto w = one / q;
    const Vector3 from_eye = direction * w;
    hit.position_ws = Splat3(rays.eye) + from_eye;
    // On the plane q = n·direction / n·(corner − eye), and all its points have the same n·(point − eye).
    const auto distance = Dot(n, corners.a - Splat3(rays.eye));
    const auto is_edge_on = hn::Abs(distance) <= Splat(1e-30F);
    const auto inverse = hn::IfThenZeroElse(is_edge_on, one / hn::IfThenElse(is_edge_on, one, distance));
    hit.dq_dx = Dot(n, direction_x) * inverse;
    hit.dq_dy = Dot(n, direction_y) * inverse;
    dp_dx = (direction_x - from_eye * hit.dq_dx) * w;
    dp_dy = (direction_y - from_eye * hit.dq_dy) * w;
    hit.to_eye_ws = Normalised(direction * Splat(-1.0F));
  }
  const auto is_behind = Dot(n, hit.to_eye_ws) < Splat(0.0F);
  const auto unit = hn::Sqrt(inverse_n_squared);
  hit.shows_back = is_behind;
  hit.normal_ws = n * hn::IfThenElse(is_behind, hn::Neg(unit), unit);

  // point − a = b u + c v; crossing with n isolates b and c.
  const Vector3 to_b = Cross(v, n) * inverse_n_squared, to_c = Cross(n, u) * inverse_n_squared;
  const Vector3 p = hit.position_ws - corners.a;
  // Snapping lets a covered sample lie a little outside: it takes the attributes of the rim.
  hit.weights.b = Saturate(Dot(p, to_b));
  hit.weights.c = hn::Min(hn::Max(Dot(p, to_c), Splat(0.0F)), one - hit.weights.b);
  hit.weights.db_dx = Dot(dp_dx, to_b);
  hit.weights.db_dy = Dot(dp_dy, to_b);
  hit.weights.dc_dx = Dot(dp_dx, to_c);
  hit.weights.dc_dy = Dot(dp_dy, to_c);
  if (interpolation == Interpolation::affine) MakeAffine(rays, corners, x, y, hit.weights);
  return hit;
}

// Surface attributes at the samples of one vector.
template <bool kUniform>
class SurfaceReader {
 public:
  SurfaceReader(const PointSource& source, const frame::Surface& surface, const PixelRays& rays,
                const TriangleId* ids, FloatVector x, FloatVector y, FloatVector q)
      : source_(source),
        surface_(surface),
        frame_(*source.frame),
        corners_(*source.frame, ids),
        hit_(FindHit(rays, corners_.Positions(), x, y, q, source.interpolation)) {}

  [[nodiscard]] const Hit& hit() const { return hit_; }

  template <bool kAlpha>
  HWY_INLINE Texel4 LookUpTexture(const frame::TextureBinding& binding, int anisotropy) const {
    return LookUp<kAlpha>(*binding.chain, binding.sampler, anisotropy, FootprintOf(binding));
  }

  // Full-size look-up, as for a footprint of no size.
  HWY_INLINE Texel4 LookUpFullSize(const frame::TextureBinding& binding) const {
    Footprint f = FootprintOf(binding);
    f.du_dx = f.dv_dx = f.du_dy = f.dv_dy = Splat(0.0F);
    return LookUp<true>(*binding.chain, binding.sampler, 1, f);
  }

  // Base colour with everything that multiplies it.
  template <bool kAlpha>
  HWY_INLINE Texel4 BaseColor(bool full_size = false) const {
    Texel4 color = {Splat(surface_.base_color[0]), Splat(surface_.base_color[1]),
                    Splat(surface_.base_color[2]), Splat(surface_.base_color[3])};
    if (surface_.base_color_texture.chain != nullptr) {
      const Texel4 t = full_size ? LookUpFullSize(surface_.base_color_texture)
                                 : LookUpTexture<kAlpha>(surface_.base_color_texture, source_.anisotropy);
      color = {color.r * t.r, color.g * t.g, color.b * t.b, color.a * t.a};
    }
    const auto stream = corners_.StreamAt(kColorField);
    if (!stream.IsMissing()) {
      const auto one = Splat(1.0F);
      const auto read = [&](const AlignedVector<float>& values) HWY_ATTR {
        return stream.OrElse(Interpolate(corners_.At(values.data(), stream.first), hit_.weights), one);
      };
      color = {color.r * read(frame_.color_r), color.g * read(frame_.color_g), color.b * read(frame_.color_b),
               color.a * read(frame_.color_a)};
    }
    return color;
  }

  // Interpolated normal, or the triangle's where there is none; turned to the viewer on double-sided surfaces.
  HWY_INLINE Vector3 ShadingNormal() const {
    const auto stream = corners_.StreamAt(kNormalField);
    Vector3 normal = IfThenElse3(hit_.shows_back, hit_.normal_ws * Splat(-1.0F), hit_.normal_ws);
    if (!stream.IsMissing()) {
      const Vector3 sum = Interpolate(corners_.At3(frame_.normal_x_ws.data(), frame_.normal_y_ws.data(),
                                                   frame_.normal_z_ws.data(), stream.first),
                                      hit_.weights);
      const Vector3 smooth = Normalised(sum);
      normal = {stream.OrElse(smooth.x, normal.x), stream.OrElse(smooth.y, normal.y),
                stream.OrElse(smooth.z, normal.z)};
    }
    if (surface_.normal_texture.chain != nullptr) normal = Perturbed(normal);
    return surface_.double_sided ? IfThenElse3(hit_.shows_back, normal * Splat(-1.0F), normal) : normal;
  }

 private:
  HWY_INLINE Footprint FootprintOf(const frame::TextureBinding& binding) const {
    const auto set = static_cast<std::size_t>(binding.uv_set);
    const auto stream = corners_.StreamAt(kUvField + set);
    const auto zero = Splat(0.0F);
    if (stream.IsMissing()) return {zero, zero, zero, zero, zero, zero};
    Interpolated u = InterpolateWithSlope(corners_.At(frame_.uv_u[set].data(), stream.first), hit_.weights);
    Interpolated v = InterpolateWithSlope(corners_.At(frame_.uv_v[set].data(), stream.first), hit_.weights);
    const auto present = [&](Interpolated& i) HWY_ATTR {
      i = {stream.OrElse(i.value, zero), stream.OrElse(i.d_dx, zero), stream.OrElse(i.d_dy, zero)};
    };
    present(u);
    present(v);
    // KHR_texture_transform.
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

  // The normal map's vector in the frame of tangent, bitangent and normal (glTF 2.0, 3.9.3).
  HWY_INLINE Vector3 Perturbed(const Vector3& normal) const {
    const auto stream = corners_.StreamAt(kTangentField);
    if (stream.IsMissing()) return normal;
    const Texel4 t = LookUpTexture<false>(surface_.normal_texture, source_.anisotropy);
    const auto two = Splat(2.0F), one = Splat(1.0F), scale = Splat(surface_.normal_scale);
    const Vector3 local = {(t.r * two - one) * scale, (t.g * two - one) * scale, t.b * two - one};
    const Vector3 tangent = Interpolate(corners_.At3(frame_.tangent_x_ws.data(), frame_.tangent_y_ws.data(),
                                                     frame_.tangent_z_ws.data(), stream.first),
                                        hit_.weights);
    const auto sign = corners_.At(frame_.tangent_sign.data(), stream.first).a;
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
  TriangleCorners<kUniform> corners_;
  Hit hit_;
};

HWY_INLINE void Store3(const Vector3& v, float* x, float* y, float* z, std::size_t i) {
  const FloatTag d;
  hn::Store(v.x, d, x + i);
  hn::Store(v.y, d, y + i);
  hn::Store(v.z, d, z + i);
}

template <bool kUniform>
HWY_INLINE void FindPoints(const PointSource& source, const frame::Surface& surface, const PixelRays& rays,
                           shadow::SurfaceSamples& s, SurfacePoints& p, std::size_t i) {
  const FloatTag d;
  const SurfaceReader<kUniform> reader(source, surface, rays, s.id.data() + i, hn::Load(d, s.x.data() + i),
                                       hn::Load(d, s.y.data() + i), hn::Load(d, s.q.data() + i));
  const Hit& hit = reader.hit();
  Store3(hit.position_ws, s.x_ws.data(), s.y_ws.data(), s.z_ws.data(), i);
  Store3(hit.normal_ws, s.normal_x_ws.data(), s.normal_y_ws.data(), s.normal_z_ws.data(), i);
  hn::Store(hit.dq_dx, d, s.dq_dx.data() + i);
  hn::Store(hit.dq_dy, d, s.dq_dy.data() + i);
  Store3(hit.to_eye_ws, p.to_eye_x_ws.data(), p.to_eye_y_ws.data(), p.to_eye_z_ws.data(), i);
  Store3(reader.ShadingNormal(), p.normal_x_ws.data(), p.normal_y_ws.data(), p.normal_z_ws.data(), i);

  const Texel4 base = surface.alpha_mode == AlphaMode::opaque ? reader.template BaseColor<false>()
                                                              : reader.template BaseColor<true>();
  Store3({base.r, base.g, base.b}, p.base_r.data(), p.base_g.data(), p.base_b.data(), i);
  hn::Store(surface.alpha_mode == AlphaMode::blend ? base.a : Splat(1.0F), d, p.alpha.data() + i);

  auto metallic = Splat(surface.metallic), roughness = Splat(surface.roughness), occlusion = Splat(1.0F);
  if (surface.metallic_roughness_texture.chain != nullptr) {
    const Texel4 t =
        reader.template LookUpTexture<false>(surface.metallic_roughness_texture, source.anisotropy);
    roughness = roughness * t.g;
    metallic = metallic * t.b;
  }
  if (surface.occlusion_texture.chain != nullptr) {
    const Texel4 t = reader.template LookUpTexture<false>(surface.occlusion_texture, source.anisotropy);
    occlusion = Splat(1.0F) + Splat(surface.occlusion_strength) * (t.r - Splat(1.0F));
  }
  hn::Store(metallic, d, p.metallic.data() + i);
  hn::Store(roughness, d, p.roughness.data() + i);
  hn::Store(occlusion, d, p.occlusion.data() + i);

  Vector3 emissive = Splat3(surface.emissive.data());
  if (surface.emissive_texture.chain != nullptr) {
    const Texel4 t = reader.template LookUpTexture<false>(surface.emissive_texture, source.anisotropy);
    emissive = {emissive.x * t.r, emissive.y * t.g, emissive.z * t.b};
  }
  Store3(emissive, p.emissive_r.data(), p.emissive_g.data(), p.emissive_b.data(), i);
}

HWY_INLINE bool IsOneTriangle(const TriangleId* ids) {
  const UintTag du;
  const auto first = hn::Set(du, ids[0]);
  for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
    if (!hn::AllTrue(du, hn::LoadU(du, ids + k) == first)) return false;
  }
  return true;
}

void find_surface_points(const PointSource& source, const frame::Surface& surface,
                         shadow::SurfaceSamples& samples, SurfacePoints& points) {
  const PixelRays rays(*source.view);
  for (std::size_t first = 0; first < samples.group_count * kGroupSize; first += kGroupSize) {
    if (IsOneTriangle(samples.id.data() + first)) {
      for (std::size_t k = 0; k < kGroupSize; k += kLanes)
        FindPoints<true>(source, surface, rays, samples, points, first + k);
    } else {
      for (std::size_t k = 0; k < kGroupSize; k += kLanes)
        FindPoints<false>(source, surface, rays, samples, points, first + k);
    }
  }
}

alignas(64) constexpr float kBlockX[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr float kBlockY[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

std::uint32_t keep_above_cutoff(const PointSource& source, const frame::Surface& surface, float cutoff,
                                const CutBlock& block) {
  const FloatTag d;
  const PixelRays rays(*source.view);
  std::uint32_t kept = 0;
  for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
    const SurfaceReader<true> reader(source, surface, rays, &block.id,
                                     Splat(block.x) + hn::Load(d, kBlockX + k),
                                     Splat(block.y) + hn::Load(d, kBlockY + k), hn::LoadU(d, block.q + k));
    const Texel4 color = reader.template BaseColor<true>(block.full_size);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, color.a >= Splat(cutoff), bits);
    kept |= (bits[0] | std::uint32_t{bits[1]} << 8U) << k;
  }
  return kept;
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shade {
LATERNA_KERNEL_TABLE(find_surface_points)
LATERNA_KERNEL_TABLE(keep_above_cutoff)
}  // namespace laterna::shade
#endif
