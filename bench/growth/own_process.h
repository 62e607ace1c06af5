// Runs a measurement in a process of its own: its peak memory is then its own, and nothing is left over from the one
// before.
#pragma once

#include <functional>

#include "laterna/result.h"
#include "laterna/stages.h"

namespace laterna::growth {

/// What a frame of one row took, medians over the frames of one process. Sent as bytes from process to process.
struct RowCost {
  double pose_ms = 0, frame_ms = 0;
  StageTimes maps, picture;
  double peak_mb = 0;  ///< filled in by run_in_own_process
};

/// Must be called before this process has started any thread.
Result<RowCost> run_in_own_process(const std::function<Result<RowCost>()>& measure);

}  // namespace laterna::growth
