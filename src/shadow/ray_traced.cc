#include "shadow/ray_traced.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "raster/triangle_bins.h"

namespace laterna::shadow {
namespace {

// The ray's own triangle is left out; its neighbours must not be met at the very start by rounding alone, nor because
// corners were snapped: at its rim a triangle may have been given samples that lie on its plane a little beside it.
float nearest_blocker(const SurfaceSamples& s, std::size_t i) {
  const raster::RasterView::Ray& ray = s.ray;
  // The point is the homogeneous ray's first three coordinates over its fourth.
  const double h = ray.ray_0.w + ray.ray_x.w * s.x[i] + ray.ray_y.w * s.y[i] + ray.q_term.w * s.q[i];
  const glm::dvec3 position(s.x_ws[i], s.y_ws[i], s.z_ws[i]);
  const auto pixel_side = [&](const glm::dvec4& along, float dq) {
    const glm::dvec4 step = along + ray.q_term * static_cast<double>(dq);
    return glm::length(glm::dvec3(step) - position * step.w) / h;
  };
  const double pixel = pixel_side(ray.ray_x, s.dq_dx[i]) + pixel_side(ray.ray_y, s.dq_dy[i]);
  return 2 * s.position_error + static_cast<float>(pixel / raster::kSubpixels);
}

}  // namespace

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
