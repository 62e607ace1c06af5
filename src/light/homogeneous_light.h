// Where light comes from, as one point that may be at infinity.
#pragma once

#include <glm/vec4.hpp>

#include "frame/frame.h"

namespace laterna::light {

/// Whether all rays run the same way.
inline bool is_parallel(const frame::PlacedLight& placed) {
  return placed.light->type == LightType::directional ||
         (placed.light->type == LightType::projector && placed.view.projection.is_orthographic);
}

/// (position, 1), or (direction toward the light, 0).
inline glm::dvec4 homogeneous_light(const frame::PlacedLight& placed) {
  return is_parallel(placed) ? glm::dvec4(-placed.pose.forward_ws(), 0)
                             : glm::dvec4(placed.pose.position_ws, 1);
}

}  // namespace laterna::light
