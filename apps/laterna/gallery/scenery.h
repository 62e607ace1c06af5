// Scenes put together in code: objects, lights and where they stand.
#pragma once

#include <string>

#include "laterna/scene.h"
#include "solids.h"

namespace laterna::app {

/// Where a light or camera stands, and what it looks at.
struct Gaze {
  glm::dvec3 from{0}, to{0};
};

int add_picture(Scene& scene, std::string name, Image pixels);

/// A dull surface of one colour. `texture`: a picture on top of it, or −1.
int add_material(Scene& scene, std::string name, glm::vec3 color, int texture = -1, float roughness = 0.8F);
/// The object's node.
int add_object(Scene& scene, std::string name, Primitive primitive, int material);

/// Light from infinitely far, in the direction of the gaze.
Light& add_sun(Scene& scene, std::string name, Gaze gaze, glm::vec3 color);
/// A light that shines in a cone, as bright at any distance: what stands farther off is still to be seen.
Light& add_lamp(Scene& scene, std::string name, Gaze gaze, Angle outer_cone, glm::vec3 color);
/// A slide projector: `slide` is a picture of the scene.
Light& add_projector(Scene& scene, std::string name, Gaze gaze, Angle yfov, int slide);

/// A tiled floor at y = 0, `size` metres square. The object's node.
int add_floor(Scene& scene, float size = 8);
/// Light from everywhere, and a sky.
void set_mood(Scene& scene, float ambient);

}  // namespace laterna::app
