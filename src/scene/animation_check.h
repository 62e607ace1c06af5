// The rules that clips, skins and morph targets must meet.
#pragma once

#include "laterna/scene.h"
#include "scene/fault_list.h"

namespace laterna {

/// Reports every fault of what moves: references out of range, key times that do not rise, numbers that do not fit their
/// keys, lists of other lengths than the vertices. Indices of nodes to meshes and the like must be sound.
void check_animation(const Scene& scene, FaultList& faults);

}  // namespace laterna
