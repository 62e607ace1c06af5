// Where a rig's camera or light stands.
#pragma once

#include <glm/mat4x4.hpp>
#include <optional>

#include "scene/json_object.h"

namespace laterna {

/// "position", "target", "up". Nothing when faulty.
std::optional<glm::dmat4> read_pose(JsonObject& object);

}  // namespace laterna
