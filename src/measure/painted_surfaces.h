// Colours in the place of surfaces.
#pragma once

#include <functional>

#include "laterna/render.h"

namespace laterna::measure {

/// What a pixel of a picture shows.
struct SeenSurface {
  glm::dvec3 point_ws{0};
  std::uint32_t object = 0;  // as the frame counts them
  int x = 0, y = 0;
};

/// What the camera sees, and a colour for each pixel of it, shaded as if a lamp stood at the camera. Channels R, G, B.
Result<LayeredImage> paint_surfaces(const Renderer& renderer, const View& camera,
                                    const RenderSettings& settings,
                                    const std::function<glm::dvec3(const SeenSurface& seen)>& find_color);

}  // namespace laterna::measure
