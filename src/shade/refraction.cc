#include "shade/refraction.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/elementary.h"

namespace laterna::shade {

std::optional<glm::dvec3> refracted(const glm::dvec3& along, const glm::dvec3& normal, double index) {
  const double cosine = std::max(-glm::dot(along, normal), 0.0), eta = 1 / index;
  const double squared = 1 - eta * eta * (1 - cosine * cosine);
  if (squared < 0) return std::nullopt;
  return glm::normalize(eta * along + (eta * cosine - std::sqrt(squared)) * normal);
}

glm::vec3 attenuation(const MirrorVolume& volume, double metres) {
  const double lengths = metres / static_cast<double>(volume.attenuation_distance);
  glm::vec3 share(1);
  for (int i = 0; i < 3; ++i) {
    const float color = volume.attenuation_color[i];
    if (color < 1 && lengths > 0) share[i] = lengths < 1e6 ? static_cast<float>(power(color, lengths)) : 0.0F;
  }
  return share;
}

}  // namespace laterna::shade
