// What the kernels make of a measured lamp.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "laterna/instruction_set.h"
#include "laterna/lamps.h"

namespace laterna::reference {

/// Candela toward unit directions of the light's space, as the shading kernel finds them for a point light that has no
/// rotation and does not fade.
std::vector<float> shaded_candela(const LightDistribution& lamp, std::span<const glm::dvec3> directions_ls,
                                  InstructionSet set);

/// Directions all over the sphere, evenly, none on a round angle.
std::vector<glm::dvec3> spread_directions(int count);

/// Flux by the same directions: knows nothing of grids of angles.
double flux_by_directions(const LightDistribution& lamp, int count);

}  // namespace laterna::reference
