#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "laterna/measure.h"

namespace laterna {

EyeLinearPlanes eye_linear_planes(const View& camera, const View& light) {
  // Rows of the matrix are columns of its transpose.
  const glm::dmat4 rows = glm::transpose(light.image_from_world() * camera.pose.world_from_view());
  return {rows[0], rows[1], rows[2], rows[3]};
}

glm::dvec3 EyeLinearPlanes::texture_at(const glm::dvec3& position_es) const {
  const glm::dvec4 position(position_es, 1);
  return glm::dvec3(glm::dot(s, position), glm::dot(t, position), glm::dot(r, position)) /
         glm::dot(q, position);
}

}  // namespace laterna
