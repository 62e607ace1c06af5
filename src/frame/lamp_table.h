// A measured lamp as kernels look it up: its own grid of angles, in single precision. Nothing is resampled, so that a
// look-up is the file's bilinear interpolation up to rounding, however fine or uneven the grid.
#pragma once

#include <cstdint>

#include "base/aligned_vector.h"
#include "laterna/lamps.h"

namespace laterna::frame {

/// One list of angles. Which two an angle lies between is found through bins of equal width, each with the first cell
/// that touches it; from there at most `steps` cells lead on.
struct LampAxis {
  explicit LampAxis(const std::vector<double>& angles_deg);

  AlignedVector<float> angle_deg;
  AlignedVector<float> inverse_width;  // per cell
  AlignedVector<std::int32_t> cell_of_bin;
  float bins_per_degree = 0;
  int steps = 0;

  [[nodiscard]] std::int32_t last_cell() const { return static_cast<std::int32_t>(inverse_width.size()) - 1; }
  [[nodiscard]] std::int32_t last_bin() const { return static_cast<std::int32_t>(cell_of_bin.size()) - 1; }
};

struct LampTable {
  explicit LampTable(const LightDistribution& distribution);

  PhotometricType type;
  LampAxis vertical, horizontal;
  AlignedVector<float> share;  // of the peak, vertical angles of the first horizontal one first
  double peak_candela = 0;
  double lumens = 0;
};

}  // namespace laterna::frame
