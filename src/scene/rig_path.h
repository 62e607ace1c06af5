// Key frames that a rig gives a camera, a light or a node of the scene: "path".
#pragma once

#include <optional>

#include "laterna/scene.h"
#include "scene/json_object.h"

namespace laterna {

/// What a path moves: a camera or a light, with their indices in the rig's scene; where neither is set, a node of any file.
struct PathOwner {
  const Camera* camera = nullptr;
  const Light* light = nullptr;
  int index = -1;  ///< of the camera or light
  int node = -1;   ///< where it hangs
};

/// Reads "path" of a camera's or light's object:
///   {"interpolation": "smooth" | "linear" | "step", "at_end": "hold" | "loop" | "ping_pong",
///    "keys": [{"time": s, "position", "target", "up", "yfov_deg", "candela", …}, …]}
/// Keys of nodes: {"time": s, "translation", "rotation", "scale"}, with glTF's meaning; whoever knows the node sets the
/// channels' targets.
/// smooth: places run on Catmull-Rom splines, numbers and colours on monotone cubics, which never overshoot. Nothing where there is
/// none, or a faulty one.
std::optional<Clip> read_rig_path(const JsonDocument& json, const JsonValue& owner, const PathOwner& what,
                                  FaultList& faults);

}  // namespace laterna
