// Lights, with their lenses, lamps and shadows.
#pragma once

#include "laterna/scene.h"
#include "scene/fault_list.h"

namespace laterna {

/// Reports every fault.
void check_lights(const Scene& scene, FaultList& faults);

}  // namespace laterna
