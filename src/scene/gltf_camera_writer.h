// cameras[] of a glTF file in the making.
#pragma once

#include "laterna/scene.h"
#include "scene/gltf_document.h"

namespace laterna::gltf {

/// In the scene's order. A frustum that glTF's own members do not say to the last bit is in LATERNA_lighting too.
void write_cameras(const Scene& scene, Document& document);

}  // namespace laterna::gltf
