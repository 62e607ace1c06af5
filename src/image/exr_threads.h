// OpenEXR's own threads.
#pragma once

namespace laterna::image {

/// Gives OpenEXR its threads, unless the program around us already has. That setting belongs to the process,
/// and is made once; how many of them one file uses is said when it is opened. Returns the number to open a
/// file with, when `threads` are asked for (0: all).
int exr_threads(int threads);

}  // namespace laterna::image
