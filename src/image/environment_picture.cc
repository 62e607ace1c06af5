#include "image/environment_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/elementary.h"
#include "image/parallel_rows.h"

namespace laterna::image {

EnvironmentPicture::EnvironmentPicture(EnvironmentChart chart, int width, int height,
                                       const std::vector<glm::vec3>& texels)
    : chart_(chart) {
  const ChartShape shape = chart_shape(chart);
  size_ = height / shape.rows;
  panel_width_ = size_ * shape.panel_columns;
  panel_count_ = static_cast<int>(shape.panels.size());
  texels_.resize(index(panel_count_, -1, -1));
  for (int p = 0; p < panel_count_; ++p) {
    const ChartPanel& panel = shape.panels[static_cast<std::size_t>(p)];
    for (int y = 0; y < size_; ++y) {
      for (int x = 0; x < panel_width_; ++x) {
        const int column = panel.column * size_ + (panel.is_turned ? panel_width_ - 1 - x : x);
        const int row = panel.row * size_ + (panel.is_turned ? size_ - 1 - y : y);
        texels_[index(p, x, y)] = texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                         static_cast<std::size_t>(column)];
      }
    }
  }
  fill_borders();
}

PanelPoint EnvironmentPicture::centre_of(int panel, int x, int y) const {
  return {panel, (2 * x + 1.0) / panel_width_ - 1, (2 * y + 1.0) / size_ - 1};
}

std::size_t EnvironmentPicture::nearest(const PanelPoint& point) const {
  const auto texel = [](double at, int count) {
    return std::clamp(static_cast<int>(std::floor((at + 1) / 2 * count)), 0, count - 1);
  };
  return index(point.panel, texel(point.a, panel_width_), texel(point.b, size_));
}

// The texel that lies where (x, y), up to one texel beyond the panel's sides, would be.
std::size_t EnvironmentPicture::folded(int panel, int x, int y) const {
  const int w = panel_width_, h = size_;
  if (chart_ == EnvironmentChart::latlong) {
    if (y < 0 || y >= h) {  // over a pole
      x += w / 2;
      y = y < 0 ? -1 - y : 2 * h - 1 - y;
    }
    return index(panel, (x + w) % w, y);
  }
  if (chart_ == EnvironmentChart::octahedral) {
    if (x < 0 || x >= w) {
      x = x < 0 ? -1 - x : 2 * w - 1 - x;
      y = h - 1 - y;
    }
    if (y < 0 || y >= h) {
      y = y < 0 ? -1 - y : 2 * h - 1 - y;
      x = w - 1 - x;
    }
    return index(panel, x, y);
  }
  PanelPoint point = centre_of(panel, x, y);
  if (is_cube(chart_)) {
    // Just over the edge, so that the texels on both sides of it are each other's neighbours.
    const auto hold = [](double& at) { at = std::clamp(at, -1 - 1e-9, 1 + 1e-9); };
    hold(point.a);
    hold(point.b);
  } else if (has_discs(chart_)) {
    return nearest_within_rim(panel_from_direction(chart_, direction_from_panel(chart_, point)));
  }
  return nearest(panel_from_direction(chart_, direction_from_panel(chart_, point)));
}

// So far inside that the middle of the texel is.
std::size_t EnvironmentPicture::nearest_within_rim(const PanelPoint& point) const {
  const double radius = std::sqrt(point.a * point.a + point.b * point.b),
               most = std::max(1 - 1.5 / size_, 0.0);
  const double factor = radius > most ? most / radius : 1;
  return nearest({point.panel, point.a * factor, point.b * factor});
}

// What a texel beyond the rim would show, from those of `own` that do show something.
glm::vec3 EnvironmentPicture::beyond_rim(const std::vector<glm::vec3>& own, const PanelPoint& centre) const {
  const PanelPoint point = panel_from_direction(chart_, direction_from_panel(chart_, centre));
  const double x = (point.a + 1) / 2 * panel_width_ - 0.5, y = (point.b + 1) / 2 * size_ - 0.5;
  glm::dvec3 sum(0);
  double weight = 0;
  for (const double row : {std::floor(y), std::floor(y) + 1}) {
    for (const double column : {std::floor(x), std::floor(x) + 1}) {
      const PanelPoint texel = centre_of(point.panel, static_cast<int>(column), static_cast<int>(row));
      if (is_beyond_rim(texel)) continue;
      const double share = (1 - std::abs(x - column)) * (1 - std::abs(y - row));
      sum += glm::dvec3(own[nearest(texel)]) * share;
      weight += share;
    }
  }
  return weight > 0.05 ? glm::vec3(sum / weight) : own[nearest_within_rim(point)];
}

// Borders, and what lies beyond the rim of discs: a stranger's picture may hold anything there.
void EnvironmentPicture::fill_borders() {
  const std::vector<glm::vec3> own = texels_;
  for (int p = 0; p < panel_count_; ++p) {
    for (int y = -1; y <= size_; ++y) {
      for (int x = -1; x <= panel_width_; ++x) {
        const bool is_beyond_side = x < 0 || y < 0 || x >= panel_width_ || y >= size_;
        const PanelPoint centre = centre_of(p, x, y);
        if (!is_beyond_side && !is_beyond_rim(centre)) continue;
        const bool is_corner = (x < 0 || x >= panel_width_) && (y < 0 || y >= size_);
        if (is_cube(chart_) && is_corner) {
          // Three faces meet: the mean of the three texels, as OpenGL's seamless filtering has it.
          const int inner_x = std::clamp(x, 0, panel_width_ - 1), inner_y = std::clamp(y, 0, size_ - 1);
          texels_[index(p, x, y)] =
              (own[index(p, inner_x, inner_y)] + own[folded(p, x, inner_y)] + own[folded(p, inner_x, y)]) /
              3.0F;
        } else if (chart_ == EnvironmentChart::dual_paraboloid) {
          texels_[index(p, x, y)] = beyond_rim(own, centre);
        } else {
          texels_[index(p, x, y)] = own[folded(p, x, y)];
        }
      }
    }
  }
}

glm::dvec3 EnvironmentPicture::look_up(const glm::dvec3& direction) const {
  const PanelPoint point = panel_from_direction(chart_, direction);
  const double x = (point.a + 1) / 2 * panel_width_ - 0.5, y = (point.b + 1) / 2 * size_ - 0.5;
  const int column = std::clamp(static_cast<int>(std::floor(x)), -1, panel_width_ - 1);
  const int row = std::clamp(static_cast<int>(std::floor(y)), -1, size_ - 1);
  const double u = x - column, v = y - row;
  const std::size_t upper = index(point.panel, column, row), lower = index(point.panel, column, row + 1);
  const glm::dvec3 top = glm::dvec3(texels_[upper]) * (1 - u) + glm::dvec3(texels_[upper + 1]) * u;
  const glm::dvec3 bottom = glm::dvec3(texels_[lower]) * (1 - u) + glm::dvec3(texels_[lower + 1]) * u;
  return top * (1 - v) + bottom * v;
}

double EnvironmentPicture::texel_side() const {
  const double texels =
      static_cast<double>(panel_width_) * size_ * panel_count_ * (has_discs(chart_) ? kPi / 4 : 1);
  return std::sqrt(4 * kPi / texels);
}

void directions_in_texel(EnvironmentChart chart, const PanelPoint& low, const PanelPoint& high, int grid,
                         std::vector<WeightedDirection>& directions) {
  directions.clear();
  double sum = 0;
  for (int j = 0; j < grid; ++j) {
    for (int i = 0; i < grid; ++i) {
      const PanelPoint point{low.panel, low.a + (high.a - low.a) * (i + 0.5) / grid,
                             low.b + (high.b - low.b) * (j + 0.5) / grid};
      const double density = panel_density(chart, point);
      if (density <= 0) continue;
      directions.push_back({direction_from_panel(chart, point), density});
      sum += density;
    }
  }
  if (directions.empty()) {
    const PanelPoint middle{low.panel, (low.a + high.a) / 2, (low.b + high.b) / 2};
    directions.push_back({direction_from_panel(chart, middle), 1});
    sum = 1;
  }
  for (WeightedDirection& one : directions) one.share /= sum;
}

std::vector<glm::vec3> resample(const EnvironmentPicture& source, EnvironmentChart to, int size,
                                const TaskPool& pool) {
  const ChartShape shape = chart_shape(to);
  const int width = shape.columns * size, panel_width = shape.panel_columns * size;
  const double texels = static_cast<double>(panel_width) * size * static_cast<double>(shape.panels.size()) *
                        (has_discs(to) ? kPi / 4 : 1);
  // Two to a texel of the source at least, so that none is left out where texels are finer than on average.
  const double ratio = std::sqrt(4 * kPi / texels) / source.texel_side();
  const int grid = std::clamp(static_cast<int>(std::ceil(2 * ratio)), 2, 64);
  std::vector<glm::vec3> out(static_cast<std::size_t>(width) * static_cast<std::size_t>(shape.rows * size));
  for (std::size_t p = 0; p < shape.panels.size(); ++p) {
    const ChartPanel& panel = shape.panels[p];
    pool.for_each(static_cast<std::size_t>(size), [&](std::size_t row_index, int) {
      const auto y = static_cast<int>(row_index);
      std::vector<WeightedDirection> directions;
      for (int x = 0; x < panel_width; ++x) {
        const PanelPoint low{static_cast<int>(p), 2.0 * x / panel_width - 1, 2.0 * y / size - 1};
        const PanelPoint high{low.panel, 2.0 * (x + 1) / panel_width - 1, 2.0 * (y + 1) / size - 1};
        directions_in_texel(to, low, high, grid, directions);
        glm::dvec3 mean(0);
        for (const WeightedDirection& one : directions) mean += source.look_up(one.direction) * one.share;
        const int column = panel.column * size + (panel.is_turned ? panel_width - 1 - x : x);
        const int row = panel.row * size + (panel.is_turned ? size - 1 - y : y);
        out[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
            static_cast<std::size_t>(column)] = glm::vec3(mean);
      }
    });
  }
  return out;
}

}  // namespace laterna::image
