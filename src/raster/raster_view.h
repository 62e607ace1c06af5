// A View prepared for rasterising: world positions to pixels and back, and the depth that is interpolated.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "laterna/view.h"

namespace laterna::raster {

/// Pixel positions are counted from `origin`, the pixel corner at the middle of the picture: floats are most precise
/// there and the guard band is symmetric. x grows to the right, y downward. The centre of pixel (i, j) is at
/// (i − origin_x + 0.5, j − origin_y + 0.5).
///
/// The depth that is rasterised is *reversed depth*, an affine function of the pixel position on every plane, larger
/// when nearer: 1/w in a perspective view, w the distance along the axis; far − distance in an orthographic one.
/// Its relative precision is the same at every distance, so 1 cm at 9 km is told apart with near at 0.1 m (row 24).
struct RasterView {
  View view;
  int width = 0, height = 0;
  int origin_x = 0, origin_y = 0;
  bool is_orthographic = false;

  glm::dvec3 eye_ws{0};
  /// Rows over (position_ws − eye_ws): pixel-homogeneous X, Y and W (perspective: pixel = X/W, Y/W, reversed depth
  /// 1/W), or pixel x, y and reversed depth directly, with the additive terms (orthographic).
  glm::dvec3 x_row{0}, y_row{0}, w_row{0};
  double x_add = 0, y_add = 0, w_add = 0;

  /// Nothing is nearer than reversed_near or as far as reversed_far.
  float reversed_near = 0, reversed_far = 0;

  /// Inverse: world position = origin + direction / reversed depth (perspective, origin = eye) with
  /// direction(x, y) = direction_0 + direction_x x + direction_y y; orthographic: world position =
  /// direction(x, y) + reversed depth · axis.
  glm::dvec3 direction_0{0}, direction_x{0}, direction_y{0};
  glm::dvec3 axis_ws{0};  ///< orthographic: −forward

  RasterView() = default;
  RasterView(const View& view, int width, int height);

  /// Distance along the axis in metres; +infinity at reversed depth 0 of a perspective view.
  [[nodiscard]] double distance_from_reversed(double reversed_depth) const;
  [[nodiscard]] double reversed_from_distance(double distance) const;

  /// Homogeneous world point as an affine function of the pixel plus reversed depth times a constant:
  /// point(x, y, q) = ray_x x + ray_y y + ray_0 + q · q_term. Perspective: (direction, 0) + q (eye, 1), so the fourth
  /// coordinate is q = 1/w; orthographic: (direction, 1) + q (axis, 0).
  /// Multiplying all four by another view's matrix gives equation 6 of Segal et al. 1992 without any per-triangle
  /// set-up: x^l/w = A(x, y) + q E, where A and E belong to the pair of views and q = 1/w is the triangle's plane.
  struct Ray {
    glm::dvec4 ray_0, ray_x, ray_y, q_term;
  };
  [[nodiscard]] Ray homogeneous_ray() const;
};

}  // namespace laterna::raster
