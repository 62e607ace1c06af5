// Through what frustum a rig's camera looks, or its projector throws.
#pragma once

#include <cstdint>
#include <optional>

#include "laterna/view.h"
#include "scene/json_object.h"

namespace laterna {

/// What the keys come to.
struct RigFrustum {
  Projection projection;
  bool aspect_is_given = false;  ///< by "aspect", "intrinsics" or both sides of "sensor_mm"
};

/// Whose frustum it is: a camera has no throw.
enum class FrustumOf : std::uint8_t { camera, projector };

/// The frustum's keys. `aspect_of_picture` stands in for a missing "aspect" where the shape of a picture is
/// known. Nothing when faulty.
std::optional<RigFrustum> read_frustum(const JsonDocument& json, JsonObject& object, FaultList& faults,
                                       FrustumOf of, std::optional<double> aspect_of_picture);

/// Whether the frustum's keys leave its height to the picture's aspect.
bool needs_aspect_of_picture(const JsonObject& object);

}  // namespace laterna
