// meshes[] of a glTF file in the making.
#pragma once

#include <vector>

#include "laterna/scene.h"
#include "scene/gltf_document.h"

namespace laterna::gltf {

/// Gives the index in the file of each of the scene's meshes; −1 for one without triangles, which glTF does not know.
std::vector<int> write_meshes(const Scene& scene, Document& document);

}  // namespace laterna::gltf
