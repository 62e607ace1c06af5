#include "scene/node_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "scene/instance_transforms.h"
#include "scene/node_selection.h"
#include "scene/spelling.h"

namespace laterna {
namespace {

// Of a rotation matrix, from the largest of its four numbers (Shepperd, Quaternion from rotation matrix, 1978).
glm::dvec4 quaternion_of(const glm::dmat3& m) {
  const double trace = m[0][0] + m[1][1] + m[2][2];
  if (trace > 0) return {m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0], 1 + trace};
  int i = m[1][1] > m[0][0] ? 1 : 0;
  if (m[2][2] > m[i][i]) i = 2;
  const int j = (i + 1) % 3, k = (i + 2) % 3;
  glm::dvec4 q(0);
  q[i] = 1 + m[i][i] - m[j][j] - m[k][k];
  q[j] = m[i][j] + m[j][i];
  q[k] = m[i][k] + m[k][i];
  q.w = m[j][k] - m[k][j];
  return q;
}

// Its skin places a mesh, and not its node.
bool is_placed_by_skin(const Scene& scene, const Node& node) {
  if (node.skin < 0 || node.mesh < 0) return false;
  const std::vector<Primitive>& primitives = scene.meshes[static_cast<std::size_t>(node.mesh)].primitives;
  return std::any_of(primitives.begin(), primitives.end(),
                     [](const Primitive& primitive) { return primitive.influences > 0; });
}

}  // namespace

std::optional<Transform> decompose(const glm::dmat4& matrix) {
  constexpr double kRounding = 1e-6;
  Transform transform;
  transform.translation = glm::dvec3(matrix[3]);
  glm::dmat3 axes(matrix);
  for (int i = 0; i < 3; ++i) {
    transform.scale[i] = glm::length(axes[i]);
    if (!(transform.scale[i] > 0) || !std::isfinite(transform.scale[i])) return std::nullopt;
    axes[i] /= transform.scale[i];
  }
  for (int i = 0; i < 3; ++i) {
    if (std::abs(glm::dot(axes[i], axes[(i + 1) % 3])) > kRounding) return std::nullopt;
  }
  if (glm::determinant(axes) < 0) {
    axes[0] = -axes[0];
    transform.scale.x = -transform.scale.x;
  }
  const std::optional<glm::dvec4> rotation = normalized_rotation(quaternion_of(axes));
  if (!rotation) return std::nullopt;
  transform.rotation = *rotation;
  return transform;
}

std::string add_node_path(Scene& scene, const std::string& name, Clip path) {
  const std::vector<bool> is_called = nodes_called(scene, name);
  int found = -1;
  for (std::size_t i = 0; i < is_called.size(); ++i) {
    if (!is_called[i]) continue;
    if (found >= 0) {
      return fmt::format("nodes[{}] and nodes[{}] are both called {}: a path moves one node", found, i,
                         in_quotes(name));
    }
    found = static_cast<int>(i);
  }
  if (found < 0) return no_such_node(scene, name);
  Node& node = scene.nodes[static_cast<std::size_t>(found)];
  if (is_placed_by_skin(scene, node)) {
    const int joint = scene.skins[static_cast<std::size_t>(node.skin)].joints.front();
    return fmt::format("the joints of its skin place {}: move those, such as {}, or what they hang on",
                       in_quotes(name), in_quotes(scene.nodes[static_cast<std::size_t>(joint)].name));
  }
  if (!node.transform) node.transform = decompose(node.parent_from_node);
  if (!node.transform)
    return fmt::format("the matrix of {} shears or flattens: it does not move along paths", in_quotes(name));
  path.name = "path of " + name;
  for (ClipChannel& channel : path.channels) channel.target = found;
  scene.clips.push_back(std::move(path));
  return {};
}

}  // namespace laterna
