// What falls on a surface, in lux.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

#include "image/luminance.h"
#include "shade/illumination.h"
#include "shadow/surface_samples.h"

namespace laterna::shade {

/// E = Y(irradiance · share) (n·l), n the normal of the sample's triangle: normals that only shade change nothing of what
/// a meter on the surface reads. The irradiance must be photometric, not the papers'; `share`: what arrives of it.
inline float illuminance(const shadow::SurfaceSamples& samples, const Irradiance& irradiance,
                         const glm::vec3& share, std::size_t i) {
  const float cosine = samples.normal_x_ws[i] * irradiance.to_light_x_ws[i] +
                       samples.normal_y_ws[i] * irradiance.to_light_y_ws[i] +
                       samples.normal_z_ws[i] * irradiance.to_light_z_ws[i];
  if (!(cosine > 0)) return 0;
  return image::luminance(irradiance.r[i] * share.r, irradiance.g[i] * share.g, irradiance.b[i] * share.b) *
         cosine;
}

}  // namespace laterna::shade
