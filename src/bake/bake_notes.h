// What of a scene is lost, or kept as it is, when its light is baked.
#pragma once

#include <vector>

#include "laterna/bake.h"
#include "laterna/scene.h"

namespace laterna::bake {

/// Adds to the scene's warnings, one for each kind of thing that light maps cannot hold: lights that move and films at an instant,
/// relief, glass, mirrors, metals. `is_baked`: by light. The scene still has its clips.
void note_what_is_lost(Scene& scene, const std::vector<bool>& is_baked, const BakeSettings& settings);

}  // namespace laterna::bake
