// Light that goes on behind a surface.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "laterna/mirrors.h"

namespace laterna::shade {

/// Snell's law: the unit direction behind a surface of a unit ray that meets it from before, on the side of its unit normal; `index`:
/// that of what lies behind over that of what lies before. None: total reflection.
std::optional<glm::dvec3> refracted(const glm::dvec3& along, const glm::dvec3& normal, double index);

/// What is left of light that went so many metres, which may be infinitely many.
glm::vec3 attenuation(const MirrorVolume& volume, double metres);

}  // namespace laterna::shade
