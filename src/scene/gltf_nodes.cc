#include "scene/gltf_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "scene/gltf_extension.h"
#include "scene/instance_transforms.h"
#include "scene/json_object.h"

namespace laterna::gltf {
namespace {

struct Hierarchy {
  std::vector<const JsonValue*> values;
  std::vector<std::vector<int>> children;
  std::vector<int> parent;
};

// A list of node indices; those out of range are reported and left out.
std::vector<int> node_list(const JsonDocument& json, const JsonValue& list, std::size_t node_count,
                           FaultList& faults) {
  std::vector<int> nodes;
  for (const JsonValue& value : list.children) {
    const double index = value.number;
    if (value.kind != JsonValue::Kind::number || index < 0 || index != std::floor(index)) {
      faults.error(json.place(value), fmt::format("expected the index of a node, got {}", describe(value)));
    } else if (index >= static_cast<double>(node_count)) {
      faults.error(json.place(value),
                   fmt::format("refers to nodes[{}], but there are only {}", index, node_count));
    } else {
      nodes.push_back(static_cast<int>(index));
    }
  }
  return nodes;
}

void adopt(const JsonDocument& json, Hierarchy& tree, std::size_t node, FaultList& faults) {
  for (const int child : tree.children[node]) {
    int& parent = tree.parent[static_cast<std::size_t>(child)];
    if (parent >= 0) {
      faults.error(json.place(*tree.values[static_cast<std::size_t>(child)]),
                   fmt::format("is a child of both nodes[{}] and nodes[{}]", parent, node));
    }
    parent = static_cast<int>(node);
  }
}

Hierarchy read_hierarchy(const JsonDocument& json, FaultList& faults) {
  Hierarchy tree;
  JsonObject root(json, json.root(), faults);
  const JsonValue* list = root.array("nodes");
  if (list == nullptr) return tree;
  for (const JsonValue& value : list->children) tree.values.push_back(&value);
  tree.children.resize(tree.values.size());
  tree.parent.assign(tree.values.size(), -1);
  for (std::size_t i = 0; i < tree.values.size(); ++i) {
    JsonObject object(json, *tree.values[i], faults);
    if (const JsonValue* children = object.array("children")) {
      tree.children[i] = node_list(json, *children, tree.values.size(), faults);
    }
  }
  for (std::size_t i = 0; i < tree.values.size(); ++i) adopt(json, tree, i, faults);
  return tree;
}

// With one parent each, nodes that no root reaches hang below a cycle. Reports one node of each cycle.
void report_cycles(const JsonDocument& json, const Hierarchy& tree, FaultList& faults) {
  enum class Mark : std::uint8_t { unseen, on_path, done };
  std::vector<Mark> marks(tree.values.size(), Mark::unseen);
  for (std::size_t start = 0; start < tree.values.size(); ++start) {
    std::vector<std::size_t> path;
    auto node = static_cast<int>(start);
    while (node >= 0 && marks[static_cast<std::size_t>(node)] == Mark::unseen) {
      marks[static_cast<std::size_t>(node)] = Mark::on_path;
      path.push_back(static_cast<std::size_t>(node));
      node = tree.parent[static_cast<std::size_t>(node)];
    }
    if (node >= 0 && marks[static_cast<std::size_t>(node)] == Mark::on_path) {
      faults.error(json.place(*tree.values[static_cast<std::size_t>(node)]), "is its own ancestor");
    }
    for (const std::size_t seen : path) marks[seen] = Mark::done;
  }
}

std::vector<int> scene_roots(const JsonDocument& json, const Hierarchy& tree, FaultList& faults) {
  const JsonValue* scene = default_scene(json, faults);
  if (scene == nullptr) {
    std::vector<int> roots;
    for (std::size_t i = 0; i < tree.values.size(); ++i) {
      if (tree.parent[i] < 0) roots.push_back(static_cast<int>(i));
    }
    return roots;
  }
  JsonObject object(json, *scene, faults);
  const JsonValue* list = object.array("nodes");
  if (list == nullptr) return {};
  std::vector<int> roots = node_list(json, *list, tree.values.size(), faults);
  std::vector<bool> is_listed(tree.values.size(), false);
  for (const int index : roots) {
    const auto node = static_cast<std::size_t>(index);
    if (tree.parent[node] >= 0) {
      object.error("nodes",
                   fmt::format("nodes[{}] is a child of nodes[{}] and so no root", node, tree.parent[node]));
    } else if (is_listed[node]) {
      object.error("nodes", fmt::format("nodes[{}] is listed twice", node));
    }
    is_listed[node] = true;
  }
  return roots;
}

std::optional<glm::dmat4> explicit_matrix(JsonObject& object) {
  const auto values = object.numbers<16>("matrix");
  if (!values) return std::nullopt;
  for (const std::string_view name : {"translation", "rotation", "scale"}) {
    if (object.has(name)) object.error(name, "a node has either a matrix or translation, rotation and scale");
  }
  glm::dmat4 matrix;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row)
      matrix[column][row] = (*values)[static_cast<std::size_t>(column * 4 + row)];
  }
  // Exporters round; what is meant is an affine matrix.
  const glm::dvec4 last_row(matrix[0][3], matrix[1][3], matrix[2][3], matrix[3][3] - 1);
  if (glm::dot(last_row, last_row) > 1e-10) {
    object.error("matrix", fmt::format("the last row must be 0 0 0 1, got {} {} {} {}", matrix[0][3],
                                       matrix[1][3], matrix[2][3], matrix[3][3]));
  }
  for (int column = 0; column < 4; ++column) matrix[column][3] = column == 3 ? 1 : 0;
  return matrix;
}

// One attribute of the instancing extension; `fallback` for every instance when it is absent.
template <class Vector>
bool read_instance_attribute(const JsonDocument& json, JsonObject& attributes, std::string_view name,
                             Accessors& accessors, std::uint64_t room, std::vector<Vector>& values) {
  const int accessor = attributes.index(name, accessors.size(), "accessors");
  if (accessor < 0) return !attributes.has(name);
  if (accessors.element_count(accessor) > room) {
    attributes.error(name, fmt::format("the file shows more than {} instances", kMaxInstances));
    return false;
  }
  auto read = accessors.read<Vector>(accessor, json.place(attributes.value(), name));
  if (!read) return false;
  values = std::move(*read);
  return true;
}

}  // namespace

const JsonValue* default_scene(const JsonDocument& json, FaultList& faults) {
  JsonObject root(json, json.root(), faults);
  const JsonValue* scenes = root.array("scenes");
  const std::size_t count = scenes == nullptr ? 0 : scenes->children.size();
  const int chosen = root.index("scene", count, "scenes");
  return count == 0 ? nullptr : &scenes->children[static_cast<std::size_t>(std::max(chosen, 0))];
}

std::vector<PlacedNode> placed_nodes(const JsonDocument& json, FaultList& faults) {
  const std::size_t errors_before = faults.error_count();
  const Hierarchy tree = read_hierarchy(json, faults);
  report_cycles(json, tree, faults);
  const std::vector<int> roots = scene_roots(json, tree, faults);
  std::vector<PlacedNode> placed;
  if (faults.error_count() != errors_before) return placed;  // only a forest may be walked
  struct Pending {
    int node, parent;
  };
  std::vector<Pending> pending;
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) pending.push_back({*root, -1});
  while (!pending.empty()) {
    const Pending next = pending.back();
    pending.pop_back();
    const auto node = static_cast<std::size_t>(next.node);
    const int index = static_cast<int>(placed.size());
    placed.push_back({tree.values[node], next.parent});
    const std::vector<int>& children = tree.children[node];
    for (auto child = children.rbegin(); child != children.rend(); ++child)
      pending.push_back({*child, index});
  }
  return placed;
}

NodePlace node_place(const JsonDocument& json, const JsonValue& node, FaultList& faults) {
  JsonObject object(json, node, faults);
  if (object.has("matrix")) return {explicit_matrix(object).value_or(glm::dmat4(1.0)), std::nullopt};
  const auto t = object.numbers<3>("translation").value_or(std::array<double, 3>{0, 0, 0});
  const auto r = object.numbers<4>("rotation").value_or(std::array<double, 4>{0, 0, 0, 1});
  const auto s = object.numbers<3>("scale").value_or(std::array<double, 3>{1, 1, 1});
  const std::optional<glm::dvec4> rotation = normalized_rotation(glm::dvec4(r[0], r[1], r[2], r[3]));
  if (!rotation) {
    object.error("rotation", "expected a unit quaternion, got one without length");
    return {glm::dmat4(1.0), std::nullopt};
  }
  const Transform transform{glm::dvec3(t[0], t[1], t[2]), *rotation, glm::dvec3(s[0], s[1], s[2])};
  return {to_matrix(transform), transform};
}

std::vector<glm::dmat4> node_instances(const JsonDocument& json, const JsonValue& node, Accessors& accessors,
                                       std::uint64_t room, FaultList& faults) {
  const JsonValue* extension = find_extension(node, "EXT_mesh_gpu_instancing");
  if (extension == nullptr) return {};
  JsonObject object(json, *extension, faults);
  object.require("attributes");
  const JsonValue* list = object.object("attributes");
  if (list == nullptr) return {};
  JsonObject attributes(json, *list, faults);
  std::vector<glm::vec3> translations, scales;
  std::vector<glm::vec4> rotations;
  if (!read_instance_attribute(json, attributes, "TRANSLATION", accessors, room, translations) ||
      !read_instance_attribute(json, attributes, "ROTATION", accessors, room, rotations) ||
      !read_instance_attribute(json, attributes, "SCALE", accessors, room, scales)) {
    return {};
  }
  const std::size_t count = std::max({translations.size(), rotations.size(), scales.size()});
  for (const std::size_t size : {translations.size(), rotations.size(), scales.size()}) {
    if (size == 0 || size == count) continue;
    attributes.error({}, fmt::format("the attributes count differently: {} and {} instances", size, count));
    return {};
  }
  std::vector<glm::dmat4> instances(count);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec4 stored = rotations.empty() ? glm::dvec4(0, 0, 0, 1) : glm::dvec4(rotations[i]);
    const std::optional<glm::dvec4> rotation = normalized_rotation(stored);
    if (!rotation) {
      attributes.error("ROTATION",
                       fmt::format("instance {}: expected a unit quaternion, got one without length", i));
      return {};
    }
    instances[i] = to_matrix({translations.empty() ? glm::dvec3(0) : glm::dvec3(translations[i]), *rotation,
                              scales.empty() ? glm::dvec3(1) : glm::dvec3(scales[i])});
  }
  return instances;
}

}  // namespace laterna::gltf
