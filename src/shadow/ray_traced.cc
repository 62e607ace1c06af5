#include "shadow/ray_traced.h"

#include "shadow/nearest_blocker.h"

namespace laterna::shadow {

RaysToLight::Ray RaysToLight::from(const SurfaceSamples& samples, std::size_t i) const {
  const glm::vec3 position(samples.x_ws[i], samples.y_ws[i], samples.z_ws[i]);
  const glm::vec3 toward(light_.toward_at(position));
  return {position, toward, nearest_blocker(samples, i), static_cast<float>(light_.length_at(position)),
          samples.id[i]};
}

double RayTracedShadow::find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                                     Arrival& arrival) const {
  arrival.is_tinted = false;
  for_each_sample(samples, wanted, [&](std::size_t i) {
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
  for_each_sample(samples, wanted, [&](std::size_t i) {
    const RaysToLight::Ray ray = rays_.from(samples, i);
    if (!(ray.far > ray.near)) return;
    panes.clear();
    rays_.scene().find_panes(ray.origin_ws, ray.direction_ws, ray.near, ray.far, ray.own, panes);
    for (const trace::RayScene::Pane& pane : panes) {
      const Crossing crossing =
          find_crossing(rays_.light(), ray.origin_ws, ray.near, corners_of(frame_, pane.id), OnEdge::of_one);
      if (crossing.blocks)
        crossings.push_back({static_cast<std::uint32_t>(i), pane.id, crossing.b, crossing.c});
    }
  });
}

}  // namespace laterna::shadow
