// Frames of a series that are there already.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "frame_range.h"
#include "laterna/result.h"

namespace laterna::app {

/// Which of the outputs are there. Files are renamed into place when they are complete: what is there is whole.
std::vector<bool> find_finished(const std::vector<TimedOutput>& outputs);

/// Frames of other settings, another scene or another version of laterna must not end in one film. `draw_as` draws an output
/// anew into another file; the same input gives the same picture, bit for bit, so that any difference tells.
/// Error (bad_usage): the last frame that is there is not what would be drawn now.
Result<void> check_finished(const TimedOutput& last,
                            const std::function<Result<void>(const std::filesystem::path& file)>& draw_as);

}  // namespace laterna::app
