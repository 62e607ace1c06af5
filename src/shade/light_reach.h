// Whether a light can reach a batch of samples at all, from where they lie: most projectors and lamps with a range light
// little of a picture.
#pragma once

#include <array>
#include <glm/vec4.hpp>
#include <limits>

#include "frame/frame.h"
#include "laterna/instruction_set.h"
#include "laterna/shading.h"
#include "shadow/surface_samples.h"

namespace laterna::shade {

/// Bounds of the samples' positions.
using FindBounds = frame::Bounds (*)(const shadow::SurfaceSamples& samples);
FindBounds find_bounds_for(InstructionSet set);

/// The part of space outside of which a light gives nothing: halfspaces, and a sphere where it has a range.
class LightReach {
 public:
  LightReach(const frame::PlacedLight& placed, ShadingModel model);

  [[nodiscard]] bool is_everywhere() const {
    return halfspace_count_ == 0 && range_squared_ == std::numeric_limits<float>::infinity();
  }
  /// False only where the light surely gives nothing in the whole box.
  [[nodiscard]] bool touches(const frame::Bounds& box) const;

 private:
  void add_halfspace(const glm::dvec4& plane);  // plane · (x, y, z, 1) ≥ 0 inside

  std::array<glm::vec4, 5> halfspaces_{};  // normals of unit length
  int halfspace_count_ = 0;
  glm::vec3 position_ws_{};
  float range_squared_ = 0;
};

}  // namespace laterna::shade
