// Ground shadows: casters projected onto planes. Blinn, Me and my (fake) shadow, 1988; Bentley, A comparison of shadow
// algorithms, 1995.
#pragma once

#include <vector>

#include "light/light_plan.h"
#include "shadow/shadow_technique.h"

namespace laterna::shadow {

/// The shadow polygons of all casters on each of the light's planes, asked at the samples that lie on it. Polygons are
/// made when a sample asks and are not kept: memory does not grow with the number of lights.
class GroundShadow final : public ShadowTechnique {
 public:
  /// The plan and the frame must outlive this.
  GroundShadow(const light::PlannedLight& planned, const frame::Frame& frame);
  double find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                      Arrival& arrival) const override;

 private:
  struct Receiver {
    glm::dvec4 height;  // of (point, 1) over the plane, on the light's side
    glm::dvec4 s, t,
        w;  // the ground transformation followed by coordinates in the plane: s/w, t/w where w > 0
  };
  struct Batch;
  void darken(const Receiver& receiver, Batch& batch, Arrival& arrival) const;
  void draw_cluster(const Receiver& receiver, std::size_t cluster, Batch& batch) const;

  const frame::Frame& frame_;
  std::vector<Receiver> receivers_;
  double tolerance_;
  glm::dvec4 in_front_;  // of the light's near plane: at least 0
};

}  // namespace laterna::shadow
