// What frames of one scene cost, drawn again and again.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "laterna/render.h"

namespace laterna::app {

/// A scene made ready, and what of it is drawn.
struct Subject {
  Renderer renderer;
  View view;
  RenderSettings settings;
  std::string
      depth_light;  ///< unless empty, only the depth map of this light is drawn, and `settings` count for nothing
};

/// Which frames are drawn, and how.
struct FrameSeries {
  int warm_up = 3, frames = 15;
  bool poses_anew =
      false;  ///< before each frame, geometry is carried to world space again, as when something moves
  double seconds_per_frame = 0;  ///< scene time that passes before each frame; posing is then what that costs
};

struct FrameCost {
  double pose_ms = 0;
  RenderStatistics drawing;
};

struct Timing {
  double median = 0, min = 0, max = 0;
};
Timing timing_of(std::vector<double> values);

class FrameCosts {
 public:
  void add(const FrameCost& cost) { costs_.push_back(cost); }
  [[nodiscard]] std::size_t count() const { return costs_.size(); }
  [[nodiscard]] const RenderStatistics& last() const { return costs_.back().drawing; }

  [[nodiscard]] std::vector<RenderStatistics> drawings() const;

  [[nodiscard]] Timing phase(double RenderStatistics::*phase) const;
  [[nodiscard]] Timing pose() const;
  /// Pose and drawing.
  [[nodiscard]] Timing frame() const;
  /// Medians, stage by stage.
  [[nodiscard]] StageTimes stages(StageTimes RenderStatistics::*stages) const;

 private:
  std::vector<FrameCost> costs_;
};

/// Draws the series. `picture`: where the last frame is written, or the depth map as a grey ramp; empty: nowhere.
Result<FrameCosts> draw_series(Subject& subject, const FrameSeries& series,
                               const std::filesystem::path& picture = {});

/// The most memory this process has held so far.
double peak_megabytes();

}  // namespace laterna::app
