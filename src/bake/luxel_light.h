// What falls on receivers: the shading's own light, shadows by rays.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

#include "bake/luxel_receivers.h"
#include "base/sample_sequence.h"
#include "light/light_plan.h"
#include "shade/illumination.h"
#include "shade/shadow_tone.h"
#include "shadow/shadow_technique.h"
#include "trace/ray_scene.h"

namespace laterna::bake {

/// All lights of a frame that add their light, as they shine from each of so many points. Const calls may come from several
/// threads at once.
class DirectLight {
 public:
  /// `points`: of lights that have a size. The frame must outlive this.
  DirectLight(const frame::Frame& frame, const std::shared_ptr<const trace::RayScene>& rays, int points,
              InstructionSet set);

  /// Adds the irradiance of each receiver, n·l included, on its front or on its back.
  void add(std::span<const Receiver> receivers, bool of_back, std::span<glm::vec3> irradiance) const;

  /// Points of lights that are asked for each receiver.
  [[nodiscard]] std::size_t light_count() const { return lights_.size(); }

 private:
  struct BakedLight {
    shade::BoundLight bound;
    std::unique_ptr<shadow::ShadowTechnique> shadow;  // null: nothing stands in its way
    shade::ShadowTone tone;
    float share;  // of the light's points
  };
  class Batch;

  const frame::Frame& frame_;
  raster::RasterView::Ray ray_;
  shade::FindIrradiance find_irradiance_;
  float position_error_;
  std::vector<light::LightPlan> plans_;
  std::vector<BakedLight> lights_;
};

/// How much of the light from all sides arrives at a luxel: by so many rays, spread by the cosine of their angle to the
/// normal, that meet nothing opaque within `distance` metres.
class OcclusionRays {
 public:
  OcclusionRays(const trace::RayScene& rays, int count, double distance);
  /// 0 … 1. `receivers`: of one luxel. Each sends its share of the rays.
  [[nodiscard]] float openness(std::span<const Receiver> receivers, bool of_back) const;

 private:
  [[nodiscard]] float openness(const Receiver& receiver, bool of_back, SampleIndex share) const;

  const trace::RayScene& rays_;
  float distance_;
  std::vector<glm::vec3> directions_;  // about +Z
};

}  // namespace laterna::bake
