// What a caller may ask for.
#pragma once

#include "laterna/render.h"

namespace laterna::render {

Result<void> check_options(const RendererOptions& options);
/// A scene time in seconds.
Result<void> check_time(double seconds);
/// Open for so many seconds about `middle`.
Result<void> check_shutter(double seconds, double middle);
Result<void> check_settings(const RenderSettings& settings, const View& view);

}  // namespace laterna::render
