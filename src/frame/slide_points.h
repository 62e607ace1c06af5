// From points of the world to a projector's slide, and back.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "frame/frame.h"

namespace laterna::frame {

/// Slide coordinates (s, t), (0, 0) the top-left corner, of what a projector throws on a point; outside [0, 1] beyond its
/// frame. Nothing behind the lens, or where a distorting one throws nothing.
std::optional<glm::dvec2> slide_from_world(const PlacedLight& projector, const glm::dvec3& point_ws);

/// Where a place of the slide is seen on a wall square to the beam, `distance` metres along its axis. Nothing when the
/// lens throws it nowhere.
std::optional<glm::dvec3> world_from_slide(const PlacedLight& projector, glm::dvec2 slide, double distance);

}  // namespace laterna::frame
