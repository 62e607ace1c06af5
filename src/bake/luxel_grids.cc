#include "bake/luxel_grids.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace laterna::bake {
namespace {

// A cell's side over that of an object's luxels.
constexpr float kCellSide = 0.7F;
// Nodes for each luxel and each triangle at most, both sides together; where there would be more cells are made larger.
constexpr std::uint64_t kMostPerLuxel = 16;
constexpr std::uint64_t kMostPerTriangle = 8;
constexpr float kMostAlong = 32768;

std::uint32_t cell_of(float weight, std::uint32_t count) {
  const float cell = std::max(0.0F, weight) * static_cast<float>(count);
  return std::min(count - 1, static_cast<std::uint32_t>(cell));
}

}  // namespace

LuxelGrids::LuxelGrids(const frame::Frame& frame, const LuxelTree& tree, const TaskPool& pool)
    : frame_(frame), tree_(tree), grids_(frame.clusters.size() * kTrianglesPerCluster) {
  const std::uint64_t most = kMostPerLuxel * tree.luxels().size() + kMostPerTriangle * grids_.size();
  float side = kCellSide;
  std::uint64_t count = lay_out(side);
  for (; count > most; count = lay_out(side)) side *= 2;
  places_.resize(count, kNoLuxel);
  pool.for_each(frame.clusters.size(), [&](std::size_t cluster, int) {
    for (std::uint32_t t = 0; t < frame.clusters[cluster].triangle_count; ++t)
      fill(static_cast<TriangleId>(cluster) << kTriangleBits | t);
  });
}

// Returns how many nodes there are. `cell_side`: in luxels.
std::uint64_t LuxelGrids::lay_out(float cell_side) {
  std::uint64_t count = 0;
  for (std::uint32_t c = 0; c < frame_.clusters.size(); ++c) {
    const Cluster& cluster = frame_.clusters[c];
    const float luxel_side = std::sqrt(tree_.mean_area(cluster.object));
    if (!is_opaque_caster(cluster) || !(luxel_side > 0)) continue;
    for (std::uint32_t t = 0; t < cluster.triangle_count; ++t) {
      const TriangleId id = c << kTriangleBits | t;
      const glm::vec3 a = frame_.corner_ws(id, 0);
      const auto cells_along = [&](unsigned corner) {
        const float length = glm::length(frame_.corner_ws(id, corner) - a);
        return static_cast<std::uint32_t>(
            std::clamp(std::ceil(length / (cell_side * luxel_side)), 1.0F, kMostAlong));
      };
      grids_[id] = {count, cells_along(1), cells_along(2)};
      count += 2 * grids_[id].node_count();
    }
  }
  return count;
}

// Its front, the side on which corners run counter-clockwise. Of a triangle without area the normal is 0.
MetSurface LuxelGrids::surface_at(TriangleId id, float b, float c) const {
  const glm::vec3 a = frame_.corner_ws(id, 0);
  const glm::vec3 along_b = frame_.corner_ws(id, 1) - a;
  const glm::vec3 along_c = frame_.corner_ws(id, 2) - a;
  const glm::vec3 cross = glm::cross(along_b, along_c);
  const float length = glm::length(cross);
  return {a + along_b * b + along_c * c, length > 0 ? cross / length : glm::vec3(0),
          frame_.clusters[cluster_of(id)].object};
}

void LuxelGrids::fill(TriangleId id) {
  const Grid& grid = grids_[id];
  if (grid.columns == 0) return;
  for (std::uint32_t row = 0; row <= grid.rows; ++row) {
    for (std::uint32_t column = 0; column <= grid.columns; ++column) {
      const float step_b = 1 / static_cast<float>(grid.columns);
      const float step_c = 1 / static_cast<float>(grid.rows);
      const float b = static_cast<float>(column) * step_b;
      const float c = static_cast<float>(row) * step_c;
      if (b + c > 1 + 1.01F * (step_b + step_c)) continue;  // of no cell that the triangle touches
      MetSurface met = surface_at(id, b, c);
      const std::uint64_t node = grid.first + std::uint64_t{row} * (grid.columns + 1) + column;
      places_[node] = tree_.find(met).value_or(kNoLuxel);
      met.normal_ws *= -1.0F;
      places_[node + grid.node_count()] = tree_.find(met).value_or(kNoLuxel);
    }
  }
}

std::uint32_t LuxelGrids::place_at(const trace::RayScene::Hit& hit, const glm::vec3& direction_ws) const {
  const Grid& grid = grids_[hit.id];
  if (grid.columns == 0) return kNoLuxel;
  const MetSurface met = surface_at(hit.id, hit.b, hit.c);
  const std::uint64_t below = grid.columns + std::uint64_t{1};
  std::uint64_t node = grid.first + cell_of(hit.c, grid.rows) * below + cell_of(hit.b, grid.columns);
  if (glm::dot(met.normal_ws, direction_ws) > 0) node += grid.node_count();
  std::uint32_t nearest = kNoLuxel;
  float least = std::numeric_limits<float>::infinity();
  for (const std::uint64_t at : {node, node + 1, node + below, node + below + 1}) {
    const std::uint32_t place = places_[at];
    if (place == kNoLuxel || place == nearest) continue;
    const float distance = tree_.squared_distance(met, place);
    if (distance >= least) continue;
    least = distance;
    nearest = place;
  }
  return nearest;
}

}  // namespace laterna::bake
