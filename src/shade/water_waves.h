// Waves on water: how they tilt its surface. docs/mirrors.md
#pragma once

#include <glm/vec3.hpp>

#include "laterna/mirrors.h"

namespace laterna::shade {

/// The unit normal of a plane at a place of it, tilted by the mirror's waves as they are at `seconds` of scene time. `footprint`: of
/// a pixel, metres along the plane; waves shorter than a few pixels flatten.
glm::dvec3 normal_on_waves(const Mirror& mirror, const glm::dvec3& plane_normal_ws,
                           const glm::dvec3& place_ws, double footprint, double seconds);

}  // namespace laterna::shade
