#include "shade/water_waves.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/elementary.h"

namespace laterna::shade {
namespace {

// The slope of a train of waves at a place, along its direction within the surface. Waves shorter than a few pixels flatten:
// no picture shows them. Time comes in by the phase alone, so that waves stilled at that phase (make_still) have the same bits.
double slope_of(const Wave& wave, double along, double seconds, double footprint) {
  const double shown = std::clamp(wave.length / (4 * footprint) - 0.5, 0.0, 1.0);
  const double cycles = along / wave.length;
  return shown * wave.amplitude * (2 * kPi / wave.length) *
         cosine(2 * kPi * (cycles - std::floor(cycles)) + phase_at(wave, seconds));
}

}  // namespace

// The normal of h = Σ waves over the plane: n − ∇h.
glm::dvec3 normal_on_waves(const Mirror& mirror, const glm::dvec3& plane_normal_ws,
                           const glm::dvec3& place_ws, double footprint, double seconds) {
  const glm::dvec3& n = plane_normal_ws;
  glm::dvec3 normal = n;
  for (const Wave& wave : mirror.waves) {
    const glm::dvec3 within = wave.direction_ws - glm::dot(wave.direction_ws, n) * n;
    const double length = glm::length(within);
    if (length <= 1e-9 * glm::length(wave.direction_ws)) continue;  // straight through the surface
    const glm::dvec3 direction = within / length;
    normal -= direction * slope_of(wave, glm::dot(direction, place_ws), seconds, footprint);
  }
  return normal / glm::length(normal);
}

}  // namespace laterna::shade
