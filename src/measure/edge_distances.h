// How far the edges of one mask lie from those of another, in pixels.
#pragma once

#include <cstddef>

#include "measure/lit_pixels.h"

namespace laterna::measure {

struct EdgeDistances {
  std::size_t edges = 0;
  double median = 0, p99 = 0, mean = 0;
};
/// An edge runs between two neighbouring pixels of one surface of which one is lit. Each edge of either mask is as far off as
/// the nearest edge of the other on the same object, and no farther than kFarthestEdge pixels of the picture.
/// `subpixels`: how many pixels of the grid make one of the picture.
EdgeDistances find_edge_distances(const LitPixels& pixels, const Mask& truth, const Mask& mask,
                                  int subpixels);

}  // namespace laterna::measure
