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
/// A five-pointed star with soft edges, dimmer toward its points, point up. An intensity map: linear, one
/// channel.
Image paint_star(int side);

}  // namespace laterna::examples
