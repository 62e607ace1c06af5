// Meshes and instances of a scene, cut into clusters and carried into world space.
#pragma once

#include <functional>
#include <glm/mat4x4.hpp>

#include "frame/frame.h"

namespace laterna::frame {

/// Clusters of all instances.
std::size_t count_clusters(const Scene& scene, const ClusteredMeshes& meshes);

/// Calls visit(node, instance, world_from_object) for each instance of a mesh, in the order of the frame's objects; its
/// primitives follow one another in the order of the frame's clusters. world_from_object of a mesh with a skin is its first
/// joint's.
void for_each_object(const Scene& scene, const std::vector<glm::dmat4>& world_from_node,
                     const std::function<void(const Node& node, std::size_t instance,
                                              const glm::dmat4& world_from_object)>& visit);
/// Whether an instance turns its triangles round: their second and third corners are then swapped.
bool is_mirroring(const glm::dmat4& world_from_object);

/// Fills the frame's vertices, corners, clusters, streams, object names, moving parts and bounds.
void flatten_meshes(const Scene& scene, const ClusteredMeshes& meshes,
                    const std::vector<glm::dmat4>& world_from_node, const TaskPool& pool, Frame& frame);

/// Adds to the frame's moving parts those of other nodes, before they move for the first time. `moves`: one for each of the scene's nodes.
/// The scene is as the frame has it.
void let_move(const Scene& scene, const ClusteredMeshes& meshes, const std::vector<bool>& moves,
              Frame& frame);

/// Writes those of the frame's moving parts anew whose pose has changed, and the bounds.
Reposed repose_meshes(const Scene& scene, const std::vector<glm::dmat4>& world_from_node,
                      const TaskPool& pool, Frame& frame);

}  // namespace laterna::frame
