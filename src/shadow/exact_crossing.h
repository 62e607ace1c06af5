// Whether the way from a point to a light meets a triangle, decided in double precision, with no tolerance but the one
// that every technique keeps from the point itself.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "light/light_rays.h"

namespace laterna::shadow {

struct CornersOfTriangle {
  glm::vec3 a, b, c;
};
CornersOfTriangle corners_of(const frame::Frame& frame, TriangleId id);

struct Crossing {
  bool blocks = false;
  float b = 0, c = 0;  ///< weights of the second and third corner where it is met
};

/// Whose a way is that passes exactly through an edge: of both triangles that share it, so that nothing slips between, or
/// of one, so that nothing is met twice.
enum class OnEdge : std::uint8_t { of_both, of_one };

/// The sample at `position_ws`, from `nearest` metres toward the light up to the light or its near plane. Of two triangles
/// that share an edge both see the very same sign of it.
Crossing find_crossing(const light::LightRays& light, const glm::vec3& position_ws, float nearest,
                       const CornersOfTriangle& triangle, OnEdge on_edge = OnEdge::of_both);

/// Whether the triangle casts a shadow on the sample: it is crossed, and not in a hole.
bool darkens(const frame::Frame& frame, const light::LightRays& light, const glm::vec3& position_ws,
             float nearest, TriangleId id);

}  // namespace laterna::shadow
