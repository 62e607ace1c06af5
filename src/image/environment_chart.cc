#include "image/environment_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

#include "base/elementary.h"

namespace laterna {
namespace {

constexpr std::array<EnvironmentChartDescription, 7> kCharts = {{
    {EnvironmentChart::latlong, "latlong", 2, 1, "longitude and latitude, -Z in the middle, +Y at the top"},
    {EnvironmentChart::cube, "cube", 6, 1,
     "six faces in a row, +X -X +Y -Y +Z -Z, turned as OpenGL has them"},
    {EnvironmentChart::horizontal_cross, "horizontal_cross", 4, 3,
     "OpenGL's faces unfolded, -X +Z +X -Z in the middle row"},
    {EnvironmentChart::vertical_cross, "vertical_cross", 3, 4,
     "OpenGL's faces unfolded, -X +Z +X in the second row, -Z below, turned by 180 degrees"},
    {EnvironmentChart::sphere, "sphere", 1, 1, "a mirror ball seen from +Z: OpenGL's sphere map"},
    {EnvironmentChart::dual_paraboloid, "dual_paraboloid", 2, 1, "two discs, about +Z and -Z"},
    {EnvironmentChart::octahedral, "octahedral", 1, 1, "an octahedron unfolded, +Y in the middle"},
}};

const EnvironmentChartDescription& describe(EnvironmentChart chart) {
  return kCharts[static_cast<std::size_t>(chart)];
}

}  // namespace

std::span<const EnvironmentChartDescription> list_environment_charts() { return kCharts; }

std::optional<EnvironmentChart> find_environment_chart(std::string_view name) {
  for (const EnvironmentChartDescription& known : kCharts) {
    if (known.name == name) return known.chart;
  }
  return std::nullopt;
}

std::string find_fault(EnvironmentChart chart, int width, int height) {
  const EnvironmentChartDescription& known = describe(chart);
  if (width > 0 && width % known.columns == 0 && height == width / known.columns * known.rows) return {};
  return fmt::format("a picture in the chart {} is {}:{}; this one is {} x {}", known.name, known.columns,
                     known.rows, width, height);
}

std::optional<EnvironmentChart> guess_environment_chart(int width, int height) {
  for (const EnvironmentChart chart :
       {EnvironmentChart::latlong, EnvironmentChart::cube, EnvironmentChart::horizontal_cross,
        EnvironmentChart::vertical_cross}) {
    if (find_fault(chart, width, height).empty()) return chart;
  }
  return std::nullopt;
}

glm::dvec2 image_from_direction(EnvironmentChart chart, const glm::dvec3& direction) {
  const image::ChartShape shape = image::chart_shape(chart);
  const image::PanelPoint point = image::panel_from_direction(chart, direction);
  const image::ChartPanel& panel = shape.panels[static_cast<std::size_t>(point.panel)];
  const double sign = panel.is_turned ? -0.5 : 0.5;
  return {(panel.column + (0.5 + sign * point.a) * shape.panel_columns) / shape.columns,
          (panel.row + 0.5 + sign * point.b) / shape.rows};
}

std::optional<glm::dvec3> direction_from_image(EnvironmentChart chart, const glm::dvec2& position) {
  const image::ChartShape shape = image::chart_shape(chart);
  const double x = position.x * shape.columns, y = position.y * shape.rows;
  for (std::size_t i = 0; i < shape.panels.size(); ++i) {
    const image::ChartPanel& panel = shape.panels[i];
    const double sign = panel.is_turned ? -1 : 1;
    const double a = sign * (2 * (x - panel.column) / shape.panel_columns - 1);
    const double b = sign * (2 * (y - panel.row) - 1);
    if (std::abs(a) > 1 || std::abs(b) > 1) continue;
    if (image::has_discs(chart) && a * a + b * b > 1) continue;
    return image::direction_from_panel(chart, {static_cast<int>(i), a, b});
  }
  return std::nullopt;
}

namespace image {
namespace {

constexpr ChartPanel kWhole[] = {{0, 0}};
constexpr ChartPanel kRow[] = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}};
constexpr ChartPanel kHorizontalCross[] = {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}};
constexpr ChartPanel kVerticalCross[] = {{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {1, 3, true}};
constexpr ChartPanel kPair[] = {{0, 0}, {1, 0}};

// Faces of a cube in OpenGL's order: which axis, its sign, and s and t as sums of the others (OpenGL 4.6, table 8.19).
struct CubeFace {
  glm::dvec3 axis, right, down;
};
constexpr CubeFace kFaces[6] = {
    {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
    {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},   {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
    {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}},
};

double sign_of(double x) { return x < 0 ? -1 : 1; }

PanelPoint cube_from_direction(const glm::dvec3& d) {
  const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  int face = 0;
  if (x >= y && x >= z) {
    face = d.x < 0 ? 1 : 0;
  } else if (y >= z) {
    face = d.y < 0 ? 3 : 2;
  } else {
    face = d.z < 0 ? 5 : 4;
  }
  const CubeFace& f = kFaces[face];
  const double along = glm::dot(d, f.axis);
  return {face, glm::dot(d, f.right) / along, glm::dot(d, f.down) / along};
}

// Meyer et al. 2010, On floating-point normal vectors: the octahedron |x| + |y| + |z| = 1, its lower half folded out.
PanelPoint octahedral_from_direction(const glm::dvec3& d) {
  const glm::dvec3 p = d / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
  if (p.y >= 0) return {0, p.x, p.z};
  return {0, (1 - std::abs(p.z)) * sign_of(p.x), (1 - std::abs(p.x)) * sign_of(p.z)};
}

glm::dvec3 octahedron_point(double a, double b) {
  const double y = 1 - std::abs(a) - std::abs(b);
  if (y >= 0) return {a, y, b};
  return {(1 - std::abs(b)) * sign_of(a), y, (1 - std::abs(a)) * sign_of(b)};
}

}  // namespace

ChartShape chart_shape(EnvironmentChart chart) {
  const EnvironmentChartDescription& known = describe(chart);
  ChartShape shape{known.columns, known.rows, 1, kWhole};
  switch (chart) {
    case EnvironmentChart::latlong:
      shape.panel_columns = 2;
      break;
    case EnvironmentChart::cube:
      shape.panels = kRow;
      break;
    case EnvironmentChart::horizontal_cross:
      shape.panels = kHorizontalCross;
      break;
    case EnvironmentChart::vertical_cross:
      shape.panels = kVerticalCross;
      break;
    case EnvironmentChart::dual_paraboloid:
      shape.panels = kPair;
      break;
    case EnvironmentChart::sphere:
    case EnvironmentChart::octahedral:
      break;
  }
  return shape;
}

PanelPoint panel_from_direction(EnvironmentChart chart, const glm::dvec3& direction) {
  const glm::dvec3 d = glm::normalize(direction);
  switch (chart) {
    case EnvironmentChart::latlong:
      return {0, arctangent2(d.x, -d.z) / kPi, -2 * arcsine(std::clamp(d.y, -1.0, 1.0)) / kPi};
    case EnvironmentChart::sphere: {
      // OpenGL 4.6 compatibility profile, equation 12.4 of sphere maps: r / (2 √(x² + y² + (z + 1)²)), here times 2.
      const double m = std::sqrt(d.x * d.x + d.y * d.y + (d.z + 1) * (d.z + 1));
      if (m <= 1e-12) return {0, 1, 0};
      return {0, d.x / m, -d.y / m};
    }
    case EnvironmentChart::dual_paraboloid: {
      // Heidrich & Seidel 1998, View-independent environment maps.
      const double m = 1 + std::abs(d.z);
      return {d.z >= 0 ? 0 : 1, d.x / m, -d.y / m};
    }
    case EnvironmentChart::octahedral:
      return octahedral_from_direction(d);
    default:
      return cube_from_direction(d);
  }
}

glm::dvec3 direction_from_panel(EnvironmentChart chart, const PanelPoint& point) {
  const double a = point.a, b = point.b;
  switch (chart) {
    case EnvironmentChart::latlong: {
      const double longitude = a * kPi, latitude = -b * kPi / 2;
      const double across = cosine(latitude);
      return {across * sine(longitude), sine(latitude), -across * cosine(longitude)};
    }
    case EnvironmentChart::sphere: {
      // The ball's normal is (a, −b, √(1 − a² − b²)), and the eye's direction +Z is mirrored at it.
      const double squared = std::min(a * a + b * b, 1.0);
      const double depth = std::sqrt(1 - squared);
      return glm::normalize(glm::dvec3(2 * depth * a, -2 * depth * b, 2 * depth * depth - 1));
    }
    case EnvironmentChart::dual_paraboloid: {
      const double squared = a * a + b * b;
      const double z = (1 - squared) / (1 + squared);
      return {2 * a / (1 + squared), -2 * b / (1 + squared), point.panel == 0 ? z : -z};
    }
    case EnvironmentChart::octahedral:
      return glm::normalize(octahedron_point(std::clamp(a, -1.0, 1.0), std::clamp(b, -1.0, 1.0)));
    default: {
      const CubeFace& f = kFaces[point.panel];
      return glm::normalize(f.axis + a * f.right + b * f.down);
    }
  }
}

double panel_density(EnvironmentChart chart, const PanelPoint& point) {
  const double a = point.a, b = point.b;
  const auto inverse_cube = [](double squared) { return 1 / (squared * std::sqrt(squared)); };
  switch (chart) {
    case EnvironmentChart::latlong:
      return kPi * kPi / 2 * cosine(b * kPi / 2);
    case EnvironmentChart::sphere:
      return a * a + b * b <= 1 ? 4 : 0;  // Lambert's equal-area projection
    case EnvironmentChart::dual_paraboloid: {
      const double squared = a * a + b * b;
      return squared <= 1 ? 4 / ((1 + squared) * (1 + squared)) : 0;
    }
    case EnvironmentChart::octahedral: {
      const glm::dvec3 p = octahedron_point(a, b);
      return inverse_cube(glm::dot(p, p));
    }
    default:
      return inverse_cube(1 + a * a + b * b);
  }
}

}  // namespace image
}  // namespace laterna
