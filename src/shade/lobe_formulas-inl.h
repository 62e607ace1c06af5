// The formulas of glTF's material extensions, N samples at a time. docs/materials.md says how they are put together.
#if defined(LATERNA_SHADE_LOBE_FORMULAS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADE_LOBE_FORMULAS_INL_H_
#undef LATERNA_SHADE_LOBE_FORMULAS_INL_H_
#else
#define LATERNA_SHADE_LOBE_FORMULAS_INL_H_
#endif

#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "shade/lobe_points.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

constexpr float kInversePi = 0.318309886F;

HWY_INLINE FloatVector Largest(const Vector3& v) { return hn::Max(v.x, hn::Max(v.y, v.z)); }
HWY_INLINE Vector3 Grey(FloatVector v) { return {v, v, v}; }
HWY_INLINE Vector3 Times(const Vector3& a, const Vector3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
HWY_INLINE Vector3 Mixed(const Vector3& a, const Vector3& b, FloatVector share) {
  return a + (b - a) * share;
}

// Schlick 1994.
HWY_INLINE FloatVector FifthPower(FloatVector v) {
  const auto squared = v * v;
  return squared * squared * v;
}
HWY_INLINE Vector3 Schlick(const Vector3& f0, FloatVector cosine) {
  return Mixed(f0, Grey(Splat(1.0F)), FifthPower(Splat(1.0F) - cosine));
}

// ---------------------------------------------------------------------------------------------- facets

// GGX over 4 n·l n·v, with the separable form of Smith's masking and shadowing, as the plain material has it.
HWY_INLINE FloatVector Facets(FloatVector n_l, FloatVector n_v, FloatVector n_h, FloatVector roughness) {
  const auto one = Splat(1.0F);
  const auto alpha = hn::Max(roughness * roughness, Splat(1e-3F));
  const auto a2 = alpha * alpha;
  const auto t = n_h * n_h * (a2 - one) + one;
  const auto distribution = a2 * Splat(kInversePi) / hn::Max(t * t, Splat(1e-12F));
  const auto smith = [&](FloatVector cosine)
                         HWY_ATTR { return cosine + hn::Sqrt(a2 + (one - a2) * (cosine * cosine)); };
  return distribution / (smith(n_l) * smith(n_v));
}

// A direction in the frame of a surface whose highlights are long along x.
struct BrushedCosines {
  FloatVector along, across, normal;
};

// Heitz 2014, Understanding the masking-shadowing function, equations 85 and 99, with the widths of Burley 2012 as
// KHR_materials_anisotropy sets them: α_t = mix(α, 1, strength²), α_b = α.
HWY_INLINE FloatVector BrushedFacets(const BrushedCosines& l, const BrushedCosines& v,
                                     const BrushedCosines& h, FloatVector roughness, FloatVector strength) {
  const auto one = Splat(1.0F);
  const auto alpha = hn::Max(roughness * roughness, Splat(1e-3F));
  const auto long_alpha = alpha + (one - alpha) * (strength * strength);
  const auto x = h.along / long_alpha, y = h.across / alpha;
  const auto t = x * x + y * y + h.normal * h.normal;
  const auto distribution = Splat(kInversePi) / hn::Max(long_alpha * alpha * (t * t), Splat(1e-12F));
  const auto smith = [&](const BrushedCosines& w) HWY_ATTR {
    const auto a = long_alpha * w.along, b = alpha * w.across;
    return w.normal + hn::Sqrt(a * a + b * b + w.normal * w.normal);
  };
  return distribution / (smith(l) * smith(v));
}

// ---------------------------------------------------------------------------------------------- clear coat

// What of the light a coat of index 1.5 mirrors: its Fresnel term at the angle of sight, as KHR_materials_clearcoat has it.
HWY_INLINE FloatVector CoatShare(FloatVector clearcoat, const Vector3& coat_normal, const Vector3& to_eye) {
  const auto n_v = hn::Min(hn::Abs(Dot(coat_normal, to_eye)), Splat(1.0F));
  return clearcoat * (Splat(0.04F) + Splat(0.96F) * FifthPower(Splat(1.0F) - n_v));
}

// ---------------------------------------------------------------------------------------------- sheen

constexpr float kLeastSheenAlpha = 1e-3F;

HWY_INLINE FloatVector SheenExponent(FloatVector x, FloatVector smoothness) {
  const auto mix = [&](float smooth, float rough)
                       HWY_ATTR { return Splat(rough) + Splat(smooth - rough) * smoothness; };
  const auto curve = Splat(1.0F) + mix(3.32435F, 3.82987F) * Power(x, mix(0.16801F, 0.19823F));
  return mix(25.3245F, 21.5473F) / curve + mix(-1.27393F, -1.97760F) * x + mix(-4.85967F, -4.32054F);
}

HWY_INLINE FloatVector SheenMasking(FloatVector cosine, FloatVector smoothness) {
  const auto half = Splat(0.5F);
  const auto is_grazing = cosine < half;
  const auto fit = SheenExponent(hn::IfThenElse(is_grazing, cosine, Splat(1.0F) - cosine), smoothness);
  const auto exponent = hn::IfThenElse(is_grazing, fit, Splat(2.0F) * SheenExponent(half, smoothness) - fit);
  return Exponential2(exponent * Splat(1.44269504F));
}

// D V of Estevez & Kulla 2017, Production friendly microfacet sheen BRDF, equations 2 and 3 (KHR_materials_sheen).
HWY_INLINE FloatVector SheenFibres(FloatVector n_l, FloatVector n_v, FloatVector n_h, FloatVector roughness) {
  const auto one = Splat(1.0F);
  const auto alpha = hn::Max(roughness * roughness, Splat(kLeastSheenAlpha));
  const auto inverse = one / alpha;
  const auto sine_squared = hn::Max(one - n_h * n_h, Splat(0.0F));
  const auto distribution =
      (Splat(2.0F) + inverse) * Power(sine_squared, Splat(0.5F) * inverse) * Splat(0.5F * kInversePi);
  const auto smoothness = (one - alpha) * (one - alpha);
  const auto masked = one + SheenMasking(n_v, smoothness) + SheenMasking(n_l, smoothness);
  return distribution / (masked * (Splat(4.0F) * hn::Max(n_l * n_v, Splat(1e-6F))));
}

// ---------------------------------------------------------------------------------------------- iridescence

// Fourier transform of the eye's sensitivity at an optical path difference in nanometres, as X, Y, Z and then linear sRGB
// (Belcour & Barla 2017, A practical extension to microfacet theory for the modeling of varying iridescence, equation 10,
// with the Gaussians of KHR_materials_iridescence). `sign`: of the cosine, by the phase that interfaces add, 0 or π.
HWY_INLINE Vector3 Sensitivity(FloatVector path, const Vector3& sign) {
  constexpr double kPhase =
      2 * 3.14159265358979323846 * 1e-9;  // radians of a wave number of 1/m, per nanometre
  constexpr double kNorm = 1.0685e-7;
  // value · √(2π variance) / norm.
  const auto gaussian = [&](double weight, double position, double variance) HWY_ATTR {
    const auto wave = Cosine(path * Splat(static_cast<float>(kPhase * position)));
    const auto fade = Exponential2(
        path * path * Splat(static_cast<float>(-kPhase * kPhase * variance * 1.4426950408889634)));
    return wave * fade * Splat(static_cast<float>(weight / kNorm));
  };
  // √(2π variance) of 4.3278e9, 9.3046e9, 6.6121e9 and 4.5282e9.
  const auto x = (gaussian(5.4856e-13 * 164901.08966, 1.6810e6, 4.3278e9) +
                  gaussian(9.7470e-14 * 168675.78281, 2.2399e6, 4.5282e9)) *
                 sign.x;
  const auto y = gaussian(4.4201e-13 * 241790.25210, 1.7953e6, 9.3046e9) * sign.y;
  const auto z = gaussian(5.2481e-13 * 203826.02770, 2.2084e6, 6.6121e9) * sign.z;
  return {Splat(3.2404542F) * x - Splat(1.5371385F) * y - Splat(0.4985314F) * z,
          Splat(1.8760108F) * y - Splat(0.9692660F) * x + Splat(0.0415560F) * z,
          Splat(0.0556434F) * x - Splat(0.2040259F) * y + Splat(1.0572252F) * z};
}

HWY_INLINE FloatVector SquaredRatio(FloatVector a, FloatVector b) {
  const auto ratio = (a - b) / (a + b);
  return ratio * ratio;
}

struct ThinFilm {
  FloatVector ior, thickness;  // nanometres
};

// What a thin film over a base of reflectance `f0` mirrors of light at an angle: Belcour & Barla 2017 in the words of
// KHR_materials_iridescence, two bounces within the film. Beyond what the eye's three curves make of it, no channel
// mirrors more light than comes.
HWY_INLINE Vector3 FilmReflectance(const ThinFilm& film, FloatVector cosine, const Vector3& f0) {
  const auto zero = Splat(0.0F), one = Splat(1.0F), two = Splat(2.0F);
  // Films thinner than 0.03 nm fade to none.
  const auto t = Saturate(film.thickness * Splat(1.0F / 0.03F));
  const auto ior = one + (film.ior - one) * (t * t * (Splat(3.0F) - two * t));
  const auto sine_squared = (one - cosine * cosine) / (ior * ior);
  const auto inner_cosine = hn::Sqrt(hn::Max(one - sine_squared, zero));
  const auto outer = Schlick(Grey(SquaredRatio(ior, one)), cosine).x;
  const auto through = one - outer;
  const auto path = two * ior * film.thickness * inner_cosine;

  const Vector3 root = {hn::Sqrt(hn::Min(f0.x, Splat(0.9999F))), hn::Sqrt(hn::Min(f0.y, Splat(0.9999F))),
                        hn::Sqrt(hn::Min(f0.z, Splat(0.9999F)))};
  const auto to_ior = [&](FloatVector r) HWY_ATTR { return (one + r) / (one - r); };
  const Vector3 base_ior = {to_ior(root.x), to_ior(root.y), to_ior(root.z)};
  const Vector3 inner =
      Schlick({SquaredRatio(base_ior.x, ior), SquaredRatio(base_ior.y, ior), SquaredRatio(base_ior.z, ior)},
              inner_cosine);
  // Half a wave is lost on the way into the denser; the outer interface always adds π from within.
  const auto sign = [&](FloatVector base) HWY_ATTR { return hn::IfThenElse(base < ior, one, Splat(-1.0F)); };
  const Vector3 first_sign = {sign(base_ior.x), sign(base_ior.y), sign(base_ior.z)};
  const Vector3 first = Sensitivity(path, first_sign);
  const Vector3 second = Sensitivity(path * two, Grey(one));

  const auto channel = [&](FloatVector r23, FloatVector one_path, FloatVector two_paths) HWY_ATTR {
    const auto r123 = hn::Min(hn::Max(outer * r23, Splat(1e-5F)), Splat(0.9999F));
    const auto bounce = hn::Sqrt(r123);
    const auto inside = through * through * r23 / (one - r123);
    const auto once = (inside - through) * bounce;
    const auto sum = outer + inside + two * (once * one_path + once * bounce * two_paths);
    return Saturate(sum);
  };
  return {channel(inner.x, first.x, second.x), channel(inner.y, first.y, second.y),
          channel(inner.z, first.z, second.z)};
}

// F₀ of a Schlick term that is `reflectance` at this cosine, for tables that know of no films.
HWY_INLINE Vector3 NormalOf(const Vector3& reflectance, FloatVector cosine) {
  const auto one = Splat(1.0F);
  const auto fifth = hn::Min(FifthPower(one - cosine), Splat(0.9999F));
  const auto channel = [&](FloatVector r) HWY_ATTR { return Saturate((r - fifth) / (one - fifth)); };
  return {channel(reflectance.x), channel(reflectance.y), channel(reflectance.z)};
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
