// OpenEXR files with all their channels.
#pragma once

#include "image/decoder.h"

namespace laterna::image {

/// Every channel of the first part, by name, on the display window, with the string attributes as metadata.
/// Nothing is thrown.
Result<LayeredImage> decode_exr_layers(const EncodedPicture& encoded);

}  // namespace laterna::image
