// From where what lies behind a refracting surface is best looked at. docs/mirrors.md
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "laterna/view.h"
#include "light/pixel_box.h"

namespace laterna::light {

/// A flat surface behind which light goes slower.
struct RefractingPlane {
  glm::dvec3 normal_ws{0};  ///< unit, toward the eye
  double offset = 0;        ///< metres: normal · position = offset
  double index = 1;         ///< of what lies behind over that of what lies before; above 0
};

/// What of a plane a view sees in a picture.
struct SeenOfPlane {
  std::vector<glm::dvec3> corners_ws;  ///< of its parts
  glm::dvec2 middle{0};  ///< of the picture, whose corners are (0, 0), the upper left, and (1, 1)
};

struct RefractedView {
  View view;
  PixelBox box;      ///< what of its picture shows what lies behind those parts, with some about it
  double pixel = 0;  ///< metres across, at the middle of what is seen
};

/// A view, for a picture of as many pixels, that sees what lies behind the plane along straight rays as nearly as `from` does along
/// refracted ones: those through the middle of what is seen are the same, so that little of what the eye sees is hidden from it.
RefractedView refracted_view(const View& from, int width, int height, const RefractingPlane& plane,
                             const SeenOfPlane& seen);

}  // namespace laterna::light
