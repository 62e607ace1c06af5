#include "bake/own_meshes.h"

#include <algorithm>
#include <utility>

namespace laterna::bake {
namespace {

// Instances become children of the node that has them.
void make_nodes_of_instances(Scene& scene) {
  for (std::size_t i = 0, count = scene.nodes.size(); i < count; ++i) {
    if (scene.nodes[i].mesh < 0 || scene.nodes[i].node_from_instance.empty()) continue;
    const std::vector<glm::dmat4> instances = std::move(scene.nodes[i].node_from_instance);
    scene.nodes[i].node_from_instance.clear();
    Node child = scene.nodes[i];
    child.parent = static_cast<int>(i);
    child.camera = child.light = -1;
    child.transform.reset();
    for (const glm::dmat4& matrix : instances) {
      child.parent_from_node = matrix;
      scene.nodes.push_back(child);
    }
    scene.nodes[i].mesh = -1;
  }
}

}  // namespace

std::vector<PlacedMesh> take_apart(Scene& scene) {
  make_nodes_of_instances(scene);
  const std::vector<glm::dmat4> world_from_node = world_from_nodes(scene);
  std::vector<bool> is_taken(scene.meshes.size(), false);
  std::vector<PlacedMesh> placed;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    Node& node = scene.nodes[i];
    if (node.mesh < 0) continue;
    const auto mesh = static_cast<std::size_t>(node.mesh);
    if (is_taken[mesh]) {
      node.mesh = static_cast<int>(scene.meshes.size());
      Mesh copy = scene.meshes[mesh];
      scene.meshes.push_back(std::move(copy));
    }
    is_taken[mesh] = true;
    if (node.visible) placed.push_back({static_cast<std::size_t>(node.mesh), world_from_node[i], node.name});
  }
  return placed;
}

}  // namespace laterna::bake
