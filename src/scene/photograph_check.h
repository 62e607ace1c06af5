// Cameras and photographs.
#pragma once

#include "laterna/scene.h"
#include "scene/fault_list.h"

namespace laterna {

/// Reports every fault.
void check_cameras(const Scene& scene, FaultList& faults);

}  // namespace laterna
