#include "shade/pixel_rays.h"

namespace laterna::shade {

PixelRays::PixelRays(const raster::RasterView& v)
    : is_orthographic(v.is_orthographic),
      x_add(static_cast<float>(v.x_add)),
      y_add(static_cast<float>(v.y_add)),
      near(static_cast<float>(v.view.projection.near)) {
  for (int i = 0; i < 3; ++i) {
    eye[i] = static_cast<float>(v.eye_ws[i]);
    axis[i] = static_cast<float>(v.axis_ws[i]);
    direction_0[i] = static_cast<float>(v.direction_0[i]);
    direction_x[i] = static_cast<float>(v.direction_x[i]);
    direction_y[i] = static_cast<float>(v.direction_y[i]);
    x_row[i] = static_cast<float>(v.x_row[i]);
    y_row[i] = static_cast<float>(v.y_row[i]);
    w_row[i] = static_cast<float>(v.w_row[i]);
  }
}

}  // namespace laterna::shade
