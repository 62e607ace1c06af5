// Where to measure: grids of probes.
#pragma once

#include <string>
#include <vector>

#include "frame/frame.h"
#include "laterna/probes.h"

namespace laterna::render {

/// Renderer::probes_on_object().
Result<std::vector<Probe>> probes_on_object(const frame::Frame& frame, const std::string& object,
                                            double spacing);

}  // namespace laterna::render
