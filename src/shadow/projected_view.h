// Equation 6 of Segal et al. 1992: coordinates in a light's (or any other) view, straight from the camera's pixel.
//
// Along a surface seen by a camera, x^l/w, y^l/w and w^l/w are affine in the screen position; the texture coordinates
// are their quotients. They split into an affine function that belongs to the two views alone, A(x, y), plus 1/w, the
// depth that was rasterised anyway, times a constant E. So no plane equations are set up per triangle and light; each
// pixel costs two multiplications per coordinate and one division, whatever the triangle's size.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "raster/raster_view.h"

namespace laterna::shadow {

/// value(x, y, q) = at_0 + at_x x + at_y y + at_q q.
struct ProjectedRow {
  float at_0 = 0, at_x = 0, at_y = 0, at_q = 0;

  ProjectedRow() = default;
  /// `row` is a row of a matrix over homogeneous world points.
  ProjectedRow(const glm::dvec4& row, const raster::RasterView::Ray& ray);
};

/// Two coordinates and their divisor.
struct ProjectedView {
  ProjectedRow x, y, divisor;
};

/// Rows over homogeneous world points that give pixel-homogeneous X, Y and W of a raster view; in an orthographic one
/// W is the reversed depth.
struct PixelRows {
  glm::dvec4 x, y, w;
  explicit PixelRows(const raster::RasterView& view);
};

/// The fourth homogeneous coordinate itself: 1/w of a perspective camera, 1 of an orthographic one.
ProjectedRow homogeneous_row(const raster::RasterView::Ray& ray);

}  // namespace laterna::shadow
