// One picture of a scene, decoded.
#pragma once

#include "laterna/scene.h"

namespace laterna::frame {

/// Its pixels as they are stored; all are finite. The picture must be no film.
Result<std::shared_ptr<const Image>> decode_picture(const Picture& picture);

}  // namespace laterna::frame
