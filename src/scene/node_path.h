// Paths that rigs give to nodes of the scene.
#pragma once

#include <optional>
#include <string>

#include "laterna/scene.h"

namespace laterna {

/// The translation, rotation and scale that make this matrix, up to rounding; nothing where it shears or flattens. A
/// mirroring matrix has a negative scale along X.
std::optional<Transform> decompose(const glm::dmat4& matrix);

/// Gives the scene a clip whose channels move the one node of that name (or whose mesh has it). Returns what is in the way,
/// empty: nothing.
std::string add_node_path(Scene& scene, const std::string& name, Clip path);

}  // namespace laterna
