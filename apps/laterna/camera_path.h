// A way from camera to camera.
#pragma once

#include <span>

#include "laterna/view.h"

namespace laterna::app {

/// The view at `t` in [0, stops − 1]: at a whole number that stop, and between them a smooth way through all (Catmull and Rom, A
/// class of local interpolating splines, 1974, of positions, rotations and frusta). At least one stop.
View view_on_path(std::span<const View> stops, double t);

/// The view for a picture of that shape: as high as it is, and as wide as that makes it, about the same middle.
View with_aspect(View view, double aspect);

}  // namespace laterna::app
