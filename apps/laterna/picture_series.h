// The pictures of `laterna render`, one after the other: drawn, written or gathered in a film while the next is drawn, taken
// up again where they were broken off.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "frame_range.h"
#include "interruption.h"
#include "laterna/video.h"
#include "still_drawer.h"
#include "write_queue.h"

namespace laterna::app {

class PictureSeries {
 public:
  /// One picture or many. `film`: of the output, where that is a film. All are read until draw() ends.
  PictureSeries(const RenderOptions& options, const RenderRequest& request,
                const std::vector<TimedOutput>& outputs, const VideoOptions& film)
      : options_(options), request_(request), outputs_(outputs), film_options_(film) {}

  /// The exit code. `view`: of the first picture. `load_ms`: milliseconds until now, for --json. Ended by a signal, does not come back.
  int draw(Renderer& renderer, const View& view, double load_ms);

 private:
  // What there is to tell of a frame in JSON, whose move the library does not declare free of exceptions.
  struct FrameReport {  // NOLINT(bugprone-exception-escape)
    nlohmann::json json;
    double write_ms = 0;
    bool is_skipped = false, is_drawn = false;
  };

  // The series as the camera goes through it.
  struct Course {
    View first;                         // view
    double first_time = 0;              // of its first frame
    double duration = 0;                // from the first frame to where the next after the last would be
    double frame_time = 0, turned = 0;  // of the frame that is drawn; how far it has come, 0 to 1
  };

  Result<void> skip_finished(Renderer& renderer);
  Result<void> draw_frames(Renderer& renderer);
  Result<FinishedPicture> draw_frame(Renderer& renderer, std::size_t index, const Progress& progress,
                                     FrameReport& told);
  Result<void> write(FinishedPicture picture);
  [[nodiscard]] Result<View> view_now(const Renderer& renderer) const;
  int close(const Result<void>& drawn);
  void keep_incomplete_film();

  const RenderOptions& options_;
  const RenderRequest& request_;
  const std::vector<TimedOutput>& outputs_;
  const VideoOptions& film_options_;
  std::optional<StillDrawer> drawer_;
  std::vector<FrameReport> told_;    // of each output
  std::optional<VideoWriter> film_;  // used by the thread that writes, while there is one
  const Interruption* interruption_ = nullptr;
  int threads_ = 0;
  double load_ms_ = 0;
  glm::dvec3 turntable_centre_ws_{0};  // of the scene as it is in the first picture
  Course course_;
};

}  // namespace laterna::app
