#include "shadow/ray_traced.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "shadow/nearest_blocker.h"

namespace laterna::shadow {

struct RayTracedShadow::Ray {
  glm::vec3 direction_ws;
  float length;
};

// Casters nearer to the light than its near plane do not count, as in its shadow map.
RayTracedShadow::Ray RayTracedShadow::ray_to_light(const glm::dvec3& position_ws) const {
  const frame::PlacedLight& placed = *planned_.placed;
  const Light& light = *placed.light;
  const bool is_parallel = light.type == LightType::directional ||
                           (light.type == LightType::projector && placed.view.projection.is_orthographic);
  const glm::dvec3 forward = placed.pose.forward_ws();
  const glm::dvec3 to_light = placed.pose.position_ws - position_ws;
  if (is_parallel) {
    if (light.type == LightType::directional && light.fit) {
      return {glm::vec3(-forward), std::numeric_limits<float>::infinity()};
    }
    const double length = -glm::dot(to_light, forward) - placed.view.projection.near;
    return {glm::vec3(-forward), static_cast<float>(length)};
  }
  const double distance = glm::length(to_light);
  if (distance == 0) return {glm::vec3(0, 1, 0), 0};
  double near_share = 0;
  if (light.type == LightType::projector) {
    const double along = -glm::dot(to_light, forward);
    near_share = along > 0 ? placed.view.projection.near / along : 1;
  }
  return {glm::vec3(to_light / distance), static_cast<float>(distance * (1 - near_share))};
}

double RayTracedShadow::find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                                     Arrival& arrival) const {
  arrival.is_tinted = false;
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    for (unsigned mask = wanted[group]; mask != 0; mask &= mask - 1) {
      const std::size_t i = group * kGroupSize + static_cast<std::size_t>(__builtin_ctz(mask));
      const glm::vec3 position(samples.x_ws[i], samples.y_ws[i], samples.z_ws[i]);
      const Ray ray = ray_to_light(glm::dvec3(position));
      const float near = nearest_blocker(samples, i);
      const bool is_blocked = ray.length > near &&
                              scene_->is_blocked(position, ray.direction_ws, near, ray.length, samples.id[i]);
      arrival.alpha[i] = is_blocked ? 0.0F : 1.0F;
    }
  }
  return 0;
}

}  // namespace laterna::shadow
