#include "base/camera_distortion.h"

#include <glm/geometric.hpp>

namespace laterna {

double radial_factor(const CameraDistortion& lens, double r2) {
  const std::array<double, 6>& k = lens.k;
  return (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[2]))) / (1 + r2 * (k[3] + r2 * (k[4] + r2 * k[5])));
}

glm::dvec2 distorted(const CameraDistortion& lens, glm::dvec2 point) {
  const auto [p1, p2] = lens.p;
  const double r2 = glm::dot(point, point), xy = 2 * point.x * point.y;
  return point * radial_factor(lens, r2) +
         glm::dvec2(p1 * xy + p2 * (r2 + 2 * point.x * point.x), p1 * (r2 + 2 * point.y * point.y) + p2 * xy);
}

}  // namespace laterna
