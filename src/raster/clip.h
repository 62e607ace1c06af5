// Clipping in homogeneous space, before the division (Blinn and Newell, Clipping using homogeneous coordinates, 1978).
#pragma once

#include <array>
#include <cstddef>

namespace laterna::raster {

/// Pixel-homogeneous position: pixel = x/w, y/w. `near_side` is at least 0 on the visible side of the near plane.
/// `cut_side` likewise of the plane of a CuttingPlane, where there is one.
struct ClipVertex {
  double x, y, w, near_side;
  double cut_side = 1;
};

/// A triangle cut by up to six planes: the near plane, the four sides of the guard band and a CuttingPlane.
struct ClippedPolygon {
  std::array<ClipVertex, 9> vertices;
  /// Set where the vertex is a corner of the triangle (0, 1, 2), −1 where clipping made it: corners keep the exact
  /// position their neighbours have.
  std::array<int, 9> corner;
  std::size_t count = 0;
};

/// The part of the triangle in front of the near plane and within ±guard_band pixels, and where `is_cut` on the inner side
/// of the cutting plane; count < 3 when nothing is left.
ClippedPolygon clip_triangle(const std::array<ClipVertex, 3>& triangle, double guard_band,
                             bool is_cut = false);

}  // namespace laterna::raster
