// What a file says of how its picture was made: enough to make it again, nothing of the machine or the day.
#pragma once

#include <map>
#include <string>

#include "frame/frame.h"
#include "laterna/render.h"

namespace laterna::render {

std::map<std::string, std::string> describe(const RenderSettings& settings, const View& view,
                                            const frame::Frame& frame);

}  // namespace laterna::render
