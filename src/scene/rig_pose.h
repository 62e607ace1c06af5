// Where a rig's camera or light stands, and through what frustum it looks.
#pragma once

#include <glm/mat4x4.hpp>
#include <optional>

#include "laterna/scene.h"
#include "scene/json_object.h"

namespace laterna {

/// "position", "target", "up". Nothing when faulty.
std::optional<glm::dmat4> read_pose(JsonObject& object);

struct RigFrustum {
  Projection projection;
  bool aspect_is_given = false;  ///< by "aspect" or "intrinsics"
};

/// The frustum's keys. `aspect_of_picture` stands in for a missing "aspect" where the shape of a picture is
/// known. Nothing when faulty.
std::optional<RigFrustum> read_frustum(const JsonDocument& json, JsonObject& object, FaultList& faults,
                                       std::optional<double> aspect_of_picture);

/// Whether any key says how wide the frustum is. Reports when none or several do.
bool has_one_opening(JsonObject& object);

}  // namespace laterna
