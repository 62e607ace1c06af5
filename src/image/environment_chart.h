// Charts of directions as panels: the squares of a cube, the discs of paraboloids, the whole picture otherwise.
#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "laterna/environment.h"

namespace laterna::image {

/// A panel's place in the picture, in units of the size N. Its own coordinates (a, b) run from −1 to 1, rightward and
/// downward; of a panel that is turned by 180° the picture shows (−a, −b).
struct ChartPanel {
  int column, row;
  bool is_turned = false;
};

/// Panels of a chart, each `panel_columns` N wide and N high.
struct ChartShape {
  int columns, rows, panel_columns;
  std::span<const ChartPanel> panels;
};
ChartShape chart_shape(EnvironmentChart chart);

/// Whether the panels are discs, of which only |(a, b)| ≤ 1 shows directions.
inline bool has_discs(EnvironmentChart chart) {
  return chart == EnvironmentChart::sphere || chart == EnvironmentChart::dual_paraboloid;
}
inline bool is_cube(EnvironmentChart chart) {
  return chart == EnvironmentChart::cube || chart == EnvironmentChart::horizontal_cross ||
         chart == EnvironmentChart::vertical_cross;
}

struct PanelPoint {
  int panel;
  double a, b;
};

/// Where a direction other than 0 lies.
PanelPoint panel_from_direction(EnvironmentChart chart, const glm::dvec3& direction);
/// What is seen there, of unit length. Beyond the sides of a cube's face or a paraboloid's rim the map goes on; of
/// other charts (a, b) is held to where there are directions.
glm::dvec3 direction_from_panel(EnvironmentChart chart, const PanelPoint& point);
/// Solid angle per area of the (a, b) plane, there.
double panel_density(EnvironmentChart chart, const PanelPoint& point);
/// Solid angle of a rectangle of a panel, of the part that shows directions. low < high, within [−1, 1].
double rectangle_solid_angle(EnvironmentChart chart, glm::dvec2 low, glm::dvec2 high);

}  // namespace laterna::image
