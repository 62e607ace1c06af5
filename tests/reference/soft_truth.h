// What arrives from a light with a size: the mean over its points of what rays say of each.
#pragma once

#include <string>
#include <vector>

#include "laterna/render.h"

namespace laterna::reference {

/// α of light `name` at each pixel of a camera's picture, the mean over `points` places of its source, spread evenly. Each
/// is ray traced as a light of its own.
std::vector<float> soft_truth(const Scene& scene, const View& camera, const RenderSettings& settings,
                              const std::string& name, int points);

}  // namespace laterna::reference
