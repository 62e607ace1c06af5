// scenes[] and nodes[] of a glTF file: which nodes are shown, in which order, and where they stand.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "laterna/scene.h"
#include "scene/fault_list.h"
#include "scene/gltf_accessors.h"
#include "scene/json_document.h"

namespace laterna::gltf {

/// A node of the file that the default scene shows.
struct PlacedNode {
  const JsonValue* json = nullptr;
  int parent = -1;  ///< into the same list, always before the node itself
};

/// scenes[] of `scene`, else the first; null where the file has none.
const JsonValue* default_scene(const JsonDocument& json, FaultList& faults);

/// The nodes below the default scene's roots (`scene`, else scene 0, else every root node), parents first.
/// Faults: cycles, nodes with two parents, indices out of range. Works without recursion, however deep the
/// tree.
std::vector<PlacedNode> placed_nodes(const JsonDocument& json, FaultList& faults);

/// Where a node stands in its parent.
struct NodePlace {
  glm::dmat4 parent_from_node{1.0};
  std::optional<Transform> transform;  ///< where it is given by translation, rotation and scale
};
NodePlace node_place(const JsonDocument& json, const JsonValue& node, FaultList& faults);

/// Instances in one file: 2 GB of matrices.
inline constexpr std::uint64_t kMaxInstances = std::uint64_t{1} << 24;

/// EXT_mesh_gpu_instancing; empty without it. More than `room` instances are an error.
std::vector<glm::dmat4> node_instances(const JsonDocument& json, const JsonValue& node, Accessors& accessors,
                                       std::uint64_t room, FaultList& faults);

}  // namespace laterna::gltf
