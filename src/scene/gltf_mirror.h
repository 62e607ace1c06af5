// LATERNA_mirror on the materials of a glTF file, both ways. docs/LATERNA_mirror.md
#pragma once

#include <memory>
#include <string_view>

#include "laterna/mirrors.h"
#include "laterna/scene.h"
#include "scene/fault_list.h"
#include "scene/gltf_document.h"
#include "scene/json_document.h"

namespace laterna::gltf {

inline constexpr std::string_view kMirrorExtension = "LATERNA_mirror";

/// The mirror of a material; null where it has none. `alpha_mode`: the material's.
std::shared_ptr<const Mirror> read_mirror(const JsonDocument& json, const JsonValue& material,
                                          AlphaMode alpha_mode, FaultList& faults);

/// What the extension says.
Json mirror_json(const Mirror& mirror);

}  // namespace laterna::gltf
