// What is to be drawn: the options of `laterna render`, read and checked.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "debug_picture.h"
#include "false_color.h"
#include "frame_range.h"
#include "laterna/render.h"
#include "render_options.h"

namespace laterna::app {

struct RenderRequest {
  RenderSettings settings;
  float exposure = 1;                   ///< 0: automatic
  std::optional<glm::vec3> background;  ///< behind the scene, where one was given
  std::optional<DebugChoice> debug;
  std::optional<FalseColorChoice> false_color;
  double shutter = 0;  ///< seconds

  /// Rather than explaining it.
  [[nodiscard]] bool shows_light() const { return !debug && !false_color; }
};

/// Error (bad_usage): options that say nothing, or do not go together.
Result<RenderRequest> parse_request(const RenderOptions& options);

/// Whether what is asked for can be written, before what takes long. `film` is filled in where a film is asked for.
Result<void> check_output(const RenderOptions& options, const RenderSettings& settings,
                          const std::vector<TimedOutput>& outputs, VideoOptions& film);

}  // namespace laterna::app
