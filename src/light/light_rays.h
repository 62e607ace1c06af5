// Rays between points and a light: where they run, how far, and where they begin to count.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "frame/frame.h"

namespace laterna::light {

/// Where light comes from, as one point that may be at infinity: (position, 1), or (direction toward the light, 0).
glm::dvec4 homogeneous_light(const frame::PlacedLight& placed);

/// A light as rays toward it see it.
struct LightRays {
  explicit LightRays(const frame::PlacedLight& placed);

  /// Away from the light; a parallel one's of unit length, others' as long as the point is far from it.
  [[nodiscard]] glm::dvec3 away_at(const glm::dvec3& point_ws) const {
    return is_parallel ? forward_ws : point_ws - position_ws;
  }
  /// Metres along the axis from the near plane to the point; 1 where there is no such plane.
  [[nodiscard]] double beyond_near(const glm::dvec3& point_ws) const;
  /// Metres from the point along its ray to the light, or to the near plane; endless where parallel light has none; not
  /// above 0 where the point lies before it.
  [[nodiscard]] double length_at(const glm::dvec3& point_ws) const;
  /// Of unit length, toward the light; zero at the light itself.
  [[nodiscard]] glm::dvec3 toward_at(const glm::dvec3& point_ws) const;

  bool is_parallel;
  glm::dvec3 position_ws;  ///< of the light; of a parallel one, any point of its near plane's view
  glm::dvec3 forward_ws;   ///< unit: its axis; of a parallel light, the direction in which it shines
  bool has_near;           ///< casters, and parts of them, nearer than `near` along the axis do not count
  double near;
};

}  // namespace laterna::light
