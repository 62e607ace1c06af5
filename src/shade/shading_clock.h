// Where the time of shading goes. Reading the clock for every batch and light would cost some per cent: stages are timed
// in some of the tiles, and what all took is shared out by that.
#pragma once

#include "base/stopwatch.h"
#include "laterna/stages.h"

namespace laterna::shade {

class ShadingClock {
 public:
  void start_tile(int tile_x, int tile_y) {
    is_timed_ = (tile_x + 3 * tile_y) % kTilesPerTimed == 0 || stages_.total() == 0;
  }
  void start_stage() {
    if (is_timed_) watch_.start();
  }
  /// `drawing_ms`: of the lap, what drawing tiles of shadow maps took.
  void end_stage(Stage stage, double drawing_ms = 0) {
    if (is_timed_) stages_[stage] += watch_.lap_ms() - drawing_ms;
  }
  void add_drawing(double ms) { drawing_ms_ += ms; }

  /// Of all tiles so far.
  [[nodiscard]] double drawing_ms() const { return drawing_ms_; }
  /// `shading_ms`: what all tiles took, drawing included.
  [[nodiscard]] StageTimes stages(double shading_ms) const {
    return stages_.share_out(shading_ms - drawing_ms_);
  }

 private:
  static constexpr int kTilesPerTimed = 8;

  Stopwatch watch_;
  bool is_timed_ = false;
  StageTimes stages_;  // of the tiles that are timed
  double drawing_ms_ = 0;
};

}  // namespace laterna::shade
