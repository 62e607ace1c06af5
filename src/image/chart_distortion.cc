// How unevenly charts of directions spend their texels.
#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "base/elementary.h"
#include "image/environment_chart.h"

namespace laterna {
namespace {

// Extents in radians of a texel, along the axes in which it is longest and shortest.
struct Extents {
  double longest, shortest;
};

// The singular values of the derivative of the direction, found by differences over a small part of a texel.
Extents texel_extents(EnvironmentChart chart, const image::PanelPoint& at, double step_a, double step_b) {
  constexpr double kPart = 1e-3;
  const auto difference = [&](double a, double b) {
    const glm::dvec3 ahead = image::direction_from_panel(chart, {at.panel, at.a + a, at.b + b});
    const glm::dvec3 behind = image::direction_from_panel(chart, {at.panel, at.a - a, at.b - b});
    return (ahead - behind) / (2 * kPart);
  };
  const glm::dvec3 du = difference(kPart * step_a, 0), dv = difference(0, kPart * step_b);
  const double e = glm::dot(du, du), f = glm::dot(du, dv), g = glm::dot(dv, dv);
  const double mean = (e + g) / 2, spread = std::sqrt((e - g) * (e - g) / 4 + f * f);
  return {std::sqrt(mean + spread), std::sqrt(std::max(mean - spread, 0.0))};
}

}  // namespace

ChartDistortion measure_distortion(EnvironmentChart chart, int size) {
  const image::ChartShape shape = image::chart_shape(chart);
  const int columns = size * shape.panel_columns;
  const double step_a = 2.0 / columns, step_b = 2.0 / size;
  ChartDistortion all;
  all.smallest_solid_angle = std::numeric_limits<double>::infinity();
  double directions = 0, anisotropy = 0, longest = 0, used = 0;
  for (int panel = 0; panel < static_cast<int>(shape.panels.size()); ++panel) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < columns; ++x) {
        const glm::dvec2 low(x * step_a - 1, y * step_b - 1), high(low.x + step_a, low.y + step_b);
        const image::PanelPoint at{panel, (low.x + high.x) / 2, (low.y + high.y) / 2};
        const double farthest = glm::length(glm::dvec2(std::max(std::abs(low.x), std::abs(high.x)),
                                                       std::max(std::abs(low.y), std::abs(high.y))));
        if (image::has_discs(chart) && farthest > 1) continue;  // cut by the rim, or beyond it
        const double solid_angle = image::rectangle_solid_angle(chart, low, high);
        const Extents extents = texel_extents(chart, at, step_a, step_b);
        const double ratio = extents.longest / extents.shortest;
        all.largest_solid_angle = std::max(all.largest_solid_angle, solid_angle);
        all.smallest_solid_angle = std::min(all.smallest_solid_angle, solid_angle);
        all.anisotropy = std::max(all.anisotropy, ratio);
        longest = std::max(longest, extents.longest);
        directions += solid_angle;
        anisotropy += solid_angle * ratio;
      }
    }
  }
  all.mean_anisotropy = anisotropy / directions;
  used = static_cast<double>(shape.panels.size()) * shape.panel_columns *
         (image::has_discs(chart) ? kPi / 4 : 1);
  all.unused_share = 1 - used / (shape.columns * shape.rows);
  all.coarsest_deg = longest * 180 / kPi;
  const double finer = all.coarsest_deg / 0.1;
  all.megatexels_at_tenth_deg =
      static_cast<double>(size) * size * shape.columns * shape.rows * finer * finer / 1e6;
  return all;
}

}  // namespace laterna
