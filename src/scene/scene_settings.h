// What can be said of a scene as a whole and of its nodes, in rigs and in the glTF extension LATERNA_lighting.
#pragma once

#include <optional>

#include "laterna/scene.h"
#include "scene/json_object.h"

namespace laterna {

/// "ambient", "background" and "shading".
void read_scene_settings(const JsonDocument& json, JsonObject& object, FaultList& faults, Scene& scene);

/// "casts_shadow", "receives_shadow" and "visible"; what is not said is not changed.
struct NodeFlags {
  std::optional<bool> casts_shadow, receives_shadow, visible;

  void apply(Node& node) const;
};
NodeFlags read_node_flags(JsonObject& object);

}  // namespace laterna
