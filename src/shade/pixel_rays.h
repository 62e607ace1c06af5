// A view's pixel rays in single precision, as kernels read them.
#pragma once

#include "raster/raster_view.h"

namespace laterna::shade {

/// Fields as in RasterView.
struct PixelRays {
  explicit PixelRays(const raster::RasterView& view);

  bool is_orthographic;
  float eye[3], axis[3], direction_0[3], direction_x[3], direction_y[3];
  float x_row[3], y_row[3], w_row[3], x_add, y_add, near;
};

}  // namespace laterna::shade
