// What of a scene is lost, or kept as it is, when its light is baked.
#pragma once

#include <vector>

#include "frame/frame.h"
#include "laterna/bake.h"
#include "laterna/scene.h"

namespace laterna::bake {

/// Adds to the scene's warnings, one for each kind of thing that light maps cannot hold: lights that move and films at an instant,
/// relief, glass, mirrors, metals. `is_baked`: by light. The scene still has its clips.
void note_what_is_lost(Scene& scene, const std::vector<bool>& is_baked, const BakeSettings& settings);

/// Adds a note where luxels are so large that hardly any area of light maps is surface, though the whole scene is few luxels across.
/// `used`: that part of the area. `density`: luxels per metre.
void note_small_scene(Scene& scene, double used, const frame::Bounds& bounds, double density);

}  // namespace laterna::bake
