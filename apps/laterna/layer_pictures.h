// Layers made visible: one PNG each, for people without an OpenEXR viewer.
#pragma once

#include <filesystem>

#include "laterna/image.h"

namespace laterna::app {

/// Writes each layer of `image` (channels "name.R", "name.G", "name.B" and so on) to folder/name.png: radiance times the
/// exposure, fractions as grey, depth as a ramp (near light, far dark), normals and slide coordinates as colour, object ids
/// as colours that tell neighbours apart, positions as colour within their bounds. Makes the folder.
Result<void> write_layer_pictures(const LayeredImage& image, const std::filesystem::path& folder,
                                  float exposure);

}  // namespace laterna::app
