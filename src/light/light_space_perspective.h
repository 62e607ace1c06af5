// Light-space perspective shadow maps: Wimmer, Scherzer and Purgathofer, 2004. A perspective transform square to the light,
// so that light stays parallel and triangles stay triangles, makes texels fine toward the camera.
#pragma once

#include "light/light_plan.h"

namespace laterna::light {

/// The map of a directional light for a camera: on what it sees, with its warp where there is anything to gain. `camera`
/// null: the map of the whole scene.
ShadowView light_space_perspective_view(const frame::PlacedLight& placed, const frame::Frame& frame,
                                        const ShadowSettings& settings, const View* camera);

}  // namespace laterna::light
