// A glTF 2.0 or GLB file as a scene.
#pragma once

#include <filesystem>
#include <string>

#include "laterna/scene.h"
#include "scene/byte_source.h"

namespace laterna {

/// `file` stands in messages; files that the glTF refers to are looked for in `folder`. Only what the default
/// scene shows is read. A camera or light on several nodes becomes several, the further ones named after
/// their nodes.
Result<Scene> read_gltf(const ByteSource& source, const std::string& file,
                        const std::filesystem::path& folder);

}  // namespace laterna
