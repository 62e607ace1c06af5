// The textures, slides and intensity maps of the gallery, painted by formula, without libm: the same on every machine.
#pragma once

#include <functional>
#include <glm/vec2.hpp>

#include "laterna/image.h"

namespace laterna::app {

/// Square tiles of two near greys, 4 × 4 of them.
Image paint_tiles(int side);
/// Wooden boards.
Image paint_boards(int side);
/// A coat of many colours for the mannequins: bands and lozenges.
Image paint_coat(int side);

/// A slide: the sun over mountains, a lake and a boat with a red sail left of the middle, so that what is up, left and
/// right shows at once.
Image paint_lake(int width, int height);
/// A grid of 16 × 9 cells in a frame. `bend` takes a place of the picture, 0…1 from its top-left corner, to the place of the
/// grid that is painted there; outside the grid it is black.
Image paint_grid(int width, int height, const std::function<glm::vec2(glm::vec2)>& bend);
/// A five-pointed star, point up, with soft edges. An intensity map: linear, one channel.
Image paint_star(int side);

}  // namespace laterna::app
