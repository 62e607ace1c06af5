// Views of a frame: through its cameras, of all of it, and with a light's eyes.
#pragma once

#include <string>

#include "frame/frame.h"
#include "laterna/view.h"

namespace laterna::render {

Result<View> camera_view(const frame::Frame& frame, const std::string& name, int width, int height);
View overview(const frame::Frame& frame, int width, int height);

}  // namespace laterna::render
