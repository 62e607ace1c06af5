#include "reference/layered_material.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>

namespace laterna::reference {
namespace {

const double kPi = std::acos(-1.0);

glm::dvec3 schlick(const glm::dvec3& f0, double cosine) {
  return f0 + (glm::dvec3(1) - f0) * std::pow(1 - cosine, 5);
}

double positive(double value) { return std::max(value, 0.0); }

double ggx(double n_l, double n_v, double n_h, double roughness) {
  const double alpha = std::max(roughness * roughness, 1e-3), a2 = alpha * alpha;
  const double distribution = a2 / (kPi * std::pow(n_h * n_h * (a2 - 1) + 1, 2));
  const auto g1 = [&](double c) { return 2 * c / (c + std::sqrt(a2 + (1 - a2) * c * c)); };
  return distribution * g1(n_l) * g1(n_v) / (4 * n_l * n_v);
}

// Heitz 2014: Λ from the slope along the direction, which needs no closed form of its own.
double brushed_ggx(const LayeredPoint& p, const glm::dvec3& l, const glm::dvec3& v, const glm::dvec3& h) {
  const glm::dvec3 n = p.surface.normal, across = glm::cross(n, p.along);
  const double alpha = std::max(p.surface.roughness * p.surface.roughness, 1e-3);
  const double strength = p.lobes.anisotropy.strength;
  const double at = alpha + (1 - alpha) * strength * strength, ab = alpha;
  const double slope = std::pow(glm::dot(h, p.along) / at, 2) + std::pow(glm::dot(h, across) / ab, 2);
  const double n_h = glm::dot(n, h);
  // Beckmann's form of the same distribution: tangents in place of cosines.
  const double distribution = 1 / (kPi * at * ab * std::pow(n_h, 4) * std::pow(1 + slope / (n_h * n_h), 2));
  const auto g1 = [&](const glm::dvec3& w) {
    const double c = glm::dot(n, w), sine = std::sqrt(std::max(1 - c * c, 1e-300));
    const double x = glm::dot(w, p.along) / sine, y = glm::dot(w, across) / sine;
    const double a0 = std::sqrt(x * x * at * at + y * y * ab * ab), tangent = sine / c;
    return 1 / (1 + (std::sqrt(1 + std::pow(a0 * tangent, 2)) - 1) / 2);
  };
  return distribution * g1(l) * g1(v) / (4 * glm::dot(n, l) * glm::dot(n, v));
}

double f0_of(double ior) { return ior == 0 ? 1 : std::pow((1 - ior) / (1 + ior), 2); }

}  // namespace

double sheen_lobe(double n_l, double n_v, double n_h, double roughness) {
  const double alpha = std::max(roughness * roughness, 1e-3);
  const double distribution =
      (2 + 1 / alpha) * std::pow(std::sqrt(positive(1 - n_h * n_h)), 1 / alpha) / (2 * kPi);
  const double parameters[5][2] = {
      {25.3245, 21.5473}, {3.32435, 3.82987}, {0.16801, 0.19823}, {-1.27393, -1.97760}, {-4.85967, -4.32054}};
  double q[5];
  const double mix = std::pow(1 - alpha, 2);
  for (int i = 0; i < 5; ++i) q[i] = mix * parameters[i][0] + (1 - mix) * parameters[i][1];
  const auto fit = [&](double x) { return q[0] / (1 + q[1] * std::pow(x, q[2])) + q[3] * x + q[4]; };
  const auto lambda = [&](double c) {
    return c < 0.5 ? std::exp(fit(c)) : std::exp(2 * fit(0.5) - fit(1 - c));
  };
  return distribution / ((1 + lambda(n_l) + lambda(n_v)) * 4 * n_l * n_v);
}

double sheen_albedo(double n_v, double roughness, int steps) {
  const glm::dvec3 v(std::sqrt(1 - n_v * n_v), 0, n_v);
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    for (int k = 0; k < 2 * steps; ++k) {
      const double z = (i + 0.5) / steps, turn = kPi * (k + 0.5) / steps, r = std::sqrt(1 - z * z);
      const glm::dvec3 l(r * std::cos(turn), r * std::sin(turn), z);
      sum += sheen_lobe(z, n_v, glm::normalize(l + v).z, roughness) * z;
    }
  }
  return sum * 2 * kPi / (2.0 * steps * steps);
}

glm::dvec3 film_reflectance(double film_ior, double thickness, double cosine, const glm::dvec3& f0) {
  const double t = std::clamp(thickness / 0.03, 0.0, 1.0);
  const double ior = 1 + (film_ior - 1) * t * t * (3 - 2 * t);
  const double inner = std::cos(std::asin(std::sin(std::acos(cosine)) / ior));
  const double r12 = schlick(glm::dvec3(std::pow((ior - 1) / (ior + 1), 2)), cosine).x, t121 = 1 - r12;
  const double path = 2 * ior * thickness * 1e-9 * inner;
  const auto sensitivity = [&](int m, const glm::dvec3& shift) {
    const double phase = 2 * kPi * m * path;
    const double weight[4] = {5.4856e-13, 4.4201e-13, 5.2481e-13, 9.7470e-14};
    const double position[4] = {1.6810e6, 1.7953e6, 2.2084e6, 2.2399e6};
    const double variance[4] = {4.3278e9, 9.3046e9, 6.6121e9, 4.5282e9};
    double xyz[4];
    for (int i = 0; i < 4; ++i) {
      const std::complex<double> wave(-phase * phase * variance[i], position[i] * phase + shift[i % 3]);
      xyz[i] = weight[i] * std::sqrt(2 * kPi * variance[i]) * std::exp(wave).real() / 1.0685e-7;
    }
    const double x = xyz[0] + xyz[3], y = xyz[1], z = xyz[2];
    return glm::dvec3(3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
                      -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
                      0.0556434 * x - 0.2040259 * y + 1.0572252 * z);
  };
  glm::dvec3 r23(0), shift(0);
  for (int c = 0; c < 3; ++c) {
    const double root = std::sqrt(std::min(f0[c], 0.9999)), base = (1 + root) / (1 - root);
    r23[c] = schlick(glm::dvec3(std::pow((base - ior) / (base + ior), 2)), inner).x;
    shift[c] = kPi + (base < ior ? kPi : 0);
  }
  const glm::dvec3 s1 = sensitivity(1, shift), s2 = sensitivity(2, 2.0 * shift);
  glm::dvec3 result;
  for (int c = 0; c < 3; ++c) {
    const double r123 = std::clamp(r12 * r23[c], 1e-5, 0.9999);
    const double rs = t121 * t121 * r23[c] / (1 - r123);
    const double c1 = (rs - t121) * std::sqrt(r123), c2 = c1 * std::sqrt(r123);
    result[c] = std::clamp(r12 + rs + c1 * 2 * s1[c] + c2 * 2 * s2[c], 0.0, 1.0);
  }
  return result;
}

glm::dvec3 reflect_layered(const LayeredPoint& p, const glm::dvec3& to_light) {
  const SurfacePoint& s = p.surface;
  const MaterialLobes& lobes = p.lobes;
  const glm::dvec3 h = glm::normalize(s.to_eye + to_light);
  const double n_l = glm::dot(s.normal, to_light), n_v = glm::dot(s.normal, s.to_eye);
  const double n_h = glm::dot(s.normal, h), v_h = glm::dot(s.to_eye, h);
  glm::dvec3 sum(0);
  if (n_l > 0) {
    const glm::dvec3 f0 = glm::min(f0_of(lobes.ior) * glm::dvec3(lobes.specular.color), glm::dvec3(1));
    glm::dvec3 dielectric = schlick(f0, v_h), metal = schlick(s.base, v_h);
    const IridescenceLobe& film = lobes.iridescence;
    if (film.factor > 0) {
      const auto covered = [&](const glm::dvec3& plain, const glm::dvec3& base_f0) {
        const double share = film.factor;
        return plain * (1 - share) + film_reflectance(film.ior, film.thickness_maximum, v_h, base_f0) * share;
      };
      dielectric = covered(dielectric, f0);
      metal = covered(metal, s.base);
    }
    dielectric *= static_cast<double>(lobes.specular.factor);
    const double largest = std::max({dielectric.x, dielectric.y, dielectric.z});
    const glm::dvec3 mirrored = dielectric * (1 - s.metallic) + metal * s.metallic;
    const glm::dvec3 kept = glm::dvec3(largest * (1 - s.metallic)) + metal * s.metallic;
    const double scatters = (1 - s.metallic) * (1 - lobes.transmission.factor);
    const double facets = lobes.anisotropy.strength > 0 ? brushed_ggx(p, to_light, s.to_eye, h)
                                                        : ggx(n_l, n_v, n_h, s.roughness);
    for (int c = 0; c < 3; ++c)
      sum[c] = (positive(1 - kept[c]) * scatters * s.base[c] / kPi + mirrored[c] * facets) * n_l;
    const glm::dvec3 sheen(lobes.sheen.color);
    const double most = std::max({sheen.x, sheen.y, sheen.z});
    if (most > 0) {
      sum *= std::min(1 - most * p.sheen_albedo(n_v), 1 - most * p.sheen_albedo(n_l));
      sum += sheen * (sheen_lobe(n_l, n_v, n_h, lobes.sheen.roughness) * n_l);
    }
  }
  if (lobes.clearcoat.factor > 0) {
    const double c_l = glm::dot(p.coat_normal, to_light), c_v = glm::dot(p.coat_normal, s.to_eye);
    const double share = lobes.clearcoat.factor * schlick(glm::dvec3(0.04), std::abs(c_v)).x;
    sum *= 1 - share;
    // Seen from behind, it is as bright as at its edge.
    if (c_l > 0)
      sum += share * c_l *
             ggx(c_l, std::max(c_v, 1e-12), positive(glm::dot(p.coat_normal, h)), lobes.clearcoat.roughness);
  }
  return sum;
}

glm::dvec3 refracted(const glm::dvec3& to_eye, const glm::dvec3& normal, double ior) {
  const double angle = std::acos(std::clamp(glm::dot(to_eye, normal), -1.0, 1.0));
  const double within = std::asin(std::sin(angle) / ior);
  const glm::dvec3 sideways = normal * glm::dot(to_eye, normal) - to_eye;
  const double length = glm::length(sideways);
  if (length < 1e-12) return -normal;
  return sideways * (std::sin(within) / length) - normal * std::cos(within);
}

}  // namespace laterna::reference
