// Lights that the technique asked for the whole picture cannot serve.
#pragma once

#include <string>
#include <vector>

#include "laterna/scene.h"

namespace laterna::app {

/// The names of those that are on, name no technique of their own and keep `map` instead.
std::vector<std::string> unserved_lights(const Scene& scene, ShadowTechnique technique);
/// Says on standard error which they are and why.
void tell_unserved_lights(const Scene& scene, ShadowTechnique technique);

}  // namespace laterna::app
