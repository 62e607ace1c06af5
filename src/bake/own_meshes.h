// Meshes that are shown in several places, taken apart: each place has its own light.
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "laterna/scene.h"

namespace laterna::bake {

/// An instance of a mesh in the world.
struct PlacedMesh {
  std::size_t mesh = 0;
  glm::dmat4 world_from_mesh{1.0};
  std::string name;  ///< of its node
};

/// Gives every instance a node and a mesh of its own; what is invisible to cameras is not among the results. Geometry of a
/// mesh that is shown once is not copied. Nothing wears a skin or morphs: stand_still().
std::vector<PlacedMesh> take_apart(Scene& scene);

}  // namespace laterna::bake
