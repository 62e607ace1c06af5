// What normals and tangents both need of single triangles. In double: the squares of tiny edges must not
// vanish.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "base/elementary.h"

namespace laterna {

/// Unit vector along v, or `fallback` when v has no direction.
inline glm::dvec3 unit_or(glm::dvec3 v, glm::dvec3 fallback) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0)) return fallback;
  v /= largest;
  return v / std::sqrt(glm::dot(v, v));
}

/// In [0, π]; π/2 when one of the vectors has no direction.
inline double angle_between(glm::dvec3 u, glm::dvec3 v) {
  const glm::dvec3 zero(0.0);
  return arccosine(std::clamp(glm::dot(unit_or(u, zero), unit_or(v, zero)), -1.0, 1.0));
}

/// Some unit vector at right angles to the unit vector n.
inline glm::dvec3 any_perpendicular(glm::dvec3 n) {
  const glm::dvec3 axis = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return unit_or(axis - n * glm::dot(n, axis), axis);
}

}  // namespace laterna
