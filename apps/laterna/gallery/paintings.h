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
/// What shows how sharp a slide is, three times side by side: bars, finer to the right, over white dots on black.
Image paint_focus_chart(int width, int height);
/// A white dot, `diameter` of the side across, in the middle of black.
Image paint_dot(int side, float diameter);
/// Frame `number` of `count` of a film's leader: a hand has swept that part of the dial, and as many dots stand below.
Image paint_leader(int width, int height, int number, int count);
/// A house front 4 wide and 3 high: windows with shutters of many colours on ochre plaster.
Image paint_house_front(int width, int height);
/// The beam of a dipped headlight for traffic on the right: an intensity map of kDippedBeam's shape, in units of its
/// peak. The cut-off is UN Regulation 112's: level, 1 % below the lamp, and rising by 15° to the right of the axis.
Image paint_dipped_beam(int width);
/// A round beam, brightest in the middle, a tenth half-way out, nothing from the sides on. An intensity map.
Image paint_round_beam(int side);
/// Of paint_dipped_beam(): tangents at the sides of the frame, right = −left.
struct BeamFrame {
  float right, bottom, top;
};
inline constexpr BeamFrame kDippedBeam = {0.6F, -0.25F, 0.125F};

/// A five-pointed star, point up, with soft edges. An intensity map: linear, one channel.
Image paint_star(int side);

}  // namespace laterna::app
