#include "scene/node_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/normals.h"
#include "scene/scene_check.h"

namespace laterna {
namespace {

template <class Vector>
bool is_finite(const Vector& v) {
  for (int i = 0; i < Vector::length(); ++i) {
    if (!std::isfinite(v[i])) return false;
  }
  return true;
}

class NodeCheck : SceneCheck {
 public:
  NodeCheck(const Scene& scene, FaultList& faults) : SceneCheck(scene, faults) {}

  void run() { check_nodes(); }

 private:
  void check_matrix(const glm::dmat4& matrix, const std::string& place);
  void check_node(const Node& node, const std::string& place);
  bool check_parents();
  void check_nodes();
  void check_places();
  void check_placed_meshes(const std::vector<glm::dmat4>& world_from_node);
};

struct Bounds {
  glm::dvec3 low{0}, high{0};
  bool is_empty = true;
};

Bounds bounds_of(const Mesh& mesh) {
  Bounds bounds;
  glm::vec3 low(std::numeric_limits<float>::max()), high(-std::numeric_limits<float>::max());
  for (const Primitive& primitive : mesh.primitives) {
    for (const glm::vec3& p : primitive.positions) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    bounds.is_empty &= primitive.positions.empty();
  }
  bounds.low = low;
  bounds.high = high;
  return bounds;
}

// Whether the box, once placed, keeps within the coordinates that single precision can calculate with.
bool is_within_reach(const Bounds& bounds, const glm::dmat4& world_from_mesh) {
  if (bounds.is_empty) return true;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 p((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                       (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                       (corner & 4) != 0 ? bounds.high.z : bounds.low.z, 1);
    const glm::dvec4 world = world_from_mesh * p;
    // Written so that NaN fails.
    if (!(std::max({std::abs(world.x), std::abs(world.y), std::abs(world.z)}) <= kMaxCoordinate))
      return false;
    if (std::isnan(world.x) || std::isnan(world.y) || std::isnan(world.z)) return false;
  }
  return true;
}

void NodeCheck::check_matrix(const glm::dmat4& matrix, const std::string& place) {
  for (int column = 0; column < 4; ++column) {
    if (!is_finite(matrix[column])) return fault(place, "the matrix holds a value that is not finite");
    if (matrix[column][3] != (column == 3 ? 1 : 0))
      return fault(place, "the matrix's last row must be 0 0 0 1");
  }
}

void NodeCheck::check_node(const Node& node, const std::string& place) {
  check_reference(place + ".parent", node.parent, scene_.nodes.size(), "nodes");
  check_reference(place + ".mesh", node.mesh, scene_.meshes.size(), "meshes");
  check_reference(place + ".camera", node.camera, scene_.cameras.size(), "cameras");
  check_reference(place + ".light", node.light, scene_.lights.size(), "lights");
  check_matrix(node.parent_from_node, place + ".parent_from_node");
  for (std::size_t i = 0; i < node.node_from_instance.size(); ++i) {
    check_matrix(node.node_from_instance[i], item(place + ".node_from_instance", i));
  }
}

// Whether the parents form a forest. Each walk upward stops at a node that an earlier one has passed.
bool NodeCheck::check_parents() {
  enum class Mark : std::uint8_t { unseen, on_path, done };
  std::vector<Mark> marks(scene_.nodes.size(), Mark::unseen);
  bool is_forest = true;
  std::vector<std::size_t> path;
  for (std::size_t start = 0; start < scene_.nodes.size(); ++start) {
    path.clear();
    auto node = static_cast<std::ptrdiff_t>(start);
    while (node >= 0 && marks[static_cast<std::size_t>(node)] == Mark::unseen) {
      marks[static_cast<std::size_t>(node)] = Mark::on_path;
      path.push_back(static_cast<std::size_t>(node));
      node = scene_.nodes[static_cast<std::size_t>(node)].parent;
    }
    if (node >= 0 && marks[static_cast<std::size_t>(node)] == Mark::on_path) {
      fault(item("nodes", static_cast<std::size_t>(node)) + ".parent", "the node is its own ancestor");
      is_forest = false;
    }
    for (const std::size_t seen : path) marks[seen] = Mark::done;
  }
  return is_forest;
}

void NodeCheck::check_nodes() {
  for (std::size_t i = 0; i < scene_.nodes.size(); ++i) check_node(scene_.nodes[i], item("nodes", i));
  // What follows walks the tree and looks into the meshes, so it needs all of them sound.
  if (faults_.has_errors() || !check_parents()) return;
  check_places();
}

void NodeCheck::check_places() {
  const std::vector<glm::dmat4> world_from_node = world_from_nodes(scene_);
  std::vector<int> camera_node(scene_.cameras.size(), -1), light_node(scene_.lights.size(), -1);
  for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
    const Node& node = scene_.nodes[i];
    for (const auto& [index, owner, list] :
         {std::tuple{node.camera, &camera_node, "cameras"}, std::tuple{node.light, &light_node, "lights"}}) {
      if (index < 0) continue;
      int& first = (*owner)[static_cast<std::size_t>(index)];
      if (first >= 0)
        fault(item("nodes", i), fmt::format("{}[{}] already stands at nodes[{}]", list, index, first));
      first = static_cast<int>(i);
      const Result<Pose> pose = Pose::from_matrix(world_from_node[i]);
      if (!pose)
        fault(item("nodes", i),
              fmt::format("{}[{}] cannot stand here: {}", list, index, to_string(pose.error())));
      const glm::dvec4 at = world_from_node[i][3];
      if (std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) > kMaxCoordinate) {
        fault(item("nodes", i), fmt::format("{}[{}] is more than {} m away", list, index, kMaxCoordinate));
      }
    }
  }
  check_placed_meshes(world_from_node);
}

void NodeCheck::check_placed_meshes(const std::vector<glm::dmat4>& world_from_node) {
  std::vector<Bounds> bounds;
  std::vector<std::uint64_t> triangles;
  for (const Mesh& mesh : scene_.meshes) {
    bounds.push_back(bounds_of(mesh));
    std::uint64_t count = 0;
    for (const Primitive& primitive : mesh.primitives) count += triangle_count(primitive);
    triangles.push_back(count);
  }
  std::uint64_t placed = 0;
  for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
    const Node& node = scene_.nodes[i];
    if (node.mesh < 0) continue;
    const auto mesh = static_cast<std::size_t>(node.mesh);
    const std::size_t copies = std::max<std::size_t>(node.node_from_instance.size(), 1);
    placed += triangles[mesh] * copies;
    if (node.skin >= 0) continue;  // placed by its joints: the frame sees where
    bool fits = node.node_from_instance.empty() ? is_within_reach(bounds[mesh], world_from_node[i]) : true;
    for (const glm::dmat4& node_from_instance : node.node_from_instance) {
      fits = fits && is_within_reach(bounds[mesh], world_from_node[i] * node_from_instance);
    }
    if (!fits)
      fault(item("nodes", i),
            fmt::format("meshes[{}] reaches more than {} m from the origin", mesh, kMaxCoordinate));
  }
  if (placed > kMaxPlacedTriangles) {
    fault("nodes", fmt::format("they show {} triangles, more than {}", placed, kMaxPlacedTriangles));
  }
}

}  // namespace

void check_nodes(const Scene& scene, FaultList& faults) { NodeCheck(scene, faults).run(); }

}  // namespace laterna
