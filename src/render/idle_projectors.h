// Projectors that shine past everything.
#pragma once

#include <string>
#include <vector>

#include "frame/frame.h"

namespace laterna::render {

/// Names of projectors whose beam holds no cluster's bounds. A projector whose slide goes on beyond its frame is none of
/// them; one whose beam holds a corner of some bounds and no surface is not found.
std::vector<std::string> idle_projectors(const frame::Frame& frame);

}  // namespace laterna::render
