// Rooms of rectangles with luxels on them.
#pragma once

#include <vector>

#include "bake/luxel.h"
#include "bake/radiosity.h"
#include "reference/shapes.h"

namespace laterna::reference {

/// Rectangles cut into equal luxels. Fronts are where cross(along, up) points.
struct LuxelRoom {
  struct Rectangle {
    glm::vec3 corner, along, up;
    int columns, rows;
    glm::vec3 reflectance{0};
    glm::vec3 exitance{0};
  };
  Scene scene;
  std::vector<bake::Luxel> luxels;
  std::vector<glm::vec3> direct_irradiance, exitance;

  /// Returns the index of its first luxel; rows from `corner` on. `opacity` below 1: a pane.
  std::size_t add(const Rectangle& rectangle, float opacity = 1, glm::vec3 color = glm::vec3(1));
  /// The six faces of a box, seen from inside or from outside, each n × n luxels: −x, +x, −y, +y, −z, +z.
  std::size_t add_box(glm::vec3 low, glm::vec3 high, int n, bool from_inside, glm::vec3 reflectance,
                      glm::vec3 face_exitance = glm::vec3(0));
};

/// A room with its frame, ready for solving; luxels have been given their triangles.
class LitRoom {
 public:
  explicit LitRoom(LuxelRoom room);
  Result<bake::Interreflection> solve(const RadiositySettings& settings = {}, int threads = 2,
                                      const Progress& progress = {}) const;
  /// Of luxels [first, first + count).
  static double mean(const bake::Interreflection& solved, std::size_t first, std::size_t count,
                     int channel = 0);

  LuxelRoom room;
  OwnedFrame owned;
  std::unique_ptr<trace::RayScene> rays;
};

}  // namespace laterna::reference
