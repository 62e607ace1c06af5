// Translation, rotation and scale in single precision, as EXT_mesh_gpu_instancing has them, and the matrices that they make.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

namespace laterna {

/// A unit quaternion, or nothing when there is no rotation in it.
std::optional<glm::dvec4> normalized_rotation(const glm::dvec4& rotation);

struct InstanceTransforms {
  std::vector<glm::vec3> translations, scales;
  std::vector<glm::vec4> rotations;
};

/// Those that make these very matrices; nothing when one of them is of another kind.
std::optional<InstanceTransforms> decomposed(const std::vector<glm::dmat4>& matrices);

}  // namespace laterna
