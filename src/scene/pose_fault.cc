// What is wrong with a pose that a caller has filled in.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "laterna/scene.h"

namespace laterna {

// Comparisons are written so that NaN fails.
std::string find_fault(const Pose& pose) {
  const glm::dvec3 at = glm::abs(pose.position_ws);
  if (!(std::max({at.x, at.y, at.z}) <= kMaxCoordinate) || at.y != at.y || at.z != at.z) {
    return "its position must be finite, and no farther than 1e9 m from the origin";
  }
  // An angle of a millionth of a radian is what rounding a matrix to single precision may leave.
  constexpr double kRounding = 1e-6;
  const glm::dmat3& rotation = pose.world_from_view_rotation;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double expected = i == j ? 1 : 0;
      if (std::abs(glm::dot(rotation[i], rotation[j]) - expected) <= kRounding) continue;
      return "the columns of its rotation must be perpendicular unit vectors";
    }
  }
  return glm::determinant(rotation) > 0 ? "" : "its rotation must be right-handed, not mirrored";
}

}  // namespace laterna
