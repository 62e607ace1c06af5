// What a picture shows at each pixel, whatever light falls on it.
#pragma once

#include <vector>

#include "laterna/render.h"

namespace laterna::measure {

/// Pixels in rows from the top.
struct SeenGeometry {
  LayeredImage
      unshadowed;  ///< R, G, B and so on: the picture without shadows, for what is shown around surfaces
  std::vector<float> object;  ///< as in id.object: −1 where nothing is
  std::vector<glm::vec3> position_ws;
  std::vector<glm::vec3> normal_ws;  ///< the shading's
};

/// `settings`: size, samples and shading.
Result<SeenGeometry> draw_geometry(const Renderer& renderer, const View& view, RenderSettings settings);

}  // namespace laterna::measure
