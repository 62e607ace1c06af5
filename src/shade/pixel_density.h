// How finely a projector draws on a surface.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "frame/frame.h"

namespace laterna::shade {

/// Projector pixels per metre along a surface.
class PixelDensity {
 public:
  /// Nothing where the light is no projector, or is told neither a slide nor its panel's pixels.
  static std::optional<PixelDensity> of(const frame::PlacedLight& placed);

  /// In the direction along the surface in which the pixels are sparsest: the smaller singular value of the change of
  /// pixel coordinates along the tangent plane. 0 outside the frame, behind the lens, and on a surface that is turned
  /// away. `normal_ws` of unit length.
  [[nodiscard]] float at(const glm::dvec3& point_ws, const glm::dvec3& normal_ws) const;

 private:
  PixelDensity() = default;
  glm::dvec4 s_row_{0}, t_row_{0}, w_row_{0};  // of image_from_world
  double width_ = 0, height_ = 0;              // pixels
  glm::dvec3 position_ws_{0}, forward_ws_{0};
  bool is_parallel_ = false;
  double nearest_ = 0;  // metres along the axis
  std::optional<frame::SlideLens> lens_;
};

}  // namespace laterna::shade
