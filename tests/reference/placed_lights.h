// Lights put into a scene by a rule that knows nothing but its bounds.
#pragma once

#include <array>
#include <string>

#include "laterna/render.h"

namespace laterna::reference {

inline constexpr std::array<const char*, 3> kPlacedLights = {"placed sun", "placed spot", "placed point"};

/// In place of the scene's own lights: a sun 45° high, a spot near the top of the bounds that shines down and inward,
/// and a point light somewhat above their middle.
void place_lights(Scene& scene, const std::string& only);

/// Two views of a scene: as a whole from outside, and from one of its corners through its middle.
std::array<View, 2> placed_views(const Renderer& renderer, int width, int height);

}  // namespace laterna::reference
