// What shadow techniques know of everything that casts: found when one first asks, forgotten when casters move.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "base/task_pool.h"
#include "frame/cluster_builder.h"
#include "frame/frame.h"
#include "frame/triangle_neighbours.h"
#include "laterna/scene.h"
#include "shadow/caster_tree.h"
#include "trace/ray_scene.h"

namespace laterna::render {

/// Of the casters of one frame, as they stand now. May be asked by many threads at once.
class CasterStructures {
 public:
  /// All of these must outlive it.
  CasterStructures(const Scene& scene, const frame::Frame& frame, const frame::ClusteredMeshes& meshes,
                   const TaskPool& pool)
      : scene_(scene), frame_(frame), meshes_(meshes), pool_(pool) {}

  /// What is known is of how casters were: they have moved, or let light through elsewhere.
  void forget();
  /// The same, but that those casters without kMoves are as they were.
  void forget_movers();
  /// Counts what was forgotten: equal numbers are equal casters.
  [[nodiscard]] std::uint64_t revision() const { return revision_; }

  [[nodiscard]] std::shared_ptr<const trace::RayScene> ray_scene() const;
  /// Of opaque casters: those that stand, and those that move, where there are any.
  [[nodiscard]] std::vector<std::shared_ptr<const shadow::CasterTree>> caster_trees() const;
  [[nodiscard]] std::shared_ptr<const shadow::CasterTree> pane_tree() const;
  /// Which triangle lies across each edge. Valid until forget().
  [[nodiscard]] const frame::TriangleNeighbours* triangle_neighbours() const;

 private:
  const Scene& scene_;
  const frame::Frame& frame_;
  const frame::ClusteredMeshes& meshes_;
  const TaskPool& pool_;
  std::uint64_t revision_ = 0;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const trace::RayScene> rays_;
  mutable std::shared_ptr<const shadow::CasterTree> standing_, moving_, panes_;
  mutable std::shared_ptr<const frame::MeshNeighbours>
      mesh_neighbours_;  // of meshes at rest: never forgotten
  mutable std::unique_ptr<const frame::TriangleNeighbours> neighbours_;
};

}  // namespace laterna::render
