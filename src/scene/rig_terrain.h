// "terrain" of a rig: height maps that become meshes.
#pragma once

#include <filesystem>

#include "laterna/scene.h"
#include "scene/fault_list.h"
#include "scene/json_document.h"

namespace laterna {

/// Reads one terrain and adds its mesh, material, texture and node to `scene`; its name is `name` where it has none. Files are
/// looked for in `folder`.
void read_rig_terrain(const JsonDocument& json, const JsonValue& value, const std::filesystem::path& folder,
                      const std::string& name, Scene& scene, FaultList& faults);

}  // namespace laterna
