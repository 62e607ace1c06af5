// What shines from all around, and everything of the scene as a whole.
#pragma once

#include "laterna/scene.h"
#include "scene/fault_list.h"

namespace laterna {

/// Reports every fault.
void check_surroundings(const Scene& scene, FaultList& faults);

}  // namespace laterna
