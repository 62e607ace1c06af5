// Base colours of a batch of samples from the photographs that see them.
#pragma once

#include <memory>
#include <vector>

#include "shade/light_reach.h"
#include "shade/photograph_blend.h"
#include "shadow/shadow_technique.h"

namespace laterna::shade {

/// A photograph as the painter uses it.
struct ShaderPhotograph {
  BoundPhotograph bound;
  LightReach reach;
  std::unique_ptr<shadow::ShadowTechnique> visibility;  ///< null: everything is in sight
};

/// Photographs of a picture, the same for all tiles.
struct PhotographJob {
  std::vector<ShaderPhotograph> photographs;
  glm::vec3 unseen{0};
};

/// Buffers of one worker.
class PhotographPainter {
 public:
  PhotographPainter(const PhotographJob& job, bool keeps_colors, InstructionSet set);

  /// Replaces the base colours of `points`. Returns what ShadowTechnique::find_arrival does.
  double paint(const shadow::SurfaceSamples& samples, SurfacePoints& points);

  [[nodiscard]] const PhotographSums& sums() const { return *sums_; }
  /// Of each photograph, of the samples painted last; empty unless they are kept.
  [[nodiscard]] std::span<const PhotographColor> colors() const { return colors_; }

 private:
  const PhotographJob& job_;
  FindFaced find_faced_;
  AddPhotograph add_photograph_;
  TakePhotographs take_photographs_;
  FindBounds find_bounds_;
  std::unique_ptr<PhotographSums> sums_;
  std::unique_ptr<shadow::Arrival> arrival_;
  std::vector<PhotographColor> colors_;  // one, or one for each photograph where they are kept
  bool keeps_colors_;
};

}  // namespace laterna::shade
