// Which triangle lies across each edge of a triangle: for whoever walks over a surface.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>

#include "base/aligned_vector.h"
#include "base/task_pool.h"
#include "frame/cluster_builder.h"
#include "laterna/scene.h"

namespace laterna::frame {

/// Of all primitives of a scene, before they have a place in the world: instances share it, and it stays when nodes
/// move. Twelve bytes per triangle.
///
/// Edge k of a triangle runs from its corner k to the next. Triangles are neighbours where an edge's two ends have the
/// same positions, whatever normals and texture coordinates they carry: surfaces are mostly cut open where those
/// change. Neighbours are of one primitive.
struct MeshNeighbours {
  /// At [cluster · 128 + triangle][edge], clusters counted over all meshes' primitives in order: the neighbour's
  /// TriangleId less the triangle's own; 0: none. Where more than two triangles share an edge, a ring through them.
  /// One more is there than triangles, for kernels that read four numbers at once.
  AlignedVector<glm::ivec3> steps;
};

/// Depends on the scene alone. Empty where indices would not fit 32 bits.
MeshNeighbours find_mesh_neighbours(const Scene& scene, const ClusteredMeshes& meshes, const TaskPool& pool);

/// The same for a frame's triangles.
struct TriangleNeighbours {
  std::shared_ptr<const MeshNeighbours> meshes;
  /// One per cluster of the frame: its number among the meshes', doubled, and 1 more where the instance is mirrored:
  /// its second and third corners are swapped.
  AlignedVector<std::int32_t> sources;
};

/// `neighbours`: of the same scene and meshes.
TriangleNeighbours place_neighbours(std::shared_ptr<const MeshNeighbours> neighbours, const Scene& scene,
                                    const ClusteredMeshes& meshes);

}  // namespace laterna::frame
