// Where a rig's camera or light stands.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <optional>

#include "scene/json_object.h"

namespace laterna {

/// "position", "target", "up". Nothing when faulty.
std::optional<glm::dmat4> read_pose(JsonObject& object);

/// The same of a path's key: position, target, up. What the key leaves out is taken from the owner's object, which is sound.
std::optional<std::array<double, 9>> read_look_at(JsonObject& key, JsonObject& owner);

}  // namespace laterna
