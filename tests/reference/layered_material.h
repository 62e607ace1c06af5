// glTF's material extensions written down from their specifications, one pair of directions at a time, in double.
#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "laterna/material_lobes.h"
#include "reference/reflection.h"

namespace laterna::reference {

struct LayeredPoint {
  SurfacePoint surface;
  MaterialLobes lobes;            ///< without textures
  glm::dvec3 coat_normal, along;  ///< unit; `along` square to the normal: where highlights are long
  /// E of the sheen lobe by n·v; set where there is sheen.
  std::function<double(double cosine)> sheen_albedo;
};

/// BRDF × n·l: radiance for an illuminance of 1 on a surface square to the light. 0 from behind.
glm::dvec3 reflect_layered(const LayeredPoint& point, const glm::dvec3& to_light);

/// D V of Estevez & Kulla 2017.
double sheen_lobe(double n_l, double n_v, double n_h, double roughness);
/// Its albedo, by midpoints over `steps` × 2 `steps` directions.
double sheen_albedo(double n_v, double roughness, int steps);

/// KHR_materials_iridescence: what a film of `thickness` nanometres over a base of F₀ mirrors.
glm::dvec3 film_reflectance(double film_ior, double thickness, double cosine, const glm::dvec3& f0);

/// A direction refracted into a surface of that index: Snell's law, by angles.
glm::dvec3 refracted(const glm::dvec3& to_eye, const glm::dvec3& normal, double ior);

}  // namespace laterna::reference
