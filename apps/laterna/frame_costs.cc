#include "frame_costs.h"

#include <algorithm>
#include <chrono>

#include <sys/resource.h>

#include "laterna/measure.h"

namespace laterna::app {
namespace {

template <class ValueOf>
Timing timing_over(const std::vector<FrameCost>& costs, ValueOf value_of) {
  std::vector<double> values;
  values.reserve(costs.size());
  for (const FrameCost& cost : costs) values.push_back(value_of(cost));
  return timing_of(std::move(values));
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// Puts what moves where it is that much later.
Result<double> go_on(Renderer& renderer, double seconds) {
  const auto start = std::chrono::steady_clock::now();
  if (Result<int> set = renderer.set_time(renderer.time() + seconds); !set)
    return tl::unexpected(set.error());
  return milliseconds_since(start);
}

// Sets a node that carries a mesh where it is.
Result<double> pose_anew(Renderer& renderer) {
  const std::vector<Node>& nodes = renderer.scene().nodes;
  const auto carrier = std::find_if(nodes.begin(), nodes.end(), [](const Node& n) { return n.mesh >= 0; });
  if (carrier == nodes.end()) return 0;
  const glm::dmat4 place = carrier->parent_from_node;
  const auto start = std::chrono::steady_clock::now();
  if (Result<void> set = renderer.set_transform(static_cast<int>(carrier - nodes.begin()), place); !set) {
    return tl::unexpected(set.error());
  }
  return milliseconds_since(start);
}

Result<double> pose(Renderer& renderer, const FrameSeries& series) {
  if (series.seconds_per_frame != 0) return go_on(renderer, series.seconds_per_frame);
  return series.poses_anew ? pose_anew(renderer) : 0;
}

// Draws a subject into memory of its own.
class Painter {
 public:
  explicit Painter(const Subject& subject) : subject_(subject) {
    if (!subject.depth_light.empty()) return;
    image_ = Image(subject.settings.width, subject.settings.height, 3, PixelType::u8, Transfer::srgb);
    const auto row = static_cast<std::size_t>(subject.settings.width) * 3;
    target_.color8 = ColorTarget8{image_.values<std::uint8_t>().data(), 3, row, 1};
  }

  Result<RenderStatistics> draw() {
    if (subject_.depth_light.empty()) {
      return subject_.renderer.render_into(subject_.view, subject_.settings, target_);
    }
    RenderStatistics statistics;
    Result<LayeredImage> map = subject_.renderer.depth_map(subject_.depth_light, 0, &statistics);
    if (!map) return tl::unexpected(map.error());
    depth_ = std::move(*map);
    return statistics;
  }

  [[nodiscard]] Result<void> write(const std::filesystem::path& file) const {
    if (subject_.depth_light.empty()) return write_image(image_, file);
    const Result<LayeredImage> ramp = depth_picture(depth_);
    if (!ramp) return tl::unexpected(ramp.error());
    return write_image(*ramp, file);
  }

 private:
  const Subject& subject_;
  Image image_;
  RenderTarget target_;
  LayeredImage depth_;
};

}  // namespace

Timing timing_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  const double median = n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
  return {median, values.front(), values.back()};
}

std::vector<RenderStatistics> FrameCosts::drawings() const {
  std::vector<RenderStatistics> all;
  for (const FrameCost& cost : costs_) all.push_back(cost.drawing);
  return all;
}

Timing FrameCosts::phase(double RenderStatistics::*phase) const {
  return timing_over(costs_, [&](const FrameCost& cost) { return cost.drawing.*phase; });
}

Timing FrameCosts::pose() const {
  return timing_over(costs_, [](const FrameCost& cost) { return cost.pose_ms; });
}

Timing FrameCosts::frame() const {
  return timing_over(costs_, [](const FrameCost& cost) { return cost.pose_ms + cost.drawing.total_ms; });
}

StageTimes FrameCosts::stages(StageTimes RenderStatistics::*stages) const {
  StageTimes medians;
  for (std::size_t i = 0; i < kStageCount; ++i) {
    medians.ms[i] =
        timing_over(costs_, [&](const FrameCost& cost) { return (cost.drawing.*stages).ms[i]; }).median;
  }
  return medians;
}

Result<FrameCosts> draw_series(Subject& subject, const FrameSeries& series,
                               const std::filesystem::path& picture) {
  FrameCosts costs;
  Painter painter(subject);
  for (int i = -series.warm_up; i < series.frames; ++i) {
    const Result<double> pose_ms = pose(subject.renderer, series);
    if (!pose_ms) return tl::unexpected(pose_ms.error());
    const Result<RenderStatistics> drawn = painter.draw();
    if (!drawn) return tl::unexpected(drawn.error());
    if (i >= 0) costs.add({*pose_ms, *drawn});
  }
  if (picture.empty()) return costs;
  if (Result<void> written = painter.write(picture); !written) return tl::unexpected(written.error());
  return costs;
}

double peak_megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace laterna::app
