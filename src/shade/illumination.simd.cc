// Light at surface points.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/illumination.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "base/vectors-inl.h"
#include "image/disc_lookup-inl.h"
#include "image/texture_lookup-inl.h"
#include "shade/illumination.h"
#include "shade/lamp_lookup-inl.h"
#include "shade/slide_lens-inl.h"
#include "shade/slide_point-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using image::HWY_NAMESPACE::Footprint;
using image::HWY_NAMESPACE::LookUp;
using shadow::kGroupSize;

template <class Samples>
HWY_INLINE Vector3 Load3(const Samples& x, const Samples& y, const Samples& z, std::size_t i) {
  const FloatTag d;
  return {hn::Load(d, x.data() + i), hn::Load(d, y.data() + i), hn::Load(d, z.data() + i)};
}

// ---------------------------------------------------------------------------------------------- arriving light

HWY_INLINE Vector3 Multiply(const Vector3& a, const Vector3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

// What a light sends to N points: colour, direction, and where it shines at all.
struct Arriving {
  Vector3 color, to_light;
  FloatMask shines;
};

// Relative to the distance along the axis `along` and the true distance `distance` (row 19).
HWY_INLINE FloatVector AttenuationAt(const BoundLight& light, FloatVector along, FloatVector distance) {
  const FloatTag d;
  const auto one = Splat(1.0F);
  const auto inverse_square = [&](FloatVector length)
                                  HWY_ATTR { return one / hn::Max(length * length, Splat(1e-12F)); };
  switch (light.light->attenuation) {
    case Attenuation::none:
      return one;
    case Attenuation::inverse_square:
      return light.is_papers ? one : inverse_square(distance);
    case Attenuation::gltf_windowed: {
      if (light.is_papers) return one;
      const auto ratio = distance * Splat(light.inverse_range);
      const auto squared = ratio * ratio;
      return Saturate(one - squared * squared) * inverse_square(distance);
    }
    case Attenuation::linear:
      return Saturate(one - along * Splat(light.inverse_range));
    case Attenuation::custom:
      break;
  }
  alignas(64) float values[kLanes];
  hn::Store(along, d, values);
  for (float& value : values) value = light.light->custom_attenuation(value);
  return hn::Load(d, values);
}

HWY_INLINE Arriving FromAfar(const BoundLight& light) {
  const float to_light[3] = {-light.forward_ws[0], -light.forward_ws[1], -light.forward_ws[2]};
  return {Splat3(light.color), Splat3(to_light),
          Splat(0.0F) == Splat(0.0F)};  // NOLINT(misc-redundant-expression)
}

HWY_INLINE Arriving FromPoint(const BoundLight& light, const Vector3& p) {
  const Vector3 from_light = p - Splat3(light.position_ws);
  const auto distance = hn::Sqrt(Dot(from_light, from_light));
  const auto is_there = distance <= Splat(1e-6F);
  const auto inverse =
      hn::IfThenZeroElse(is_there, Splat(1.0F) / hn::IfThenElse(is_there, Splat(1.0F), distance));
  const Vector3 direction = from_light * inverse;
  auto intensity = AttenuationAt(
      light, light.light->type == LightType::point ? distance : Dot(from_light, Splat3(light.forward_ws)),
      distance);
  if (light.light->type == LightType::spot) {
    const auto cosine = Dot(direction, Splat3(light.forward_ws));
    const auto angular = Saturate(cosine * Splat(light.cone_scale) + Splat(light.cone_offset));
    intensity = intensity * (angular * angular);
  }
  if (light.lamp != nullptr) {
    const Vector3 direction_ls = {Dot(direction, Splat3(light.right_ws)), Dot(direction, Splat3(light.up_ws)),
                                  Dot(direction, Splat3(light.forward_ws))};
    intensity = intensity * LampShare(*light.lamp, direction_ls);
  }
  return {Splat3(light.color) * intensity, direction * Splat(-1.0F), intensity > Splat(0.0F)};
}

// What a slide out of focus throws on points, and where it throws anything.
struct BlurredSlide {
  Vector3 colour;
  FloatMask shines;
};

image::HWY_NAMESPACE::Beyond BeyondOf(Outside outside) {
  using image::HWY_NAMESPACE::Beyond;
  switch (outside) {
    case Outside::clamp:
      return Beyond::clamp;
    case Outside::repeat:
      return Beyond::repeat;
    case Outside::mirror:
      return Beyond::mirror;
    case Outside::black:
      break;
  }
  return Beyond::black;
}

// Radii of the disc, in units of the slide's sides.
struct Defocus {
  FloatVector radius_u, radius_v;
};

// The mean of the slide (null: white) as every point of the lens throws it on points: a disc of the slide (row 13).
// Discs less than some texels, or pixels, wide are mixed from the slide in focus and a disc that is as wide, so that the
// variance of the blur is right.
HWY_NOINLINE BlurredSlide FindBlurredSlide(const BoundLight& light, const image::MipChain* slide,
                                           const Footprint& f, const Defocus& defocus, FloatMask in_frame) {
  constexpr float kNarrowest = 1.5F;  // texels or pixels in radius
  const FloatTag d;
  const auto zero = Splat(0.0F), one = Splat(1.0F), half = Splat(0.5F);
  const bool is_black = light.light->outside == Outside::black;
  const auto width = Splat(slide != nullptr ? static_cast<float>(slide->width()) : 1.0F);
  const auto height = Splat(slide != nullptr ? static_cast<float>(slide->height()) : 1.0F);
  const auto radius_u = defocus.radius_u, radius_v = defocus.radius_v;
  const auto radius = hn::Max(hn::Max(radius_u * width, radius_v * height), Splat(1e-20F));

  // The pixel's side, in texels, where as many probes as may be share out the longer one.
  const auto ux = f.du_dx * width, vx = f.dv_dx * height, uy = f.du_dy * width, vy = f.dv_dy * height;
  const auto x_squared = ux * ux + vx * vx, y_squared = uy * uy + vy * vy;
  const auto most = static_cast<float>(light.anisotropy);
  const auto pixel_squared =
      hn::Max(hn::Min(x_squared, y_squared), hn::Max(x_squared, y_squared) * Splat(1.0F / (most * most)));
  const auto texel = Splat(slide != nullptr ? 1.0F : 0.0F);
  const auto unit = hn::Max(texel, hn::Sqrt(hn::Min(pixel_squared, Splat(1e20F))));
  const auto narrowest = Splat(kNarrowest) * unit;
  const auto widening = hn::Max(narrowest / radius, one);
  const auto share = one / (widening * widening);
  const image::HWY_NAMESPACE::Disc disc = {f.u, f.v, radius_u * widening, radius_v * widening};

  BlurredSlide blurred;
  // Weights end at less than 3/2 radii.
  const auto reach_u = half + Splat(1.5F) * disc.radius_u, reach_v = half + Splat(1.5F) * disc.radius_v;
  blurred.shines = hn::And(hn::Abs(f.u - half) <= reach_u, hn::Abs(f.v - half) <= reach_v);
  if (!is_black) blurred.shines = zero <= zero;
  if (hn::AllFalse(d, blurred.shines)) return {{zero, zero, zero}, blurred.shines};
  blurred.colour = image::HWY_NAMESPACE::LookUpDisc(slide, BeyondOf(light.light->outside), disc);
  if (hn::AllTrue(d, share == one)) return blurred;
  Vector3 sharp = {one, one, one};
  if (slide != nullptr) sharp = LookUp(*slide, light.slide_sampler, light.anisotropy, f);
  if (is_black) sharp = image::HWY_NAMESPACE::Where(in_frame, sharp);
  blurred.colour = blurred.colour * share + sharp * (one - share);
  return blurred;
}

HWY_INLINE Arriving FromProjector(const BoundLight& light, const shadow::SurfaceSamples& samples,
                                  const SlideCoordinates* coordinates, Irradiance& irradiance,
                                  std::size_t i) {
  const FloatTag d;
  const auto zero = Splat(0.0F), one = Splat(1.0F);
  SlidePoint point = FindSlidePoint(light, samples, i);
  Footprint& f = point.footprint;
  if (coordinates != nullptr) {
    const auto valid = MaskFromBits(std::uint32_t{coordinates->valid[i / kGroupSize]} >> i % kGroupSize);
    f.u = hn::IfThenElse(valid, hn::Load(d, coordinates->s.data() + i), f.u);
    f.v = hn::IfThenElse(valid, hn::Load(d, coordinates->t.data() + i), f.v);
  }
  auto shines = point.is_ahead;
  LensStretch stretch = {one, one};
  if (light.lens) shines = hn::And(shines, PassLens(*light.lens, f, stretch));
  const auto in_frame = hn::And(hn::And(f.u >= zero, f.u <= one), hn::And(f.v >= zero, f.v <= one));
  const Vector3 from_light = Load3(samples.x_ws, samples.y_ws, samples.z_ws, i) - Splat3(light.position_ws);
  const auto along = Dot(from_light, Splat3(light.forward_ws));
  // Parallel light comes from the lens too, or from where its frustum begins behind it (row 58).
  if (light.is_orthographic) {
    const double lens = std::min(light.light->projection.near, 0.0);
    shines = hn::And(shines, along > Splat(static_cast<float>(lens)));
  }
  const auto is_thrown = light.light->outside == Outside::black ? hn::And(shines, in_frame) : shines;
  const auto nan = Splat(std::numeric_limits<float>::quiet_NaN());
  hn::Store(hn::IfThenElse(is_thrown, f.u, nan), d, irradiance.slide_s.data() + i);
  hn::Store(hn::IfThenElse(is_thrown, f.v, nan), d, irradiance.slide_t.data() + i);
  const bool is_blurred = light.blur_s > 0;
  Defocus defocus;
  BlurredSlide blurred;
  if (HWY_UNLIKELY(is_blurred)) {
    const auto off_focus = hn::Abs(Splat(light.inverse_focus) - one / hn::Max(along, Splat(1e-6F)));
    defocus = {Splat(light.blur_s) * off_focus * stretch.u, Splat(light.blur_t) * off_focus * stretch.v};
    blurred = FindBlurredSlide(light, light.slide, f, defocus, in_frame);
    shines = hn::And(shines, blurred.shines);
  } else {
    shines = is_thrown;
  }
  if (hn::AllFalse(d, shines)) return {Splat3(light.color), Splat3(light.forward_ws), shines};

  Arriving arriving;
  FloatVector intensity;
  if (light.is_orthographic) {
    const float to_light[3] = {-light.forward_ws[0], -light.forward_ws[1], -light.forward_ws[2]};
    arriving.to_light = Splat3(to_light);
    // Parallel light does not thin out.
    const bool fades =
        light.light->attenuation == Attenuation::linear || light.light->attenuation == Attenuation::custom;
    intensity = fades ? AttenuationAt(light, along, along) : one;
  } else {
    const auto distance = hn::Sqrt(Dot(from_light, from_light));
    const auto safe = hn::Max(distance, Splat(1e-6F));
    arriving.to_light = from_light * (Splat(-1.0F) / safe);
    if (!light.is_flat_field || light.is_papers) {
      intensity = AttenuationAt(light, along, safe);
    } else {
      // Flat field: a wall square to the beam at distance z gets I f(z) everywhere, so a surface square to the ray
      // gets I f(z) / cos θ.
      const auto safe_along = hn::Max(along, Splat(1e-6F));
      intensity = AttenuationAt(light, along, safe_along) * (safe / safe_along);
    }
  }
  arriving.color = Splat3(light.color) * intensity;
  if (is_blurred) {
    Vector3 t = blurred.colour;
    if (light.black_level > 0 && light.slide != nullptr) {
      const Vector3 open = FindBlurredSlide(light, nullptr, f, defocus, in_frame).colour;
      t = t * Splat(1.0F - light.black_level) + open * Splat(light.black_level);
    }
    arriving.color = Multiply(arriving.color, t);
  } else if (light.slide != nullptr) {
    Vector3 t = LookUp(*light.slide, light.slide_sampler, light.anisotropy, f);
    // Panels leak: what they throw runs from the black level to white.
    if (light.black_level > 0) {
      const auto black = Splat(light.black_level), rest = Splat(1.0F - light.black_level);
      t = {t.x * rest + black, t.y * rest + black, t.z * rest + black};
    }
    arriving.color = Multiply(arriving.color, t);
  }
  arriving.shines = shines;
  return arriving;
}

void find_irradiance(const BoundLight& light, const shadow::SurfaceSamples& samples,
                     const SurfacePoints& points, const SlideCoordinates* coordinates,
                     Irradiance& irradiance) {
  const FloatTag d;
  const auto zero = Splat(0.0F);
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    irradiance.lit[group] = 0;
    for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
      const std::size_t i = group * kGroupSize + k;
      Arriving arriving;
      switch (light.light->type) {
        case LightType::directional:
          arriving = FromAfar(light);
          break;
        case LightType::projector:
          arriving = FromProjector(light, samples, coordinates, irradiance, i);
          break;
        default:
          arriving = FromPoint(light, Load3(samples.x_ws, samples.y_ws, samples.z_ws, i));
          break;
      }
      const Vector3 normal = Load3(points.normal_x_ws, points.normal_y_ws, points.normal_z_ws, i);
      const auto cosine = light.is_papers ? Splat(1.0F) : Dot(normal, arriving.to_light);
      const auto is_lit = hn::And(arriving.shines, cosine > zero);
      hn::Store(hn::IfThenElseZero(arriving.shines, arriving.color.x), d, irradiance.r.data() + i);
      hn::Store(hn::IfThenElseZero(arriving.shines, arriving.color.y), d, irradiance.g.data() + i);
      hn::Store(hn::IfThenElseZero(arriving.shines, arriving.color.z), d, irradiance.b.data() + i);
      hn::Store(arriving.to_light.x, d, irradiance.to_light_x_ws.data() + i);
      hn::Store(arriving.to_light.y, d, irradiance.to_light_y_ws.data() + i);
      hn::Store(arriving.to_light.z, d, irradiance.to_light_z_ws.data() + i);
      hn::Store(cosine, d, irradiance.cosine.data() + i);
      irradiance.lit[group] = static_cast<std::uint16_t>(irradiance.lit[group] | BitsOf(is_lit) << k);
    }
    irradiance.lit[group] = static_cast<std::uint16_t>(irradiance.lit[group] & samples.active[group]);
  }
}

// ---------------------------------------------------------------------------------------------- reflected light

HWY_INLINE void Store3(const Vector3& v, Radiance& radiance, std::size_t i) {
  const FloatTag d;
  hn::Store(v.x, d, radiance.r.data() + i);
  hn::Store(v.y, d, radiance.g.data() + i);
  hn::Store(v.z, d, radiance.b.data() + i);
}

void find_ambient(const ReflectionSettings& settings, const frame::Surface& surface, std::size_t groups,
                  const SurfacePoints& points, Radiance& radiance) {
  const FloatTag d;
  for (std::size_t i = 0; i < groups * kGroupSize; i += kLanes) {
    const Vector3 base = Load3(points.base_r, points.base_g, points.base_b, i);
    if (surface.unlit) {
      Store3(base, radiance, i);
      continue;
    }
    const Vector3 ambient = Splat3(settings.ambient) * hn::Load(d, points.occlusion.data() + i);
    const Vector3 emissive = Load3(points.emissive_r, points.emissive_g, points.emissive_b, i);
    Store3(Multiply(base, ambient) + emissive, radiance, i);
  }
}

// Everything a reflection model asks about N samples of one light.
struct Incidence {
  Vector3 base, irradiance, normal, to_light, to_eye;
  FloatVector cosine, metallic, roughness;
};

HWY_INLINE Vector3 ReflectPapers(const Incidence& in) { return Multiply(in.base, in.irradiance); }

// x^exponent; powers of two by squaring, which is exact to a few roundings.
HWY_INLINE FloatVector Highlight(FloatVector x, float exponent) {
  const auto whole = static_cast<unsigned>(exponent);
  if (exponent >= 1 && exponent <= 1024 && static_cast<float>(whole) == exponent &&
      (whole & (whole - 1)) == 0) {
    auto power = x;
    for (unsigned n = whole; n > 1; n /= 2) power = power * power;
    return power;
  }
  return Power(x, Splat(exponent));
}

template <bool kHighlights>
HWY_INLINE Vector3 ReflectPhong(const Incidence& in, const std::optional<PhongHighlight>& highlight) {
  if constexpr (!kHighlights) {
    const auto share = highlight ? Splat(1.0F) : Splat(1.0F) - in.metallic;
    return Multiply(in.irradiance, in.base * (share * in.cosine));
  }
  const Vector3 half = Normalised(in.to_eye + in.to_light);
  const auto n_h = hn::Max(Dot(in.normal, half), Splat(0.0F));
  if (highlight) {
    const auto specular = Splat(highlight->specular) * Highlight(n_h, highlight->shininess);
    return Multiply(in.irradiance, in.base * in.cosine + Vector3{specular, specular, specular});
  }
  // From metallic-roughness: the exponent that gives Blinn's lobe the width of GGX with the same roughness
  // (p = 2/α² − 2, α = roughness²), and glTF's reflectance at normal incidence.
  const auto one = Splat(1.0F);
  const auto squared = in.roughness * in.roughness;
  const auto alpha_squared = hn::Max(squared * squared, Splat(1e-4F));
  const auto exponent = hn::Max(Splat(2.0F) / alpha_squared - Splat(2.0F), one);
  const auto lobe = Power(n_h, exponent);
  const auto dielectric = Splat(0.04F);
  const Vector3 reflectance = {dielectric + (in.base.x - dielectric) * in.metallic,
                               dielectric + (in.base.y - dielectric) * in.metallic,
                               dielectric + (in.base.z - dielectric) * in.metallic};
  const Vector3 diffuse = in.base * ((one - in.metallic) * in.cosine);
  return Multiply(in.irradiance, diffuse + reflectance * lobe);
}

// glTF 2.0, appendix B.3: GGX, the separable form of Smith's masking and shadowing, Schlick's Fresnel term, Lambert
// beneath.
template <bool kHighlights>
HWY_INLINE Vector3 ReflectPbr(const Incidence& in) {
  const auto one = Splat(1.0F);
  const auto inverse_pi = Splat(0.318309886F);
  const Vector3 half = Normalised(in.to_eye + in.to_light);
  const auto n_l = Saturate(in.cosine);
  const auto n_v = Saturate(Dot(in.normal, in.to_eye));
  const auto n_h = Saturate(Dot(in.normal, half));
  const auto v_h = Saturate(Dot(in.to_eye, half));
  // A perfect mirror would show a point light as a point; the least roughness keeps the lobe finite.
  const auto alpha = hn::Max(in.roughness * in.roughness, Splat(1e-3F));
  const auto a2 = alpha * alpha;
  const auto t = n_h * n_h * (a2 - one) + one;
  const auto distribution = a2 * inverse_pi / hn::Max(t * t, Splat(1e-12F));
  // G / (4 n·l n·v): Smith's factors without their numerators.
  const auto smith = [&](FloatVector cosine)
                         HWY_ATTR { return cosine + hn::Sqrt(a2 + (one - a2) * (cosine * cosine)); };
  const auto visibility = one / (smith(n_l) * smith(n_v));
  const auto m = one - v_h;
  const auto m2 = m * m;
  const auto fresnel = m2 * m2 * m;
  const auto specular = distribution * visibility;
  const auto channel = [&](FloatVector base) HWY_ATTR {
    const auto f0 = Splat(0.04F) + (base - Splat(0.04F)) * in.metallic;
    const auto f = f0 + (one - f0) * fresnel;
    const auto diffuse = (one - f) * (base * (one - in.metallic)) * inverse_pi;
    if constexpr (!kHighlights) return diffuse * n_l;
    return (diffuse + f * specular) * n_l;
  };
  return Multiply(in.irradiance, {channel(in.base.x), channel(in.base.y), channel(in.base.z)});
}

template <bool kHighlights>
HWY_INLINE Vector3 ReflectBy(const ReflectionSettings& settings, const Incidence& in) {
  switch (settings.model) {
    case ShadingModel::papers:
      return ReflectPapers(in);
    case ShadingModel::phong:
      return ReflectPhong<kHighlights>(in, settings.phong);
    case ShadingModel::pbr:
      break;
  }
  return ReflectPbr<kHighlights>(in);
}

// Fraction of the light that arrives, by channel.
HWY_INLINE Vector3 ArrivingAt(const shadow::Arrival& arrival, std::size_t i) {
  if (arrival.is_tinted) return Load3(arrival.r, arrival.g, arrival.b, i);
  const auto alpha = hn::Load(FloatTag(), arrival.alpha.data() + i);
  return {alpha, alpha, alpha};
}

void reflect(const ReflectionSettings& settings, std::size_t groups, const SurfacePoints& points,
             const Irradiance& irradiance, const shadow::Arrival& arrival, float fill, bool add,
             Radiance& radiance) {
  const FloatTag d;
  const auto zero = Splat(0.0F), one = Splat(1.0F);
  const Vector3 nothing = {zero, zero, zero};
  for (std::size_t group = 0; group < groups; ++group) {
    for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
      const std::size_t i = group * kGroupSize + k;
      const auto is_lit = MaskFromBits(std::uint32_t{irradiance.lit[group]} >> k);
      if (hn::AllFalse(d, is_lit)) {
        if (!add) Store3(nothing, radiance, i);
        continue;
      }
      Incidence in;
      in.base = Load3(points.base_r, points.base_g, points.base_b, i);
      const Vector3 unhindered = Load3(irradiance.r, irradiance.g, irradiance.b, i);
      const Vector3 arriving = ArrivingAt(arrival, i);
      in.irradiance = Multiply(unhindered, arriving);
      in.normal = Load3(points.normal_x_ws, points.normal_y_ws, points.normal_z_ws, i);
      in.to_light = Load3(irradiance.to_light_x_ws, irradiance.to_light_y_ws, irradiance.to_light_z_ws, i);
      in.to_eye = Load3(points.to_eye_x_ws, points.to_eye_y_ws, points.to_eye_z_ws, i);
      in.cosine = hn::Load(d, irradiance.cosine.data() + i);
      in.metallic = hn::Load(d, points.metallic.data() + i);
      in.roughness = hn::Load(d, points.roughness.data() + i);
      Vector3 out = ReflectBy<true>(settings, in);
      if (fill > 0) {
        const Vector3 missing = {one - arriving.x, one - arriving.y, one - arriving.z};
        in.irradiance = Multiply(unhindered, missing * Splat(fill));
        out = out + ReflectBy<false>(settings, in);
      }
      out = IfThenElse3(is_lit, out, nothing);
      Store3(add ? Load3(radiance.r, radiance.g, radiance.b, i) + out : out, radiance, i);
    }
  }
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shade {
LATERNA_KERNEL_TABLE(find_irradiance)
LATERNA_KERNEL_TABLE(find_ambient)
LATERNA_KERNEL_TABLE(reflect)
}  // namespace laterna::shade
#endif
