// OpenCV's lens distortion, written from its documentation (calib3d, "Detailed description") term by term, in double.
#pragma once

#include <glm/vec2.hpp>

namespace laterna::reference {

/// In OpenCV's order.
struct OpenCvLens {
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
};

/// As projectPoints has it, without the camera matrix: x to the right, y downward.
glm::dvec2 project(const OpenCvLens& lens, glm::dvec2 ideal);

/// As undistortPoints has it: the fixed-point iteration, until it stands still. For mild lenses.
glm::dvec2 unproject(const OpenCvLens& lens, glm::dvec2 seen);

}  // namespace laterna::reference
