// Projectors whose slides are painted on surfaces, as the planner of shadows knows them: what one would light is where its
// slide comes to lie.
#pragma once

#include <vector>

#include "frame/frame.h"
#include "light/light_plan.h"

namespace laterna::light {

/// One for each of the frame's decals, numbered after its lights and photographs. What hides surfaces from them is found
/// as for their shadows (`of_picture`: for those that name no technique) where that is `none`, `map` or `raytraced`, and by
/// `exact` where it is any other, which may be soft or see only some surfaces.
std::vector<PlannedLight> make_decal_plan(const frame::Frame& frame, ShadowTechnique of_picture);

}  // namespace laterna::light
