// nodes[] and scenes[] of a glTF file in the making.
#pragma once

#include <vector>

#include "laterna/scene.h"
#include "scene/gltf_document.h"
#include "scene/gltf_light_writer.h"

namespace laterna::gltf {

/// In the scene's order. `meshes` are the file's indices of the scene's meshes.
Result<void> write_nodes(const Scene& scene, const std::vector<int>& meshes, LightWriter& lights,
                         Document& document);

}  // namespace laterna::gltf
