// Options for pictures at several times: --frames, --fps.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "laterna/result.h"
#include "laterna/video.h"

namespace laterna::app {

/// Pictures to draw: when, and into which file.
struct TimedOutput {
  double seconds = 0;
  std::string file;
};

struct FrameOptions {
  std::string frames, fps = "24", shutter;

  /// --frames, --fps, --shutter. The command has --time already (SceneOptions).
  void declare(CLI::App& command);
  [[nodiscard]] bool is_series() const { return !frames.empty(); }
  /// One picture at `time`, or one for each frame of the range with its number in place of the # of `output`, or all into `output`
  /// where that is a film. Frame k is at k / fps, to the nearest double. Error: what was typed is no range, or the file's name has no place for a number.
  [[nodiscard]] Result<std::vector<TimedOutput>> outputs(double time, const std::string& output) const;
  /// Seconds of --shutter; 0 without. Error: no number of seconds.
  [[nodiscard]] Result<double> shutter_seconds() const;
  /// --fps as films have it. Error: no ratio of whole numbers.
  [[nodiscard]] Result<VideoRate> video_rate() const;
};

}  // namespace laterna::app
