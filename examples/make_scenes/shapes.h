// The solids of the example scenes.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "laterna/scene.h"

namespace laterna::examples {

/// A flat rectangle of `size` metres around `centre`, spanned by unit vectors; the front is where `right` ×
/// `up` points. The texture repeats every `metres_per_tile`.
Primitive rectangle(glm::vec3 centre, glm::vec3 right, glm::vec3 up, glm::vec2 size, float metres_per_tile);

Primitive box(glm::vec3 low, glm::vec3 high);

/// A radius at a height: a point of the outline of a turned piece.
struct Turning {
  float radius, height;
};
/// A piece turned on the lathe, around +Y through `foot`, its outline a smooth curve through `corners`. Two
/// corners at the same place make a sharp edge.
Primitive lathe(glm::vec3 foot, const std::vector<Turning>& corners, int segments);

/// A ball of `rings` × 2 · `rings` faces.
Primitive ball(glm::vec3 centre, float radius, int rings);

/// A ring that leans: its axis is `axis`.
Primitive ring(glm::vec3 centre, glm::vec3 axis, float radius, float tube, int segments);

/// Appends `more` to `primitive`.
void append(Primitive& primitive, const Primitive& more);

}  // namespace laterna::examples
