#include "scene/right_triangulation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace laterna {
namespace {

constexpr int kLargestSquare = 256;
// Sums are kept in single precision; they may be a little too large, but not too small.
constexpr double kRoundingUp = 1 + 1e-6;

int whole_squares(int samples, int square) { return (samples - 1 + square - 1) / square * square + 1; }

// Which way the longest edge of a square's two triangles runs: from its first corner or across. So each square of 2^n has
// those of its quarters meet in its middle.
bool runs_from_first_corner(int column, int row) { return (column + row) % 2 == 0; }

GridPoint middle(GridPoint a, GridPoint b) { return {(a.x + b.x) / 2, (a.z + b.z) / 2}; }

}  // namespace

RightTriangulation::RightTriangulation(const HeightMap& map)
    : map_(map),
      square_(std::min(kLargestSquare, static_cast<int>(std::bit_ceil(
                                           static_cast<unsigned>(std::max(map.columns, map.rows) - 1))))),
      columns_(whole_squares(map.columns, square_)),
      rows_(whole_squares(map.rows, square_)),
      sums_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
  // What lies inside comes first.
  for (int scale = 2; scale <= square_; scale *= 2) {
    add_middles_of_edges(scale);
    add_middles_of_squares(scale);
  }
}

// Between two corners of squares of side `scale`; inside are the middles of squares half as large.
void RightTriangulation::add_middles_of_edges(int scale) {
  const int half = scale / 2, quarter = scale / 4;
  for (int z = 0; z < rows_; z += half) {
    const bool is_row_of_corners = z % scale == 0;
    for (int x = is_row_of_corners ? half : 0; x < columns_; x += scale) {
      const GridPoint along = is_row_of_corners ? GridPoint{half, 0} : GridPoint{0, half};
      add_middle({x, z}, {x - along.x, z - along.z}, {x + along.x, z + along.z},
                 {{{x - quarter, z - quarter},
                   {x + quarter, z - quarter},
                   {x - quarter, z + quarter},
                   {x + quarter, z + quarter}}});
    }
  }
}

// Between two corners of one square; inside are the middles of its edges.
void RightTriangulation::add_middles_of_squares(int scale) {
  const int half = scale / 2;
  for (int z = half; z < rows_; z += scale) {
    for (int x = half; x < columns_; x += scale) {
      const int across = runs_from_first_corner(x / scale, z / scale) ? half : -half;
      add_middle({x, z}, {x - across, z - half}, {x + across, z + half},
                 {{{x - half, z}, {x + half, z}, {x, z - half}, {x, z + half}}});
    }
  }
}

void RightTriangulation::add_middle(GridPoint at, GridPoint from, GridPoint to,
                                    const std::array<GridPoint, 4>& inside) {
  float& sum = sums_[index(at)];
  for (const GridPoint& p : inside) {
    const bool is_there = p.x >= 0 && p.z >= 0 && p.x < columns_ && p.z < rows_;
    if (is_there) sum = std::max(sum, sums_[index(p)]);
  }
  // The two triangles' other corners lie square to the edge, half its length away.
  const int dx = (to.x - from.x) / 2, dz = (to.z - from.z) / 2;
  if (sticks_out(from, to, {at.x + dz, at.z - dx}) || sticks_out(from, to, {at.x - dz, at.z + dx})) {
    sum = std::numeric_limits<float>::infinity();
  } else if (to.x < map_.columns && from.x < map_.columns && to.z < map_.rows) {
    const auto height = [&](GridPoint p) {
      const std::size_t row = static_cast<std::size_t>(p.z) * static_cast<std::size_t>(map_.columns);
      return static_cast<double>(map_.heights[row + static_cast<std::size_t>(p.x)]);
    };
    const double deviation = std::abs(height(at) - (height(from) + height(to)) / 2);
    sum = static_cast<float>((sum + deviation) * kRoundingUp);
  }
}

// Whether a triangle is partly on the map and partly not. Where a map does not end with a whole square, those that do are
// halved down to single samples.
bool RightTriangulation::sticks_out(GridPoint a, GridPoint b, GridPoint c) const {
  const auto [left, right] = std::minmax({a.x, b.x, c.x});
  const auto [top, bottom] = std::minmax({a.z, b.z, c.z});
  const bool is_on_map = left < map_.columns - 1 && top < map_.rows - 1;
  return is_on_map && (right >= map_.columns || bottom >= map_.rows);
}

void RightTriangulation::for_each(double error, const Take& take) const {
  for (int z = 0; z + 1 < map_.rows; z += square_) {
    for (int x = 0; x + 1 < map_.columns; x += square_) {
      GridPoint corners[4] = {{x, z}, {x, z + square_}, {x + square_, z + square_}, {x + square_, z}};
      if (!runs_from_first_corner(x / square_, z / square_)) std::rotate(corners, corners + 1, corners + 4);
      halve(corners[0], corners[2], corners[3], error, take);
      halve(corners[2], corners[0], corners[1], error, take);
    }
  }
}

// a to b is the longest edge.
void RightTriangulation::halve(GridPoint a, GridPoint b, GridPoint c, double error, const Take& take) const {
  if (std::min({a.x, b.x, c.x}) >= map_.columns - 1 || std::min({a.z, b.z, c.z}) >= map_.rows - 1) return;
  const bool is_whole = std::abs(a.x - b.x) > 1 || std::abs(a.z - b.z) > 1;
  const GridPoint m = middle(a, b);
  if (is_whole && static_cast<double>(sums_[index(m)]) > error) {
    halve(c, a, m, error, take);
    halve(b, c, m, error, take);
  } else {
    take(a, b, c);
  }
}

}  // namespace laterna
