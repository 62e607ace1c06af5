// Light and its reflection written down from the formulas, one point at a time, in double.
#pragma once

#include <glm/vec3.hpp>

#include "laterna/scene.h"

namespace laterna::reference {

struct SurfacePoint {
  glm::dvec3 normal, to_eye;  // unit
  glm::dvec3 base;
  double metallic = 0, roughness = 1;
};

/// glTF 2.0, appendix B.3: factor from illuminance on a surface square to the light to radiance.
glm::dvec3 reflect_gltf(const SurfacePoint& point, const glm::dvec3& to_light);
/// base · n·l + k_s (n·h)^p, Blinn 1977.
glm::dvec3 reflect_blinn_phong(const SurfacePoint& point, const glm::dvec3& to_light,
                               const PhongHighlight& highlight);
/// The same with p = 2/α² − 2 (at least 1) and glTF's reflectance at normal incidence.
glm::dvec3 reflect_blinn_phong(const SurfacePoint& point, const glm::dvec3& to_light);

/// KHR_lights_punctual and row 19: the share of `light.intensity` that falls on a surface square to the ray
/// at `point_ws`, as lux per candela (lux per lux for parallel light). For a projector without its slide.
double illuminance(const Light& light, const Pose& pose, const glm::dvec3& point_ws);

}  // namespace laterna::reference
