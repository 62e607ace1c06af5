// Parts of pictures.
#pragma once

namespace laterna::light {

/// Pixels of a picture; ends excluded.
struct PixelBox {
  int x_begin = 0, y_begin = 0, x_end = 0, y_end = 0;
  [[nodiscard]] bool is_empty() const { return x_begin >= x_end || y_begin >= y_end; }
};

}  // namespace laterna::light
