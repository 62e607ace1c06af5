// Shadows from two paraboloid maps: Brabec, Annen and Seidel, Shadow mapping for hemispherical and omnidirectional light
// sources, 2002.
#pragma once

#include <memory>

#include "frame/triangle_neighbours.h"
#include "shadow/exact_crossing.h"
#include "shadow/paraboloid_map.h"
#include "shadow/shadow_map.h"
#include "shadow/shadow_technique.h"

namespace laterna::shadow {

/// In double precision throughout, and so the same for every instruction set.
class ParaboloidShadow final : public ShadowTechnique {
 public:
  /// Where its maps look and how finely.
  static ParaboloidPair pair_of(const light::PlannedLight& planned);
  /// `map`: of that pair. `neighbours`: of the frame, or null; both outlive this.
  ParaboloidShadow(const light::PlannedLight& planned, std::shared_ptr<const ParaboloidMap> map,
                   const frame::Frame& frame, const frame::TriangleNeighbours* neighbours,
                   int samples_per_pixel);

  double find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                      Arrival& arrival) const override;

  [[nodiscard]] std::size_t memory_bytes() const { return map_->memory_bytes(); }

 private:
  struct Receiver;
  struct Suspects;
  struct Tap;

  [[nodiscard]] Receiver find_receiver(const SurfaceSamples& samples, std::size_t i) const;
  [[nodiscard]] Tap tap(const Receiver& receiver, int x, int y) const;
  [[nodiscard]] double compare(const Receiver& receiver, const Tap& tap) const;
  [[nodiscard]] double filtered(const Receiver& receiver) const;
  bool find_suspects(const Receiver& receiver, Suspects& suspects, double& alpha) const;
  [[nodiscard]] double refined(const SurfaceSamples& samples, std::size_t i) const;
  [[nodiscard]] bool is_blocked(const glm::vec3& position_ws, float nearest, const Suspects& suspects) const;
  bool walk_on(TriangleId start, TriangleId own, const glm::dvec3& place, Suspects& suspects) const;
  [[nodiscard]] std::array<TriangleId, 3> find_across(TriangleId id) const;
  [[nodiscard]] bool is_small(TriangleId id) const;

  const frame::Frame& frame_;
  const frame::TriangleNeighbours* neighbours_;  // null: not known
  light::LightRays light_;
  std::shared_ptr<const ParaboloidMap> map_;
  ShadowFilter filter_;
  ShadowBias bias_;
  int kernel_;
  int positions_;  // refined: in a pixel
  double soft_edge_;
};

}  // namespace laterna::shadow
