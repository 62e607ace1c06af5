// EXT_lights_image_based of a glTF file.
#pragma once

#include <optional>

#include "laterna/scene.h"
#include "scene/fault_list.h"
#include "scene/gltf_textures.h"
#include "scene/json_document.h"

namespace laterna::gltf {

/// Mips of one environment: of a side of 65536.
inline constexpr std::size_t kMaxSpecularMips = 17;

/// The environment that the default scene names; nothing where it names none, or when it is faulty.
std::optional<Environment> read_environment(const JsonDocument& json, Textures& textures, FaultList& faults);

}  // namespace laterna::gltf
