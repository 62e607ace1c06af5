#include "bake/still_meshes.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "frame/vertex_pose.h"

namespace laterna::bake {
namespace {

bool morphs(const Mesh& mesh) {
  return std::ranges::any_of(mesh.primitives, [](const Primitive& p) { return !p.targets.empty(); });
}

Primitive posed(const Primitive& from, const frame::MeshPose& pose) {
  Primitive still = from;
  frame::VertexPoser poser(from, pose);
  for (std::size_t v = 0; v < from.positions.size(); ++v) {
    poser.select(v);
    still.positions[v] = glm::vec3(poser.position_ws());
    if (!from.normals.empty()) still.normals[v] = glm::vec3(poser.normal_ws());
    if (!from.tangents.empty())
      still.tangents[v] = glm::vec4(glm::vec3(poser.tangent_ws()), from.tangents[v].w);
  }
  still.targets.clear();
  still.influences = 0;
  still.joints.clear();
  still.joint_weights.clear();
  return still;
}

}  // namespace

std::vector<std::string> stand_still(Scene& scene) {
  const std::vector<glm::dmat4> world_from_node = world_from_nodes(scene);
  std::vector<std::string> names;
  std::vector<std::size_t> replaced;
  for (std::size_t i = 0, count = scene.nodes.size(); i < count; ++i) {
    const auto mesh = static_cast<std::size_t>(scene.nodes[i].mesh);
    const bool is_rigid = scene.nodes[i].mesh < 0 || (scene.nodes[i].skin < 0 && !morphs(scene.meshes[mesh]));
    if (is_rigid) continue;
    names.push_back(scene.nodes[i].name);
    replaced.push_back(mesh);
    frame::MeshPose pose;
    pose.weights = scene.nodes[i].weights;
    const bool has_skin = scene.nodes[i].skin >= 0;
    if (has_skin) {
      pose.world_from_object = world_from_node[i];
      pose.world_from_bind =
          frame::joint_matrices(scene.skins[static_cast<std::size_t>(scene.nodes[i].skin)], world_from_node);
    }
    Mesh still;
    still.name = scene.meshes[mesh].name;
    for (const Primitive& primitive : scene.meshes[mesh].primitives)
      still.primitives.push_back(posed(primitive, pose));
    const auto made = static_cast<int>(scene.meshes.size());
    scene.meshes.push_back(std::move(still));
    if (has_skin) {
      Node of_world = scene.nodes[i];
      of_world.parent = of_world.camera = of_world.light = -1;
      of_world.parent_from_node = glm::dmat4(1);
      of_world.transform.reset();
      of_world.mesh = made;
      scene.nodes.push_back(std::move(of_world));
      scene.nodes[i].mesh = -1;
    } else {
      scene.nodes[i].mesh = made;
    }
  }
  for (Node& node : scene.nodes) {
    node.skin = -1;
    node.weights.clear();
  }
  scene.skins.clear();
  // What nobody shows any more is not to be written either.
  for (const std::size_t mesh : replaced) {
    const bool is_shown =
        std::ranges::any_of(scene.nodes, [&](const Node& n) { return n.mesh == static_cast<int>(mesh); });
    if (!is_shown) scene.meshes[mesh].primitives.clear();
  }
  return names;
}

}  // namespace laterna::bake
