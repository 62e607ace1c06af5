// Hard shadows by rays: what the other techniques are measured against.
#pragma once

#include <memory>

#include "light/light_plan.h"
#include "shadow/exact_crossing.h"
#include "shadow/panes.h"
#include "shadow/shadow_technique.h"
#include "trace/ray_scene.h"

namespace laterna::shadow {

/// From samples to one light.
class RaysToLight {
 public:
  RaysToLight(const light::PlannedLight& planned, std::shared_ptr<const trace::RayScene> scene)
      : light_(*planned.placed), scene_(std::move(scene)) {}

  struct Ray {
    glm::vec3 origin_ws, direction_ws;
    float near, far;
    TriangleId own;
  };
  /// Empty (far below near) where there is nothing between the sample and the light's near plane.
  [[nodiscard]] Ray from(const SurfaceSamples& samples, std::size_t i) const;
  [[nodiscard]] const light::LightRays& light() const { return light_; }
  [[nodiscard]] const trace::RayScene& scene() const { return *scene_; }

 private:
  light::LightRays light_;
  std::shared_ptr<const trace::RayScene> scene_;
};

class RayTracedShadow final : public ShadowTechnique {
 public:
  RayTracedShadow(const light::PlannedLight& planned, std::shared_ptr<const trace::RayScene> scene)
      : rays_(planned, std::move(scene)) {}
  double find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                      Arrival& arrival) const override;

 private:
  RaysToLight rays_;
};

/// The panes in the way, by rays. Of two triangles that share the edge through which a ray passes Embree gives both: which of
/// them counts is decided as for exact shadows.
class RayTracedPanes final : public PaneFinder {
 public:
  RayTracedPanes(const light::PlannedLight& planned, const frame::Frame& frame,
                 std::shared_ptr<const trace::RayScene> scene)
      : rays_(planned, std::move(scene)), frame_(frame) {}
  void find(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
            std::vector<PaneCrossing>& crossings) const override;

 private:
  RaysToLight rays_;
  const frame::Frame& frame_;
};

}  // namespace laterna::shadow
