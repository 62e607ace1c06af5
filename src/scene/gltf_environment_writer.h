// The environment of a glTF file in the making.
#pragma once

#include "scene/gltf_document.h"
#include "scene/gltf_picture_writer.h"

namespace laterna::gltf {

/// Of the file's scene, which must be there already, by EXT_lights_image_based. That holds filtered environments alone
/// (filter_environment()); others, and what it has no members for, are told as warnings.
Result<void> write_environment(const Scene& scene, PictureWriter& pictures, Document& document);

}  // namespace laterna::gltf
