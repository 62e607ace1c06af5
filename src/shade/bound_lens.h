// A lens that distorts, as the kernels read it.
#pragma once

#include "frame/slide_lens.h"

namespace laterna::shade {

/// Single precision of frame::SlideLens. Coordinates over the beam's image to directions, x to the right and y downward,
/// and from where they are distorted to, to coordinates over the slide.
struct BoundLens {
  float k1, k2, p1, p2, k3;
  float x_scale, x_offset, y_scale, y_offset;  // direction from image
  float s_scale, s_offset, t_scale, t_offset;  // slide from distorted direction
  float field_squared;                         // of the directions that are thrown to

  explicit BoundLens(const frame::SlideLens& lens);
};

}  // namespace laterna::shade
