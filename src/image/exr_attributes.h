// A look at an OpenEXR header before OpenEXR reads it.
#pragma once

#include "image/decoder.h"

namespace laterna::image {

/// OpenEXR fills the memory that an attribute claims, up to 2 GB, before it reads the value. This finds the
/// attributes whose claim is beyond the end of the file, and those whose size is not their type's, after
/// which the reader and this check would no longer look at the same places.
Result<void> check_exr_attributes(const EncodedPicture& encoded);

}  // namespace laterna::image
