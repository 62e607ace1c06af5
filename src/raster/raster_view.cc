#include "raster/raster_view.h"

#include <cmath>

namespace laterna::raster {

RasterView::RasterView(const View& from, int pixels_wide, int pixels_high)
    : view(from),
      width(pixels_wide),
      height(pixels_high),
      origin_x(pixels_wide / 2),
      origin_y(pixels_high / 2),
      is_orthographic(from.projection.is_orthographic),
      eye_ws(from.pose.position_ws) {
  const Projection& p = view.projection;
  const glm::dvec3 right = view.pose.right_ws();
  const glm::dvec3 up = view.pose.up_ws();
  const glm::dvec3 forward = view.pose.forward_ws();
  const double pixels_per_x = width / (p.right - p.left);  // pixels per metre at distance 1, or per metre
  const double pixels_per_y = height / (p.top - p.bottom);
  const double shift_x = -p.left * pixels_per_x - origin_x;
  const double shift_y = p.top * pixels_per_y - origin_y;

  direction_x = right / pixels_per_x;
  direction_y = -up / pixels_per_y;
  const glm::dvec3 middle = -(shift_x * direction_x) - (shift_y * direction_y);
  if (is_orthographic) {
    x_row = right * pixels_per_x;
    y_row = -up * pixels_per_y;
    w_row = -forward;
    x_add = shift_x;
    y_add = shift_y;
    w_add = p.far;
    reversed_near = static_cast<float>(p.far - p.near);
    reversed_far = 0;
    direction_0 = eye_ws + middle + forward * p.far;
    axis_ws = -forward;
  } else {
    x_row = right * pixels_per_x + forward * shift_x;
    y_row = -up * pixels_per_y + forward * shift_y;
    w_row = forward;
    reversed_near = static_cast<float>(1 / p.near);
    reversed_far = std::isinf(p.far) ? 0.0F : static_cast<float>(1 / p.far);
    direction_0 = middle + forward;
  }
}

double RasterView::distance_from_reversed(double reversed_depth) const {
  return is_orthographic ? view.projection.far - reversed_depth : 1 / reversed_depth;
}

double RasterView::reversed_from_distance(double distance) const {
  return is_orthographic ? view.projection.far - distance : 1 / distance;
}

RasterView::Ray RasterView::homogeneous_ray() const {
  const double w = is_orthographic ? 1 : 0;
  return {glm::dvec4(direction_0, w), glm::dvec4(direction_x, 0), glm::dvec4(direction_y, 0),
          is_orthographic ? glm::dvec4(axis_ws, 0) : glm::dvec4(eye_ws, 1)};
}

}  // namespace laterna::raster
