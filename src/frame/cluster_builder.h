// Cuts a triangle list into clusters of neighbouring triangles (base/triangle_clusters.h). Done once per primitive;
// each instance of it is then a plain transform of the same lists.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include "base/task_pool.h"
#include "laterna/scene.h"

namespace laterna::frame {

/// One primitive's clusters, before it has a place in the world.
struct ClusteredPrimitive {
  struct Extent {
    std::uint32_t first_vertex;  // into source_vertices
    std::uint16_t vertex_count, triangle_count;
  };
  std::vector<Extent> clusters;
  std::vector<std::uint32_t> source_vertices;  // the primitive's vertex behind each cluster vertex
  std::vector<std::uint32_t> corners;  // kTrianglesPerCluster per cluster, packed, padded with 0 (degenerate)
};

/// `indices` may be empty: positions then come in triples. Triangles whose indices repeat are dropped. The order
/// depends on the input alone.
ClusteredPrimitive build_clusters(std::span<const glm::vec3> positions,
                                  std::span<const std::uint32_t> indices);

/// All primitives of a scene, by mesh and primitive.
using ClusteredMeshes = std::vector<std::vector<ClusteredPrimitive>>;
ClusteredMeshes build_clusters(const Scene& scene, const TaskPool& pool);

/// The same as tasks, for whoever has others to do at the same time.
class MeshClustering {
 public:
  /// The scene must outlive this.
  explicit MeshClustering(const Scene& scene);

  /// One per primitive.
  [[nodiscard]] std::size_t task_count() const { return primitives_.size(); }
  /// Tasks do not depend on one another, and each is run once.
  void run(std::size_t task);
  /// After all tasks.
  ClusteredMeshes take() { return std::move(meshes_); }

 private:
  struct Place {
    std::size_t mesh, primitive;
  };

  const Scene& scene_;
  std::vector<Place> primitives_;
  ClusteredMeshes meshes_;
};

}  // namespace laterna::frame
