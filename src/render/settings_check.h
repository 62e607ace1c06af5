// What a caller may ask for.
#pragma once

#include "frame/frame.h"
#include "laterna/render.h"

namespace laterna::render {

Result<void> check_options(const RendererOptions& options);
/// A scene time in seconds.
Result<void> check_time(double seconds);
Result<void> check_settings(const RenderSettings& settings, const View& view);
/// Whether all lights that name no technique of their own can have this one.
Result<void> check_technique(ShadowTechnique technique, const frame::Frame& frame);

}  // namespace laterna::render
