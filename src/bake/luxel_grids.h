// Which luxel stands for a point of a triangle, known beforehand: rays ask this more often than anything else.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bake/luxel_tree.h"
#include "base/task_pool.h"
#include "trace/ray_scene.h"

namespace laterna::bake {

inline constexpr std::uint32_t kNoLuxel = 0x7FFFFFFFU;

/// Triangles carry grids over their weights b and c, somewhat finer than luxels. Each node, on each side, holds what
/// LuxelTree::find() says of it. Of what the four nodes about a point hold, the nearest is what find() would say, but for a
/// few points between luxels at odd angles, where it is the next.
class LuxelGrids {
 public:
  LuxelGrids(const frame::Frame& frame, const LuxelTree& tree, const TaskPool& pool);

  /// The luxel that stands for what a ray of that direction has met, on the side that it came from; kNoLuxel where none does.
  [[nodiscard]] std::uint32_t place_at(const trace::RayScene::Hit& hit, const glm::vec3& direction_ws) const;

 private:
  // Nodes run along b, then along c; of the back they follow those of the front.
  struct Grid {
    std::uint64_t first = 0;
    std::uint32_t columns = 0, rows = 0;  // of cells; 0: all is kNoLuxel
    [[nodiscard]] std::uint64_t node_count() const {
      return (columns + std::uint64_t{1}) * (rows + std::uint64_t{1});
    }
  };

  [[nodiscard]] std::uint64_t lay_out(float cell_side);
  void fill(TriangleId id);
  [[nodiscard]] MetSurface surface_at(TriangleId id, float b, float c) const;

  const frame::Frame& frame_;
  const LuxelTree& tree_;
  std::vector<Grid> grids_;            // by triangle
  std::vector<std::uint32_t> places_;  // by node
};

}  // namespace laterna::bake
