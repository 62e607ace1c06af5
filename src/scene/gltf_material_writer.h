// materials[] of a glTF file in the making.
#pragma once

#include "laterna/scene.h"
#include "scene/gltf_document.h"
#include "scene/gltf_picture_writer.h"

namespace laterna::gltf {

/// In the scene's order. Factors beyond what glTF allows are told as warnings, and written as the nearest that it does.
Result<void> write_materials(const Scene& scene, PictureWriter& pictures, Document& document);

}  // namespace laterna::gltf
