// What --debug shows in a picture's stead.
#pragma once

#include <optional>
#include <string>

#include "laterna/measure.h"

namespace laterna::app {

enum class DebugKind : std::uint8_t { depth, project_depth, cascades, texel_density, pairs };

struct DebugChoice {
  DebugKind kind = DebugKind::depth;
  std::string light;  ///< empty: the first one to which it applies
};

/// For --help.
const char* describe_debug_choices();

/// From "depth", or "project-depth", "cascades", "texel-density" or "pairs", each with or without ":LIGHT".
Result<DebugChoice> parse_debug_choice(const std::string& text);

/// The picture, and its legend. `statistics`: of drawing the depth layer, where that is shown.
Result<ExplainedPicture> draw_debug_picture(const Renderer& renderer, const View& camera,
                                            const RenderSettings& settings, const DebugChoice& choice,
                                            RenderStatistics& statistics);

}  // namespace laterna::app
