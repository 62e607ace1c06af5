#include "scene/gltf_node_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "scene/gltf_animation_writer.h"
#include "scene/gltf_light_extensions.h"
#include "scene/gltf_setting_writer.h"
#include "scene/instance_transforms.h"

namespace laterna::gltf {
namespace {

// Zeros of either sign, too: what is stored with a picture shows them.
bool is_same(const glm::dmat4& a, const glm::dmat4& b) { return std::memcmp(&a, &b, sizeof(a)) == 0; }

void set_matrix(Json& node, const glm::dmat4& matrix) {
  if (is_same(matrix, glm::dmat4(1.0))) return;
  glm::dmat4 moved(1.0);
  moved[3] = matrix[3];
  if (is_same(matrix, moved)) {
    node["translation"] = {matrix[3][0], matrix[3][1], matrix[3][2]};
    return;
  }
  Json& numbers = node["matrix"] = Json::array();
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) numbers.push_back(matrix[column][row]);
  }
}

void set_parts(Json& node, const Transform& parts) {
  const Transform usual;
  if (parts.translation != usual.translation) node["translation"] = components(parts.translation);
  if (parts.rotation != usual.rotation) node["rotation"] = components(parts.rotation);
  if (parts.scale != usual.scale) node["scale"] = components(parts.scale);
}

void set_flags(Json& json, const Node& node, Document& document) {
  Json flags = Json::object();
  if (!node.casts_shadow) set(flags, "casts_shadow", false);
  if (!node.receives_shadow) set(flags, "receives_shadow", false);
  if (!node.visible) flags["visible"] = false;
  if (!flags.empty()) document.extend(json, kLightingExtension, std::move(flags));
}

Json instancing_json(const InstanceTransforms& t, Document& document) {
  // Not a vertex's attributes: the view has no target.
  const auto add = [&](const auto& vectors, std::string_view type) {
    return document.add_accessor(std::as_bytes(std::span(vectors)), Document::Target::none, 5126, type,
                                 vectors.size());
  };
  return {{"attributes",
           {{"TRANSLATION", add(t.translations, "VEC3")},
            {"ROTATION", add(t.rotations, "VEC4")},
            {"SCALE", add(t.scales, "VEC3")}}}};
}

class NodeWriter {
 public:
  NodeWriter(const Scene& scene, const std::vector<int>& meshes, LightWriter& lights, Document& document)
      : scene_(scene),
        meshes_(meshes),
        lights_(lights),
        document_(document),
        moved_by_parts_(nodes_moved_by_parts(scene)) {}

  Result<void> write() {
    std::vector<Json> children(scene_.nodes.size(), Json::array());
    Json roots = Json::array();
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      const int parent = scene_.nodes[i].parent;
      (parent < 0 ? roots : children[static_cast<std::size_t>(parent)]).push_back(i);
    }
    // Nodes come first, so that theirs are the scene's own numbers; instances that become nodes are added behind.
    for (const Node& node : scene_.nodes) {
      Result<Json> json = node_json(node);
      if (!json) return tl::unexpected(std::move(json.error()));
      document_.add("nodes", std::move(*json));
    }
    for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
      add_instances(scene_.nodes[i], static_cast<int>(i), children[i]);
      if (!children[i].empty())
        document_.at("nodes", static_cast<int>(i))["children"] = std::move(children[i]);
    }
    Json json = Json::object();
    if (!roots.empty()) json["nodes"] = std::move(roots);
    set_lighting(json);
    document_.add("scenes", std::move(json));
    return {};
  }

 private:
  [[nodiscard]] int mesh_of(const Node& node) const {
    return node.mesh < 0 ? -1 : meshes_[static_cast<std::size_t>(node.mesh)];
  }

  Result<Json> node_json(const Node& node) {
    Json json = Json::object();
    if (!node.name.empty()) json["name"] = node.name;
    if (moved_by_parts_[static_cast<std::size_t>(&node - scene_.nodes.data())]) {
      set_parts(json, parts_of(node));
    } else {
      set_matrix(json, node.parent_from_node);
    }
    if (mesh_of(node) >= 0 && node.node_from_instance.empty()) {
      json["mesh"] = mesh_of(node);
      if (node.skin >= 0) json["skin"] = node.skin;
      for (const float weight : node.weights) json["weights"].push_back(shortest(weight));
    }
    if (node.camera >= 0) json["camera"] = node.camera;
    set_flags(json, node, document_);
    if (node.light >= 0) {
      if (const Result<void> hung = lights_.hang(node.light, node.name, json); !hung)
        return tl::unexpected(hung.error());
    }
    return json;
  }

  // By EXT_mesh_gpu_instancing where its numbers of single precision say it all, else as nodes of their own.
  void add_instances(const Node& node, int index, Json& children) {
    if (mesh_of(node) < 0 || node.node_from_instance.empty()) return;
    if (const auto transforms = decomposed(node.node_from_instance)) {
      Json& json = document_.at("nodes", index);
      json["mesh"] = mesh_of(node);
      document_.extend(json, "EXT_mesh_gpu_instancing", instancing_json(*transforms, document_));
      return;
    }
    for (const glm::dmat4& matrix : node.node_from_instance) {
      Json json = Json::object();
      if (!node.name.empty()) json["name"] = node.name;
      set_matrix(json, matrix);
      json["mesh"] = mesh_of(node);
      set_flags(json, node, document_);
      children.push_back(document_.add("nodes", std::move(json)));
    }
  }

  void set_lighting(Json& json) {
    Json lighting = Json::object();
    if (scene_.ambient_is_set) lighting["ambient"] = components(scene_.ambient);
    if (scene_.background) lighting["background"] = components(*scene_.background);
    if (scene_.phong) {
      // An exponent of 0 cannot be said; this one does the same.
      const float shininess = std::max(scene_.phong->shininess, std::numeric_limits<float>::min());
      lighting["shading"] = {{"specular", shortest(scene_.phong->specular)},
                             {"shininess", shortest(shininess)}};
    }
    if (!lighting.empty()) document_.extend(json, kLightingExtension, std::move(lighting));
  }

  const Scene& scene_;
  const std::vector<int>& meshes_;
  LightWriter& lights_;
  Document& document_;
  std::vector<bool> moved_by_parts_;
};

}  // namespace

Result<void> write_nodes(const Scene& scene, const std::vector<int>& meshes, LightWriter& lights,
                         Document& document) {
  return NodeWriter(scene, meshes, lights, document).write();
}

}  // namespace laterna::gltf
