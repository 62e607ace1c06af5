#include "shade/affine_slide.h"

#include <optional>

namespace laterna::shade {
namespace {

struct Corner {
  double x, y;  // pixels from the view's origin
  double s, t;  // on the slide
};

float at(const shadow::ProjectedRow& row, double x, double y, double q) {
  return static_cast<float>(row.at_0 + row.at_x * x + row.at_y * y + row.at_q * q);
}

std::optional<Corner> project(const BoundLight& light, const raster::RasterView& view,
                              const glm::dvec3& p_ws) {
  const glm::dvec3 p = p_ws - view.eye_ws;
  const double w = glm::dot(view.w_row, p) + view.w_add;
  if (!view.is_orthographic && w < view.view.projection.near) return std::nullopt;
  const double divisor = view.is_orthographic ? 1 : w;
  const double x = (glm::dot(view.x_row, p) + view.x_add) / divisor;
  const double y = (glm::dot(view.y_row, p) + view.y_add) / divisor;
  const double q = view.is_orthographic ? w : 1 / w;
  const shadow::ProjectedRow& divisor_row =
      light.is_orthographic ? light.homogeneous : light.slide_position.divisor;
  const double slide_w = at(divisor_row, x, y, q);
  if (slide_w <= 0) return std::nullopt;
  return Corner{x, y, at(light.slide_position.x, x, y, q) / slide_w,
                at(light.slide_position.y, x, y, q) / slide_w};
}

std::optional<std::array<Corner, 3>> project_triangle(const BoundLight& light, const PointSource& source,
                                                      TriangleId id) {
  const TriangleClusters geometry = source.frame->geometry();
  std::array<Corner, 3> corners{};
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t v =
        geometry.clusters[cluster_of(id)].first_vertex + (geometry.corners[id] >> (8 * i) & 255U);
    const auto corner = project(light, *source.view, glm::dvec3(geometry.positions_ws[v]));
    if (!corner) return std::nullopt;
    corners[i] = *corner;
  }
  return corners;
}

}  // namespace

void find_affine_slide_coordinates(const BoundLight& light, const PointSource& source,
                                   const shadow::SurfaceSamples& samples, SlideCoordinates& coordinates) {
  coordinates.valid.fill(0);
  for (std::size_t i = 0; i < samples.group_count * shadow::kGroupSize; ++i) {
    const auto triangle = project_triangle(light, source, samples.id[i]);
    if (!triangle) continue;
    const auto& [a, b, c] = *triangle;
    const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (area == 0) continue;
    const double px = samples.x[i] - a.x;
    const double py = samples.y[i] - a.y;
    const double weight_b = (px * (c.y - a.y) - (c.x - a.x) * py) / area;
    const double weight_c = ((b.x - a.x) * py - px * (b.y - a.y)) / area;
    coordinates.s[i] = static_cast<float>(a.s + (b.s - a.s) * weight_b + (c.s - a.s) * weight_c);
    coordinates.t[i] = static_cast<float>(a.t + (b.t - a.t) * weight_b + (c.t - a.t) * weight_c);
    std::uint16_t& valid = coordinates.valid[i / shadow::kGroupSize];
    valid = static_cast<std::uint16_t>(valid | 1U << (i % shadow::kGroupSize));
  }
}

}  // namespace laterna::shade
