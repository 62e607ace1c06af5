// A picture of all directions in one of its charts, read without seams.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "base/task_pool.h"
#include "image/environment_chart.h"

namespace laterna::image {

/// Linear R, G, B in one chart, panel after panel, each with the texels around it that interpolation across its sides asks
/// for.
class EnvironmentPicture {
 public:
  /// `texels`: rows of the picture, of a shape of the chart.
  EnvironmentPicture(EnvironmentChart chart, int width, int height, const std::vector<glm::vec3>& texels);

  /// Interpolated between the four texels about the direction, across edges of faces too.
  [[nodiscard]] glm::dvec3 look_up(const glm::dvec3& direction) const;
  /// The side in radians of a square as large as a texel is on average.
  [[nodiscard]] double texel_side() const;

 private:
  [[nodiscard]] std::size_t index(int panel, int x, int y) const {
    const auto stride = static_cast<std::size_t>(panel_width_) + 2;
    return (static_cast<std::size_t>(panel) * (static_cast<std::size_t>(size_) + 2) +
            static_cast<std::size_t>(y + 1)) *
               stride +
           static_cast<std::size_t>(x + 1);
  }
  [[nodiscard]] std::size_t folded(int panel, int x, int y) const;
  [[nodiscard]] std::size_t nearest(const PanelPoint& point) const;
  [[nodiscard]] std::size_t nearest_within_rim(const PanelPoint& point) const;
  [[nodiscard]] bool is_beyond_rim(const PanelPoint& point) const {
    return has_discs(chart_) && point.a * point.a + point.b * point.b > 1;
  }
  [[nodiscard]] glm::vec3 beyond_rim(const std::vector<glm::vec3>& own, const PanelPoint& centre) const;
  [[nodiscard]] PanelPoint centre_of(int panel, int x, int y) const;
  void fill_borders();

  EnvironmentChart chart_;
  int size_, panel_width_, panel_count_;
  std::vector<glm::vec3> texels_;
};

/// What of a texel of a chart is averaged over: directions with their shares, which add up to 1. `grid`: so many to each
/// side. Empty where the texel shows nothing at all.
struct WeightedDirection {
  glm::dvec3 direction;
  double share;
};
void directions_in_texel(EnvironmentChart chart, const PanelPoint& low, const PanelPoint& high, int grid,
                         std::vector<WeightedDirection>& directions);

/// The same directions in another chart of size N, rows of the whole picture; each texel the mean over its solid angle.
std::vector<glm::vec3> resample(const EnvironmentPicture& source, EnvironmentChart to, int size,
                                const TaskPool& pool);

}  // namespace laterna::image
