// Key frames that a rig gives a camera or a light: "path".
#pragma once

#include <optional>

#include "laterna/scene.h"
#include "scene/json_object.h"

namespace laterna {

/// What a path moves. Exactly one of camera and light is set; the indices are theirs in the rig's scene.
struct PathOwner {
  const Camera* camera = nullptr;
  const Light* light = nullptr;
  int index = -1;  ///< of the camera or light
  int node = -1;   ///< where it hangs
};

/// Reads "path" of a camera's or light's object:
///   {"interpolation": "smooth" | "linear" | "step", "at_end": "hold" | "loop" | "ping_pong",
///    "keys": [{"time": s, "position", "target", "up", "yfov_deg", "candela", …}, …]}
/// smooth: places run on Catmull-Rom splines, numbers and colours on monotone cubics, which never overshoot. Nothing where there is
/// none, or a faulty one.
std::optional<Clip> read_rig_path(const JsonDocument& json, const JsonValue& owner, const PathOwner& what,
                                  FaultList& faults);

}  // namespace laterna
