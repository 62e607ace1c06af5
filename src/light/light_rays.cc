#include "light/light_rays.h"

#include <glm/geometric.hpp>
#include <limits>

namespace laterna::light {

glm::dvec4 homogeneous_light(const frame::PlacedLight& placed) {
  return is_parallel(*placed.light) ? glm::dvec4(-placed.pose.forward_ws(), 0)
                                    : glm::dvec4(placed.pose.position_ws, 1);
}

LightRays::LightRays(const frame::PlacedLight& placed)
    : is_parallel(laterna::is_parallel(*placed.light)),
      position_ws(placed.pose.position_ws),
      forward_ws(placed.pose.forward_ws()),
      has_near(has_frustum(*placed.light)),
      near(has_near ? placed.view.projection.near : 0) {}

double LightRays::beyond_near(const glm::dvec3& point_ws) const {
  return has_near ? glm::dot(point_ws - position_ws, forward_ws) - near : 1;
}

double LightRays::length_at(const glm::dvec3& point_ws) const {
  if (is_parallel) return has_near ? beyond_near(point_ws) : std::numeric_limits<double>::infinity();
  const double whole = glm::length(point_ws - position_ws);
  if (!has_near) return whole;
  const double along = glm::dot(point_ws - position_ws, forward_ws);
  return along > 0 ? whole * (1 - near / along) : 0;
}

glm::dvec3 LightRays::toward_at(const glm::dvec3& point_ws) const {
  if (is_parallel) return -forward_ws;
  const glm::dvec3 way = position_ws - point_ws;
  const double length = glm::length(way);
  return length > 0 ? way / length : glm::dvec3(0);
}

}  // namespace laterna::light
