// What a caller may ask for.
#pragma once

#include "laterna/render.h"

namespace laterna::render {

Result<void> check_options(const RendererOptions& options);
Result<void> check_settings(const RenderSettings& settings, const View& view);

}  // namespace laterna::render
