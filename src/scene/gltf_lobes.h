// KHR_materials_clearcoat, _sheen, _specular, _ior, _anisotropy, _iridescence, _transmission and _volume.
#pragma once

#include <functional>

#include "laterna/scene.h"
#include "scene/gltf_document.h"
#include "scene/gltf_textures.h"

namespace laterna::gltf {

/// Those of a material of a file. Factors outside their range are limited, with a warning.
void read_lobes(const JsonDocument& json, const JsonValue& material, Textures& textures, FaultList& faults,
                Material& result);

/// `set_texture(extension, member, texture)` writes a set texture.
void write_lobes(
    const Material& material, Document& document, Json& json,
    const std::function<void(Json& object, const char* name, const Texture& texture)>& set_texture);

}  // namespace laterna::gltf
