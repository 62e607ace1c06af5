// Meshes: attributes, triangles.
#pragma once

#include "laterna/scene.h"
#include "scene/fault_list.h"

namespace laterna {

/// Reports every fault.
void check_meshes(const Scene& scene, FaultList& faults);

}  // namespace laterna
