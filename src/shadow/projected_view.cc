#include "shadow/projected_view.h"

#include <glm/geometric.hpp>

namespace laterna::shadow {

ProjectedRow::ProjectedRow(const glm::dvec4& row, const raster::RasterView::Ray& ray)
    : at_0(static_cast<float>(glm::dot(row, ray.ray_0))),
      at_x(static_cast<float>(glm::dot(row, ray.ray_x))),
      at_y(static_cast<float>(glm::dot(row, ray.ray_y))),
      at_q(static_cast<float>(glm::dot(row, ray.q_term))) {}

PixelRows::PixelRows(const raster::RasterView& view)
    : x(view.x_row, view.x_add - glm::dot(view.x_row, view.eye_ws)),
      y(view.y_row, view.y_add - glm::dot(view.y_row, view.eye_ws)),
      w(view.w_row, view.w_add - glm::dot(view.w_row, view.eye_ws)) {}

ProjectedRow homogeneous_row(const raster::RasterView::Ray& ray) { return {glm::dvec4(0, 0, 0, 1), ray}; }

}  // namespace laterna::shadow
