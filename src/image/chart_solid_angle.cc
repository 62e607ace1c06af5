// Solid angles of rectangles of charts, in closed form.
#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

#include "base/elementary.h"
#include "image/environment_chart.h"

namespace laterna {
namespace image {
namespace {

// Solid angle of the triangle that three points not in one plane with the origin span: van Oosterom & Strackee 1983.
double triangle_solid_angle(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r) {
  const double a = glm::length(p), b = glm::length(q), c = glm::length(r);
  const double volume = std::abs(glm::dot(p, glm::cross(q, r)));
  const double divisor = a * b * c + glm::dot(p, q) * c + glm::dot(q, r) * a + glm::dot(r, p) * b;
  return 2 * arctangent2(volume, divisor);
}

// Of the rectangle from the middle of a cube's face, with the sign of a b.
double from_middle_of_face(double a, double b) { return arctangent2(a * b, std::sqrt(1 + a * a + b * b)); }

// ---------------------------------------------------------------------------------------------- octahedron

using Polygon = std::vector<glm::dvec2>;

// The part on which n · p ≤ limit.
Polygon clip(const Polygon& polygon, const glm::dvec2& n, double limit) {
  Polygon inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double at_p = glm::dot(n, p) - limit, at_q = glm::dot(n, q) - limit;
    if (at_p <= 0) inside.push_back(p);
    if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0))
      inside.push_back(p + (q - p) * (at_p / (at_p - at_q)));
  }
  return inside;
}

// Each of the eight faces is a triangle of the chart on which the map to the octahedron is affine.
double octahedral_solid_angle(const glm::dvec2& low, const glm::dvec2& high) {
  const Polygon rectangle = {low, {high.x, low.y}, high, {low.x, high.y}};
  double sum = 0;
  for (const double sx : {-1.0, 1.0}) {
    for (const double sy : {-1.0, 1.0}) {
      const Polygon quadrant = clip(clip(rectangle, {-sx, 0}, 0), {0, -sy}, 0);
      if (quadrant.size() < 3) continue;
      for (const double fold : {1.0, -1.0}) {
        const Polygon face = clip(quadrant, {fold * sx, fold * sy}, fold);
        const auto on_octahedron = [&](const glm::dvec2& p) {
          const double a = std::abs(p.x), b = std::abs(p.y);
          return fold > 0 ? glm::dvec3(a, 1 - a - b, b) : glm::dvec3(1 - b, 1 - a - b, 1 - a);
        };
        for (std::size_t i = 2; i < face.size(); ++i) {
          sum += triangle_solid_angle(on_octahedron(face[0]), on_octahedron(face[i - 1]),
                                      on_octahedron(face[i]));
        }
      }
    }
  }
  return sum;
}

// ---------------------------------------------------------------------------------------------- discs

// By Stokes' theorem solid angle is an integral along the boundary: of a sphere map, where dω = 4 dA, of
// 2 (x dy − y dx); of a paraboloid, where dω = 4 dA / (1 + ρ²)², of 2 (x dy − y dx) / (1 + ρ²).
class DiscIntegral {
 public:
  explicit DiscIntegral(bool is_paraboloid) : is_paraboloid_(is_paraboloid) {}

  [[nodiscard]] double along_line(const glm::dvec2& p, const glm::dvec2& q) const {
    const double twice_area = p.x * q.y - p.y * q.x;
    if (!is_paraboloid_) return 2 * twice_area;
    const double length = glm::length(q - p);
    if (length <= 0) return 0;
    const double distance = twice_area / length;  // of the line from the middle, with its side
    const glm::dvec2 along = (q - p) / length;
    const double width = std::sqrt(1 + distance * distance);
    return 2 * distance / width *
           (arctangent(glm::dot(q, along) / width) - arctangent(glm::dot(p, along) / width));
  }
  [[nodiscard]] double along_rim(double angle) const { return (is_paraboloid_ ? 1 : 2) * angle; }

 private:
  bool is_paraboloid_;
};

// The part of a segment that lies in the unit disc.
std::optional<std::array<glm::dvec2, 2>> within_disc(const glm::dvec2& p, const glm::dvec2& q) {
  const glm::dvec2 along = q - p;
  const double a = glm::dot(along, along), b = glm::dot(p, along), c = glm::dot(p, p) - 1;
  const double discriminant = b * b - a * c;
  if (discriminant <= 0) return std::nullopt;
  const double root = std::sqrt(discriminant);
  const double enter = std::max((-b - root) / a, 0.0), leave = std::min((-b + root) / a, 1.0);
  if (enter >= leave) return std::nullopt;
  return std::array<glm::dvec2, 2>{p + along * enter, p + along * leave};
}

// Around the part of the rectangle within the disc, which is convex: along its sides, and along the rim from where one
// side leaves the disc to where the next enters it.
double disc_solid_angle(bool is_paraboloid, const glm::dvec2& low, const glm::dvec2& high) {
  const DiscIntegral integral(is_paraboloid);
  const glm::dvec2 corners[4] = {low, {high.x, low.y}, high, {low.x, high.y}};
  std::vector<std::array<glm::dvec2, 2>> sides;
  for (std::size_t i = 0; i < 4; ++i) {
    if (const auto side = within_disc(corners[i], corners[(i + 1) % 4])) sides.push_back(*side);
  }
  if (sides.empty()) {
    const bool holds_disc = low.x < 0 && low.y < 0 && high.x > 0 && high.y > 0;
    return holds_disc ? integral.along_rim(2 * kPi) : 0;
  }
  double sum = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const glm::dvec2 &left = sides[i][1], &entered = sides[(i + 1) % sides.size()][0];
    sum += integral.along_line(sides[i][0], left);
    if (glm::length(entered - left) < 1e-14) continue;
    double angle = arctangent2(left.x * entered.y - left.y * entered.x, glm::dot(left, entered));
    if (angle < 0) angle += 2 * kPi;
    sum += integral.along_rim(angle);
  }
  return sum;
}

}  // namespace

double rectangle_solid_angle(EnvironmentChart chart, glm::dvec2 low, glm::dvec2 high) {
  switch (chart) {
    case EnvironmentChart::latlong:
      return (high.x - low.x) * kPi * (sine(high.y * kPi / 2) - sine(low.y * kPi / 2));
    case EnvironmentChart::sphere:
      return disc_solid_angle(false, low, high);
    case EnvironmentChart::dual_paraboloid:
      return disc_solid_angle(true, low, high);
    case EnvironmentChart::octahedral:
      return octahedral_solid_angle(low, high);
    default:
      return from_middle_of_face(high.x, high.y) - from_middle_of_face(low.x, high.y) -
             from_middle_of_face(high.x, low.y) + from_middle_of_face(low.x, low.y);
  }
}

}  // namespace image

double texel_solid_angle(EnvironmentChart chart, int width, int height, int x, int y) {
  const image::ChartShape shape = image::chart_shape(chart);
  const int size = height / shape.rows;
  const int panel_width = width / shape.columns * shape.panel_columns;
  for (const image::ChartPanel& panel : shape.panels) {
    const int column = x - panel.column * size, row = y - panel.row * size;
    if (column < 0 || column >= panel_width || row < 0 || row >= size) continue;
    // Turning by 180° changes no solid angle: faces are symmetric.
    const glm::dvec2 low(2.0 * column / panel_width - 1, 2.0 * row / size - 1);
    return image::rectangle_solid_angle(chart, low,
                                        {2.0 * (column + 1) / panel_width - 1, 2.0 * (row + 1) / size - 1});
  }
  return 0;
}

}  // namespace laterna
