// A grid of heights as right triangles, as few as an error allows.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "laterna/terrain.h"

namespace laterna {

/// Column and row of a sample.
struct GridPoint {
  int x, z;
};

/// Every triangle has its right angle across from its longest edge, and is halved at that edge's middle. A middle belongs to
/// the triangles on both sides. It is kept where its own deviation, with the largest sum of those of middles inside, exceeds
/// the error: so the middles between which it lies are kept too, both sides agree, and there are no cracks. A sample that is
/// left out lies within the error of the surface: from middle to middle on the way to it, deviations add up to no more.
class RightTriangulation {
 public:
  /// `map` outlives it, and is as make_terrain() demands.
  explicit RightTriangulation(const HeightMap& map);

  /// Corners counter-clockwise seen from above, where rows run toward the viewer.
  using Take = std::function<void(GridPoint a, GridPoint b, GridPoint c)>;
  void for_each(double error, const Take& take) const;

 private:
  [[nodiscard]] std::size_t index(GridPoint p) const {
    return static_cast<std::size_t>(p.z) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(p.x);
  }
  void add_middles_of_edges(int scale);
  void add_middles_of_squares(int scale);
  void add_middle(GridPoint at, GridPoint from, GridPoint to, const std::array<GridPoint, 4>& inside);
  [[nodiscard]] bool sticks_out(GridPoint a, GridPoint b, GridPoint c) const;
  void halve(GridPoint a, GridPoint b, GridPoint c, double error, const Take& take) const;

  const HeightMap& map_;
  int square_;               // side of the squares that are halved first
  int columns_, rows_;       // of the map, rounded up to whole squares
  std::vector<float> sums_;  // of each middle: its deviation and the largest sum of those inside
};

}  // namespace laterna
