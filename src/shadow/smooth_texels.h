// Smoothing of silhouettes: Chen and Tung, Real-time shadow rendering using projective texture, figures 5 and 6.
#pragma once

#include <vector>

#include "laterna/shadows.h"

namespace laterna::shadow {

/// A picture of how much light passes, rows from the top; beyond its sides all does.
struct ArrivingLight {
  int width = 0, height = 0;
  std::vector<float> values;
};

/// Every value becomes a mean of its surroundings, `passes` times.
void smooth(ArrivingLight& picture, int passes, SmoothKernel kernel);

}  // namespace laterna::shadow
