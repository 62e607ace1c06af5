// Hard shadows by rays: what the other techniques are measured against.
#pragma once

#include <memory>

#include "light/light_plan.h"
#include "shadow/shadow_technique.h"
#include "trace/ray_scene.h"

namespace laterna::shadow {

class RayTracedShadow final : public ShadowTechnique {
 public:
  RayTracedShadow(const light::PlannedLight& planned, std::shared_ptr<const trace::RayScene> scene)
      : planned_(planned), scene_(std::move(scene)) {}
  double find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                      Arrival& arrival) const override;

 private:
  struct Ray;
  [[nodiscard]] Ray ray_to_light(const glm::dvec3& position_ws) const;

  const light::PlannedLight& planned_;
  std::shared_ptr<const trace::RayScene> scene_;
};

}  // namespace laterna::shadow
