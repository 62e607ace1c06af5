// The textures, slides and intensity maps of the example scenes, painted by formula.
#pragma once

#include "laterna/image.h"

namespace laterna::examples {

Image paint_bricks(int side);
Image paint_boards(int side);
Image paint_marble(int side);
/// Wooden laths crossing, nothing between them (alpha).
Image paint_trellis(int side);

/// A lake between mountains at sunset, with a red sail left of the middle: what is up, left and right shows
/// at once.
Image paint_slide(int width, int height);
/// A rose window: twelve petals of coloured glass in lead, about a golden middle. Nothing around it (alpha).
Image paint_rose(int side);
/// A five-pointed star with soft edges, dimmer toward its points, point up. An intensity map: linear, one
/// channel.
Image paint_star(int side);

/// The beam of a dipped headlight for traffic on the right, 1024 × 320, an intensity map of 16 bits: white is
/// kLowBeamCandela. Tangents run from −0.8 to 0.8 from left to right and from 0.1 at the top to −0.4: with OpenCV's words
/// fx = fy = 640, cx = 511.5, cy = 63.5.
Image paint_low_beam();
inline constexpr float kLowBeamCandela = 24000;
/// An even beam, brightest in the middle, a tenth at the ends of the axes, nothing in the corners. An intensity map of 16
/// bits.
Image paint_beam(int width, int height);

}  // namespace laterna::examples
