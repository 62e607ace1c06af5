// What falls on a surface, in lux.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

#include "shade/illumination.h"
#include "shadow/surface_samples.h"

namespace laterna::shade {

/// Rec. 709 luminance of linear colour.
inline float luminance(const glm::vec3& color) {
  return 0.2126F * color.x + 0.7152F * color.y + 0.0722F * color.z;
}

/// E = Y(irradiance · share) (n·l), n the normal of the sample's triangle: normals that only shade change nothing of what
/// a meter on the surface reads. The irradiance must be photometric, not the papers'; `share`: what arrives of it.
inline float illuminance(const shadow::SurfaceSamples& samples, const Irradiance& irradiance,
                         const glm::vec3& share, std::size_t i) {
  const float cosine = samples.normal_x_ws[i] * irradiance.to_light_x_ws[i] +
                       samples.normal_y_ws[i] * irradiance.to_light_y_ws[i] +
                       samples.normal_z_ws[i] * irradiance.to_light_z_ws[i];
  if (!(cosine > 0)) return 0;
  return luminance(glm::vec3(irradiance.r[i], irradiance.g[i], irradiance.b[i]) * share) * cosine;
}

}  // namespace laterna::shade
