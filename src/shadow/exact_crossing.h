// Whether the way from a point to a light meets a triangle, decided in double precision, with no tolerance but the one
// that every technique keeps from the point itself.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "light/light_plan.h"

namespace laterna::shadow {

/// A light as rays toward it see it.
struct LightRays {
  explicit LightRays(const frame::PlacedLight& placed);

  bool is_parallel;
  glm::dvec3 position_ws;  ///< of the light; of a parallel one, any point of its near plane's view
  glm::dvec3 forward_ws;   ///< unit: its axis; of a parallel light, the direction in which it shines
  /// Casters nearer than this along the axis do not count; where there is no such plane it does not either.
  bool has_near = false;
  double near = 0;
};

struct CornersOfTriangle {
  glm::vec3 a, b, c;
};

struct Crossing {
  bool blocks = false;
  float b = 0, c = 0;  ///< weights of the second and third corner where it is met
};

/// Whose a way is that passes exactly through an edge: of both triangles that share it, so that nothing slips between, or
/// of one, so that nothing is met twice.
enum class OnEdge : std::uint8_t { of_both, of_one };

/// The sample at `position_ws`, from `nearest` metres toward the light up to the light or its near plane. Of two triangles
/// that share an edge both see the very same sign of it.
Crossing find_crossing(const LightRays& light, const glm::vec3& position_ws, float nearest,
                       const CornersOfTriangle& triangle, OnEdge on_edge = OnEdge::of_both);

}  // namespace laterna::shadow
