// LATERNA_light_map on the materials of a glTF file, both ways. docs/LATERNA_light_map.md
#pragma once

#include <string_view>

#include "laterna/scene.h"
#include "scene/gltf_picture_writer.h"
#include "scene/gltf_textures.h"

namespace laterna::gltf {

inline constexpr std::string_view kLightMapExtension = "LATERNA_light_map";

/// What the extension of a material says, where it has one.
void read_light_map(const JsonDocument& json, const JsonValue& material, Textures& textures,
                    FaultList& faults, LightMap& light_map);

/// Adds the extension to the JSON of a material. Error: a picture that cannot be read.
Result<void> write_light_map(const LightMap& light_map, PictureWriter& pictures, Document& document,
                             Json& material);

}  // namespace laterna::gltf
