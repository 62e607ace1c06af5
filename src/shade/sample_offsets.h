// Where the samples of a pixel lie.
#pragma once

#include <vector>

namespace laterna::shade {

/// Sample positions of a pixel, in 1/256 pixel from its centre.
struct SampleOffset {
  int x = 0, y = 0;
};
/// Direct3D's standard patterns; the first is the nearest to the centre. count: 1, 2, 4, 8, 16. All of them are moved by
/// `jitter`, from −128 to 127, and what leaves the pixel on one side comes back on the other. `is_turned`: right is left then, for
/// pictures of mirrored views.
std::vector<SampleOffset> sample_offsets(int count, SampleOffset jitter, bool is_turned = false);

}  // namespace laterna::shade
