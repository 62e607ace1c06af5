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
  bool aspect_is_given = false;  ///< by "aspect", "intrinsics", "frustum" or both sides of "sensor_mm"
};

/// Whose frustum it is: a camera has no throw.
enum class FrustumOf : std::uint8_t { camera, projector };

/// Metres along the axis.
struct DepthRange {
  double near, far;
};

/// The frustum's keys. `aspect_of_picture` stands in for a missing "aspect" where the shape of a picture is
/// known, `range` for a missing "near" or "far". Nothing when faulty.
std::optional<RigFrustum> read_frustum(const JsonDocument& json, JsonObject& object, FaultList& faults,
                                       FrustumOf of, std::optional<double> aspect_of_picture,
                                       std::optional<DepthRange> range = std::nullopt);

/// "left", "right", "bottom" and "top" of a frustum: tangents at unit distance, or metres where it is "parallel".
void read_sides(const JsonDocument& json, const JsonValue& value, FaultList& faults, Projection& projection);

/// Whether the frustum's keys leave its height to the picture's aspect.
bool needs_aspect_of_picture(const JsonObject& object);

}  // namespace laterna
