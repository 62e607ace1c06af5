// Photographs as the planner of shadows knows them: what a projector in a camera's place would light is what the camera sees.
#pragma once

#include <deque>
#include <vector>

#include "frame/frame.h"
#include "light/light_plan.h"

namespace laterna::light {

struct PhotographPlan {
  std::vector<PlannedLight> photographs;  // in the frame's order, numbered after its lights
  // What they refer to.
  std::deque<Light> lights;
  std::deque<frame::PlacedLight> placed;
};

PhotographPlan make_photograph_plan(const frame::Frame& frame, ShadowTechnique visibility);

/// The view of a photograph for a picture of its longest side at most `longest_side`.
ShadowView photograph_view(const frame::PlacedPhotograph& placed, int longest_side);

}  // namespace laterna::light
