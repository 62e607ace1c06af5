#include "scene/instance_transforms.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <span>

#include "laterna/animation.h"

namespace laterna {
namespace {

// The quaternion of a rotation matrix (K. Shoemake, Quaternion Calculus and Fast Animation, 1987): from its largest component,
// so that no digits are lost.
glm::dvec4 quaternion_of(const glm::dmat3& m) {
  const double squares[4] = {1 + m[0][0] - m[1][1] - m[2][2], 1 - m[0][0] + m[1][1] - m[2][2],
                             1 - m[0][0] - m[1][1] + m[2][2], 1 + m[0][0] + m[1][1] + m[2][2]};
  int largest = 0;
  for (int i = 1; i < 4; ++i) {
    if (squares[i] > squares[largest]) largest = i;
  }
  const double twice = std::sqrt(squares[largest]), quarter = 0.5 / twice;
  const double x_y = m[0][1] + m[1][0], x_z = m[0][2] + m[2][0], y_z = m[1][2] + m[2][1];
  const double w_x = m[1][2] - m[2][1], w_y = m[2][0] - m[0][2], w_z = m[0][1] - m[1][0];
  switch (largest) {
    case 0:
      return {twice / 2, x_y * quarter, x_z * quarter, w_x * quarter};
    case 1:
      return {x_y * quarter, twice / 2, y_z * quarter, w_y * quarter};
    case 2:
      return {x_z * quarter, y_z * quarter, twice / 2, w_z * quarter};
    default:
      return {w_x * quarter, w_y * quarter, w_z * quarter, twice / 2};
  }
}

struct StoredTransform {
  glm::vec3 translation, scale;
  glm::vec4 rotation;
};

// The quaternion that was stored need not be of length 1 to the last digit: those are tried whose largest component is the next
// few numbers.
std::optional<StoredTransform> with_rotation_near(const glm::dmat4& matrix, const glm::dvec4& rotation,
                                                  const glm::vec3& scale) {
  constexpr int kTries = 24;
  int largest = 0;
  for (int i = 1; i < 4; ++i) {
    if (std::abs(rotation[i]) > std::abs(rotation[largest])) largest = i;
  }
  const StoredTransform transform{glm::vec3(matrix[3]), scale, {}};
  float low = static_cast<float>(rotation[largest]), high = low;
  for (int i = 0; i < kTries; ++i) {
    for (const float component : {low, high}) {
      const glm::vec4 stored(rotation * (component / rotation[largest]));
      const auto unit = normalized_rotation(glm::dvec4(stored));
      if (unit && to_matrix({glm::dvec3(transform.translation), *unit, glm::dvec3(scale)}) == matrix)
        return StoredTransform{transform.translation, scale, stored};
    }
    low = std::nextafter(low, 0.0F);
    high = std::nextafter(high, 2 * high);
  }
  return std::nullopt;
}

std::optional<StoredTransform> decomposed(const glm::dmat4& matrix) {
  const glm::dmat3 linear(matrix);
  const bool is_mirrored = glm::determinant(linear) < 0;
  // Which axis a mirror turns round cannot be seen from the matrix: any may, or all.
  constexpr int kNone[] = {0}, kOdd[] = {1, 2, 4, 7};
  for (const int mirrored : is_mirrored ? std::span<const int>(kOdd) : std::span<const int>(kNone)) {
    glm::vec3 scale;
    glm::dmat3 rotation(1.0);
    for (int axis = 0; axis < 3; ++axis) {
      const double sign = (mirrored >> axis & 1) != 0 ? -1 : 1;
      const double length = sign * std::sqrt(glm::dot(linear[axis], linear[axis]));
      if (length == 0) return std::nullopt;
      scale[axis] = static_cast<float>(length);
      rotation[axis] = linear[axis] / length;
    }
    if (const auto found = with_rotation_near(matrix, quaternion_of(rotation), scale)) return found;
  }
  return std::nullopt;
}

}  // namespace

std::optional<glm::dvec4> normalized_rotation(const glm::dvec4& rotation) {
  const double length = std::sqrt(glm::dot(rotation, rotation));
  if (!(length > 1e-9) || !std::isfinite(length)) return std::nullopt;
  return rotation / length;
}

std::optional<InstanceTransforms> decomposed(const std::vector<glm::dmat4>& matrices) {
  InstanceTransforms transforms;
  for (const glm::dmat4& matrix : matrices) {
    const std::optional<StoredTransform> transform = decomposed(matrix);
    if (!transform) return std::nullopt;
    transforms.translations.push_back(transform->translation);
    transforms.rotations.push_back(transform->rotation);
    transforms.scales.push_back(transform->scale);
  }
  return transforms;
}

}  // namespace laterna
