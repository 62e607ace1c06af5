// Meshes and instances of a scene, cut into clusters and carried into world space.
#pragma once

#include "frame/frame.h"

namespace laterna::frame {

/// Clusters of all instances.
std::size_t count_clusters(const Scene& scene, const ClusteredMeshes& meshes);

/// Fills the frame's vertices, corners, clusters, streams, object names and bounds.
void flatten_meshes(const Scene& scene, const ClusteredMeshes& meshes,
                    const std::vector<glm::dmat4>& world_from_node, const TaskPool& pool, Frame& frame);

}  // namespace laterna::frame
