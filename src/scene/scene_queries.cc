// Questions that several rooms ask of a scene.
#include "laterna/scene.h"

namespace laterna {
namespace {

// The node whose `member` refers to the thing of that name, or else a node of that name that has one.
template <class Named>
int find_node(const Scene& scene, const std::vector<Named>& things, int Node::*member,
              const std::string& name) {
  int by_node_name = -1;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (node.*member < 0) continue;
    if (things[static_cast<std::size_t>(node.*member)].name == name) return static_cast<int>(i);
    if (node.name == name && by_node_name < 0) by_node_name = static_cast<int>(i);
  }
  return by_node_name;
}

}  // namespace

std::vector<glm::dmat4> world_from_nodes(const Scene& scene) {
  const std::size_t count = scene.nodes.size();
  std::vector<glm::dmat4> world_from_node(count);
  std::vector<bool> is_known(count, false);
  std::vector<std::size_t> path;  // from a node up to the first whose parent is known
  for (std::size_t start = 0; start < count; ++start) {
    path.clear();
    for (auto node = static_cast<int>(start); node >= 0 && !is_known[static_cast<std::size_t>(node)];
         node = scene.nodes[static_cast<std::size_t>(node)].parent) {
      path.push_back(static_cast<std::size_t>(node));
    }
    for (auto at = path.rbegin(); at != path.rend(); ++at) {
      const Node& node = scene.nodes[*at];
      world_from_node[*at] =
          node.parent < 0 ? node.parent_from_node
                          : world_from_node[static_cast<std::size_t>(node.parent)] * node.parent_from_node;
      is_known[*at] = true;
    }
  }
  return world_from_node;
}

int find_camera_node(const Scene& scene, const std::string& name) {
  return find_node(scene, scene.cameras, &Node::camera, name);
}

int find_light_node(const Scene& scene, const std::string& name) {
  return find_node(scene, scene.lights, &Node::light, name);
}

}  // namespace laterna
