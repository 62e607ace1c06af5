// A projector's lens that distorts: where its slide is thrown, and how much that is.
#pragma once

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "laterna/scene.h"

namespace laterna::frame {

/// Between the frame of an ideal lens and the picture that a distorting one throws, which bulges or shrinks: shadows,
/// culling and light's-eye views look through the beam, a frustum about that whole picture.
///
/// Only the beam's image coordinates are mapped to the slide, through directions as they leave the middle of the lens. So
/// a view that is sheared, to look through another point of the lens at the same plane in focus, needs no other map.
struct SlideLens {
  LensDistortion distortion;
  Projection frame, beam;
  double field = kWidestLensField;  ///< lens_field() of `distortion`
  double area = 0;                  ///< of the picture at 1 m, m²
  double solid_angle = 0;           ///< of the picture, steradians

  /// The scene must have passed validate(): the lens throws the whole frame.
  SlideLens(const LensDistortion& distortion, const Projection& frame);

  /// Slide coordinates (s, t), (0, 0) the top-left corner, of a point with image coordinates in the beam. Nothing where
  /// the lens throws nothing, whatever is on the slide or around it.
  [[nodiscard]] std::optional<glm::dvec2> slide_from_beam(glm::dvec2 image) const;
  /// Its derivative: columns are by image.x and by image.y.
  [[nodiscard]] glm::dmat2 slide_by_beam(glm::dvec2 image) const;
};

}  // namespace laterna::frame
