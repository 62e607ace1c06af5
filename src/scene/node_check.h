// Nodes: the tree that they form, and where it places what hangs on them.
#pragma once

#include "laterna/scene.h"
#include "scene/fault_list.h"

namespace laterna {

/// Reports every fault. What the tree of nodes leads to is looked at only where nothing has been at fault so far.
void check_nodes(const Scene& scene, FaultList& faults);

}  // namespace laterna
