// The nearest that a light sees anywhere in a square of texels: bounds how far off what stands before a sample can matter.
// Guennebaud, Barthe and Paulin, Real-time soft shadow mapping by backprojection, 2006, call it a hierarchical shadow map.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/task_pool.h"
#include "shadow/depth_map.h"

namespace laterna::shadow {

class NearestPyramid {
 public:
  NearestPyramid() = default;
  /// Of a map whose tiles are all drawn.
  NearestPyramid(const DepthMap& map, const TaskPool& pool);

  /// The largest reversed depth of the whole map.
  [[nodiscard]] float nearest() const { return levels_.back().cells[0]; }
  /// No less than the largest reversed depth of the texels from (x − reach, y − reach) to (x + reach, y + reach). What
  /// lies outside the map does not count.
  [[nodiscard]] float nearest_about(float x, float y, float reach) const;
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  // Cells of a level are 2^(kFirstLevel + level) texels wide.
  struct Level {
    int width = 0, height = 0;
    std::vector<float> cells;
  };
  static constexpr int kFirstLevel = 2;  // DepthMap's blocks

  std::vector<Level> levels_;  // the last is one cell
};

/// Those of one light's maps.
struct NearestPyramids {
  /// All tiles of the maps are drawn.
  NearestPyramids(std::span<const std::shared_ptr<DepthMap>> maps, const TaskPool& pool);
  [[nodiscard]] std::size_t memory_bytes() const;

  std::vector<NearestPyramid> of_map;
};

}  // namespace laterna::shadow
