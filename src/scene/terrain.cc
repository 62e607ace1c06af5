#include "laterna/terrain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/right_triangulation.h"

namespace laterna {
namespace {

std::string find_fault(const HeightMap& map, const TerrainShape& shape) {
  const bool has_size = map.columns >= 2 && map.rows >= 2;
  const std::size_t samples =
      has_size ? static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows) : 0;
  if (!has_size || samples > kMaxHeightSamples || samples != map.heights.size()) {
    return fmt::format("expected 2 x 2 to {} heights, got {} of a map of {} x {}", kMaxHeightSamples,
                       map.heights.size(), map.columns, map.rows);
  }
  const auto is_length = [](double metres) { return metres > 0 && metres <= kMaxCoordinate; };
  if (!is_length(shape.width) || !is_length(shape.depth))
    return fmt::format("expected a size greater than 0 m, got {} x {}", shape.width, shape.depth);
  if (!(shape.error >= 0)) return fmt::format("expected an error of 0 m or more, got {}", shape.error);
  const auto is_bad = [](float h) { return !(std::abs(h) <= static_cast<float>(kMaxCoordinate)); };
  if (std::any_of(map.heights.begin(), map.heights.end(), is_bad))
    return "expected heights that are finite and no larger than coordinates may be";
  return {};
}

// One vertex for each sample that a triangle uses.
class Vertices {
 public:
  Vertices(const HeightMap& map, const TerrainShape& shape, Primitive& primitive)
      : map_(map), shape_(shape), primitive_(primitive), vertex_of_(map.heights.size(), kNone) {}

  std::uint32_t at(GridPoint point) {
    std::uint32_t& vertex = vertex_of_[index(point.x, point.z)];
    if (vertex == kNone) {
      vertex = static_cast<std::uint32_t>(primitive_.positions.size());
      add(point);
    }
    return vertex;
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  [[nodiscard]] std::size_t index(int x, int z) const {
    return static_cast<std::size_t>(z) * static_cast<std::size_t>(map_.columns) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] double height(int x, int z) const { return map_.heights[index(x, z)]; }

  void add(GridPoint p) {
    const double u = static_cast<double>(p.x) / (map_.columns - 1),
                 v = static_cast<double>(p.z) / (map_.rows - 1);
    primitive_.positions.emplace_back((u - 0.5) * shape_.width, height(p.x, p.z), (v - 0.5) * shape_.depth);
    primitive_.uv[0].emplace_back(u, v);
    const int left = std::max(p.x - 1, 0), right = std::min(p.x + 1, map_.columns - 1);
    const int up = std::max(p.z - 1, 0), down = std::min(p.z + 1, map_.rows - 1);
    const double slope_x =
        (height(right, p.z) - height(left, p.z)) * (map_.columns - 1) / ((right - left) * shape_.width);
    const double slope_z =
        (height(p.x, down) - height(p.x, up)) * (map_.rows - 1) / ((down - up) * shape_.depth);
    const double length = std::sqrt(slope_x * slope_x + 1 + slope_z * slope_z);
    primitive_.normals.emplace_back(-slope_x / length, 1 / length, -slope_z / length);
  }

  const HeightMap& map_;
  const TerrainShape& shape_;
  Primitive& primitive_;
  std::vector<std::uint32_t> vertex_of_;
};

}  // namespace

Result<Primitive> make_terrain(const HeightMap& map, const TerrainShape& shape) {
  if (std::string text = find_fault(map, shape); !text.empty())
    return tl::unexpected(Error(Failure::bad_input, Diagnostic{{}, {}, std::move(text)}));
  Primitive primitive;
  Vertices vertices(map, shape, primitive);
  RightTriangulation(map).for_each(shape.error, [&](GridPoint a, GridPoint b, GridPoint c) {
    for (const GridPoint corner : {a, b, c}) primitive.indices.push_back(vertices.at(corner));
  });
  return primitive;
}

}  // namespace laterna
