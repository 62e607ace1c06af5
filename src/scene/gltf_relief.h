// LATERNA_relief of a glTF file's materials: docs/relief.md.
#pragma once

#include <memory>
#include <string_view>

#include "laterna/relief.h"
#include "scene/gltf_document.h"
#include "scene/gltf_textures.h"
#include "scene/json_document.h"

namespace laterna::gltf {

inline constexpr std::string_view kReliefExtension = "LATERNA_relief";

/// The relief of a material; null where it has none, or a faulty one. `name`: the material's, for messages.
std::shared_ptr<const Relief> read_relief(const JsonDocument& json, const JsonValue& material,
                                          Textures& textures, const std::string& name, FaultList& faults);

/// What the extension says beside its texture.
Json relief_json(const Relief& relief);

}  // namespace laterna::gltf
