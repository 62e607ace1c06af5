#include "reference/reflection.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace laterna::reference {
namespace {

constexpr double kPi = 3.14159265358979323846;

// B.3.2, one factor of G.
double smith(double cosine, double alpha) {
  const double a2 = alpha * alpha;
  return 2 * std::abs(cosine) / (std::abs(cosine) + std::sqrt(a2 + (1 - a2) * cosine * cosine));
}

double attenuation(const Light& light, double along, double distance) {
  switch (light.attenuation) {
    case Attenuation::none:
      return 1;
    case Attenuation::inverse_square:
      return 1 / (distance * distance);
    case Attenuation::gltf_windowed:
      return std::clamp(1 - std::pow(distance / light.range, 4), 0.0, 1.0) / (distance * distance);
    case Attenuation::linear:
      return std::clamp(1 - along / light.range, 0.0, 1.0);
    case Attenuation::custom:
      break;
  }
  return light.custom_attenuation(static_cast<float>(along));
}

// KHR_lights_punctual, "Inner and Outer Cone Angles".
double angular_attenuation(const Light& light, double cosine) {
  const double inner = std::cos(light.inner_cone.in_radians()),
               outer = std::cos(light.outer_cone.in_radians());
  const double scale = 1 / std::max(0.001, inner - outer);
  const double angular = std::clamp(cosine * scale - outer * scale, 0.0, 1.0);
  return angular * angular;
}

}  // namespace

glm::dvec3 reflect_gltf(const SurfacePoint& p, const glm::dvec3& to_light) {
  const glm::dvec3 half = glm::normalize(p.to_eye + to_light);
  const double n_l = glm::dot(p.normal, to_light), n_v = glm::dot(p.normal, p.to_eye),
               n_h = glm::dot(p.normal, half), v_h = glm::dot(p.to_eye, half);
  if (n_l <= 0) return glm::dvec3(0);
  const double alpha = p.roughness * p.roughness;
  const double a2 = alpha * alpha;
  const double denominator = n_h * n_h * (a2 - 1) + 1;
  const double distribution = a2 / (kPi * denominator * denominator);
  const double masking = smith(n_l, alpha) * smith(n_v, alpha);
  const double specular = distribution * masking / (4 * std::abs(n_v) * std::abs(n_l));
  const glm::dvec3 c_diff = glm::mix(p.base, glm::dvec3(0), p.metallic);
  const glm::dvec3 f0 = glm::mix(glm::dvec3(0.04), p.base, p.metallic);
  const glm::dvec3 fresnel = f0 + (1.0 - f0) * std::pow(1 - std::abs(v_h), 5);
  return ((1.0 - fresnel) * (1 / kPi) * c_diff + fresnel * specular) * n_l;
}

glm::dvec3 reflect_blinn_phong(const SurfacePoint& p, const glm::dvec3& to_light,
                               const PhongHighlight& highlight) {
  const double n_l = glm::dot(p.normal, to_light);
  if (n_l <= 0) return glm::dvec3(0);
  const double n_h = std::max(0.0, glm::dot(p.normal, glm::normalize(p.to_eye + to_light)));
  return p.base * n_l +
         static_cast<double>(highlight.specular) * std::pow(n_h, static_cast<double>(highlight.shininess));
}

glm::dvec3 reflect_blinn_phong(const SurfacePoint& p, const glm::dvec3& to_light) {
  const double n_l = glm::dot(p.normal, to_light);
  if (n_l <= 0) return glm::dvec3(0);
  const double n_h = std::max(0.0, glm::dot(p.normal, glm::normalize(p.to_eye + to_light)));
  const double a2 = std::max(std::pow(p.roughness, 4), 1e-4);
  const double exponent = std::max(1.0, 2 / a2 - 2);
  const glm::dvec3 f0 = glm::mix(glm::dvec3(0.04), p.base, p.metallic);
  return p.base * ((1 - p.metallic) * n_l) + f0 * std::pow(n_h, exponent);
}

double illuminance(const Light& light, const Pose& pose, const glm::dvec3& point_ws) {
  const glm::dvec3 from_light = point_ws - pose.position_ws;
  const double distance = glm::length(from_light);
  const double along = glm::dot(from_light, pose.forward_ws());
  switch (light.type) {
    case LightType::directional:
      return 1;
    case LightType::point:
      return attenuation(light, distance, distance);
    case LightType::spot:
      return attenuation(light, along, distance) * angular_attenuation(light, along / distance);
    case LightType::projector:
      break;
  }
  if (light.projection.is_orthographic) {
    const bool fades = light.attenuation == Attenuation::linear || light.attenuation == Attenuation::custom;
    return fades ? attenuation(light, along, along) : 1;
  }
  if (light.profile == BeamProfile::uniform_candela) return attenuation(light, along, distance);
  // A square-on wall at this distance along the axis is lit evenly, I f(z); its cosine taken back.
  return attenuation(light, along, along) * distance / along;
}

}  // namespace laterna::reference
