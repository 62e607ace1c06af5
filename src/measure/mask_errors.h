// A technique's mask of one light against the truth, pixel by pixel.
#pragma once

#include "laterna/accuracy.h"
#include "measure/lit_pixels.h"

namespace laterna::measure {

/// All of ShadowAccuracy but what it cost and whose it is. `truth` and `mask`: α of each pixel of the grid.
/// Where there is more false shadow than could be asked about, every n-th pixel is, and answers for those up to the next.
ShadowAccuracy find_mask_errors(const LitPixels& pixels, const Mask& truth, const Mask& mask, int subpixels,
                                const TaskPool& pool);

}  // namespace laterna::measure
