// Where projectors' pictures land, how large they are there, and how bright.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "laterna/render.h"

namespace laterna {

/// A projector's picture on the surface that the middle of its slide meets first, which is taken to be flat. World space,
/// metres.
struct ThrownPicture {
  std::string light;          ///< its name
  glm::dvec3 middle_ws{0};    ///< where the middle of the slide lands
  glm::dvec3 normal_ws{0};    ///< of the surface there, toward the projector, of length 1
  double throw_distance = 0;  ///< from the lens to there, along the projector's axis
  Angle incidence;            ///< between the normal and the way to the lens: 0 is square-on
  /// Of the slide: top-left, top-right, bottom-right, bottom-left. Nothing where a corner does not meet that plane.
  std::optional<std::array<glm::dvec3, 4>> corners_ws;
  /// Lengths of the picture's middle row and middle column on that plane. Nothing without corners.
  std::optional<glm::dvec2> size;
  /// Of the panel (Light::panel_width), or the slide; 0: neither is known.
  int pixels_across = 0, pixels_down = 0;
  /// `size` over these pixels: the mean distance between their middles. Nothing without either.
  std::optional<glm::dvec2> pixel_pitch;
  /// Of white (of an intensity map: of its middle) at `middle_ws`, on that plane, from this projector alone and with
  /// nothing in the way.
  double lux = 0;
};

/// Nothing: the middle of its slide meets no surface. Error: no projector of that name that is on.
Result<std::optional<ThrownPicture>> find_thrown_picture(const Renderer& renderer,
                                                         const std::string& projector);

}  // namespace laterna
