#include "shadow/ray_traced.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "shadow/nearest_blocker.h"

namespace laterna::shadow {

namespace {

struct Way {
  glm::vec3 direction_ws;
  float length;
};

// Casters nearer to the light than its near plane do not count, as in its shadow map.
Way way_to_light(const frame::PlacedLight& placed, const glm::dvec3& position_ws) {
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

CornersOfTriangle corners_of(const frame::Frame& frame, TriangleId id) {
  const auto corner = [&](unsigned k) {
    const std::size_t v = frame.clusters[cluster_of(id)].first_vertex + (frame.corners[id] >> (8 * k) & 255U);
    return glm::vec3(frame.x_ws[v], frame.y_ws[v], frame.z_ws[v]);
  };
  return {corner(0), corner(1), corner(2)};
}

// Calls `use(i)` for every sample named by `wanted`.
template <class Use>
void for_each(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted, Use use) {
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    for (unsigned mask = wanted[group]; mask != 0; mask &= mask - 1) {
      use(group * kGroupSize + static_cast<std::size_t>(__builtin_ctz(mask)));
    }
  }
}

}  // namespace

RaysToLight::Ray RaysToLight::from(const SurfaceSamples& samples, std::size_t i) const {
  const glm::vec3 position(samples.x_ws[i], samples.y_ws[i], samples.z_ws[i]);
  const Way way = way_to_light(*planned_.placed, glm::dvec3(position));
  return {position, way.direction_ws, nearest_blocker(samples, i), way.length, samples.id[i]};
}

double RayTracedShadow::find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                                     Arrival& arrival) const {
  arrival.is_tinted = false;
  for_each(samples, wanted, [&](std::size_t i) {
    const RaysToLight::Ray ray = rays_.from(samples, i);
    const bool is_blocked = ray.far > ray.near && rays_.scene().is_blocked(ray.origin_ws, ray.direction_ws,
                                                                           ray.near, ray.far, ray.own);
    arrival.alpha[i] = is_blocked ? 0.0F : 1.0F;
  });
  return 0;
}

void RayTracedPanes::find(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                          std::vector<PaneCrossing>& crossings) const {
  std::vector<trace::RayScene::Pane> panes;
  for_each(samples, wanted, [&](std::size_t i) {
    const RaysToLight::Ray ray = rays_.from(samples, i);
    if (!(ray.far > ray.near)) return;
    panes.clear();
    rays_.scene().find_panes(ray.origin_ws, ray.direction_ws, ray.near, ray.far, ray.own, panes);
    for (const trace::RayScene::Pane& pane : panes) {
      const Crossing crossing =
          find_crossing(light_, ray.origin_ws, ray.near, corners_of(frame_, pane.id), OnEdge::of_one);
      if (crossing.blocks)
        crossings.push_back({static_cast<std::uint32_t>(i), pane.id, crossing.b, crossing.c});
    }
  });
}

}  // namespace laterna::shadow
