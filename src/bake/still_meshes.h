// Meshes that wear skins or morph, as they stand at an instant.
#pragma once

#include <string>
#include <vector>

#include "laterna/scene.h"

namespace laterna::bake {

/// Puts the vertices of every mesh that wears a skin or morphs where they are now, once and for all: no mesh has a skin or
/// targets afterwards, and the scene no skins. Meshes with skins, which stand where their joints are, get nodes of their own
/// at the world's origin. Gives the names of the nodes that showed these meshes.
std::vector<std::string> stand_still(Scene& scene);

}  // namespace laterna::bake
