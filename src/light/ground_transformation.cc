#include "light/ground_transformation.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace laterna::light {

glm::dvec4 plane_equation(const ShadowPlane& plane) {
  return {glm::normalize(plane.normal), -plane.distance};
}

glm::dmat4 ground_transformation(const glm::dvec4& plane_equation, const glm::dvec4& light) {
  return glm::dmat4(glm::dot(plane_equation, light)) - glm::outerProduct(light, plane_equation);
}

}  // namespace laterna::light
