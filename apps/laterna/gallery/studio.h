// What shines on balls from all around.
#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "laterna/image.h"

namespace laterna::app {

inline constexpr int kSkyHeight = 256;
/// A picture of all directions in the chart latlong.
Image sky_of(const std::function<glm::vec3(const glm::dvec3& direction)>& radiance);

/// A studio: a grey room, a bright window at the left, a red strip and a blue one at the right, a floor of boards.
glm::vec3 studio(const glm::dvec3& direction);

}  // namespace laterna::app
