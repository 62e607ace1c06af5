// What a picture shows at each pixel, whatever light falls on it: where, and which way its triangle faces.
#pragma once

#include <vector>

#include "laterna/render.h"

namespace laterna::measure {

/// Pixels in rows from the top.
struct PictureSurface {
  int width = 0, height = 0;
  std::vector<int> object;  ///< −1: nothing
  std::vector<glm::vec3> position_ws;
  std::vector<glm::vec3> normal_ws;  ///< of the triangle, on the side that is seen
  std::vector<float> spacing;        ///< metres along the surface to the next pixel, at most
  std::vector<float> facing;         ///< cosine between normal and gaze

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  /// Whether two neighbouring pixels show one stretch of a surface, that may bend but has no crease or step.
  [[nodiscard]] bool is_continuous(std::size_t a, std::size_t b) const;
};

/// A pixel of which the scene with flat normals shows something else counts as nothing.
Result<PictureSurface> draw_picture_surface(const Renderer& renderer, const View& view,
                                            const RenderSettings& settings);

}  // namespace laterna::measure
