// KHR_texture_transform's offset, rotation and scale, and the matrix that they make.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <optional>

namespace laterna {

struct TextureTransform {
  glm::dvec2 offset{0};
  double rotation = 0;  ///< radians, counter-clockwise as seen with v pointing down
  glm::dvec2 scale{1};
};

/// Rows of the 2×3 matrix (Texture::uv_from_mesh_uv): translation · rotation · scale.
std::array<float, 6> composed(const TextureTransform& transform);

/// A transform that makes the matrix: the very one, where such a transform is found among those that people type; else it is
/// off by rounding. Nothing for a matrix that shears.
std::optional<TextureTransform> decomposed(const std::array<float, 6>& matrix);

}  // namespace laterna
