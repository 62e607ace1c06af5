#include "scene/node_selection.h"

#include <fmt/format.h>

#include <string_view>

#include "scene/spelling.h"

namespace laterna {
namespace {

// Everything below a chosen node is chosen too. Each chain upward is walked once.
void choose_descendants(const Scene& scene, std::vector<bool>& is_chosen) {
  std::vector<bool> is_decided = is_chosen;
  std::vector<std::size_t> path;
  for (std::size_t start = 0; start < scene.nodes.size(); ++start) {
    path.clear();
    auto node = static_cast<int>(start);
    while (node >= 0 && !is_decided[static_cast<std::size_t>(node)]) {
      path.push_back(static_cast<std::size_t>(node));
      node = scene.nodes[static_cast<std::size_t>(node)].parent;
    }
    const bool chosen = node >= 0 && is_chosen[static_cast<std::size_t>(node)];
    for (const std::size_t at : path) {
      is_chosen[at] = chosen;
      is_decided[at] = true;
    }
  }
}

}  // namespace

std::vector<bool> nodes_called(const Scene& scene, const std::string& name) {
  std::vector<bool> is_called(scene.nodes.size(), false);
  bool any = false;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) any |= is_called[i] = scene.nodes[i].name == name;
  if (any) return is_called;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const int mesh = scene.nodes[i].mesh;
    is_called[i] = mesh >= 0 && scene.meshes[static_cast<std::size_t>(mesh)].name == name;
  }
  return is_called;
}

std::vector<bool> select_nodes(const Scene& scene, const std::string& name) {
  std::vector<bool> is_chosen = nodes_called(scene, name);
  choose_descendants(scene, is_chosen);
  return is_chosen;
}

std::string no_such_node(const Scene& scene, const std::string& name) {
  std::vector<std::string_view> names;
  names.reserve(scene.nodes.size() + scene.meshes.size());
  for (const Node& node : scene.nodes) names.push_back(node.name);
  for (const Mesh& mesh : scene.meshes) names.push_back(mesh.name);
  return fmt::format("the scene has no node named {}{}", in_quotes(name), did_you_mean(name, names));
}

}  // namespace laterna
