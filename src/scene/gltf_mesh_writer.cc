#include "scene/gltf_mesh_writer.h"

#include <glm/common.hpp>
#include <string>

namespace laterna::gltf {
namespace {

constexpr int kU16 = 5123, kU32 = 5125;
// The largest index of 16 bits is kept for restarting strips.
constexpr std::size_t kMost16BitVertices = 65535;

template <class Vector>
int add_vectors(Document& document, const std::vector<Vector>& values) {
  constexpr const char* kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  const auto width = static_cast<std::size_t>(Vector::length());
  return document.add_floats({&values.data()->x, values.size() * width}, kTypes[width - 1], values.size());
}

int add_positions(Document& document, const std::vector<glm::vec3>& positions) {
  const int accessor = add_vectors(document, positions);
  glm::vec3 low = positions.front(), high = positions.front();
  for (const glm::vec3& position : positions) {
    low = glm::min(low, position);
    high = glm::max(high, position);
  }
  document.at("accessors", accessor)["min"] = components(low);
  document.at("accessors", accessor)["max"] = components(high);
  return accessor;
}

int add_indices(Document& document, const Primitive& primitive) {
  const std::vector<std::uint32_t>& indices = primitive.indices;
  if (primitive.positions.size() > kMost16BitVertices)
    return document.add_accessor(std::as_bytes(std::span(indices)), Document::Target::indices, kU32, "SCALAR",
                                 indices.size());
  const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
  return document.add_accessor(std::as_bytes(std::span(narrow)), Document::Target::indices, kU16, "SCALAR",
                               narrow.size());
}

// Sets of four: what pulls by nothing fills the last one up.
void add_influences(Document& document, const Primitive& primitive, Json& attributes) {
  const auto per_vertex = static_cast<std::size_t>(primitive.influences);
  for (std::size_t set = 0; 4 * set < per_vertex; ++set) {
    std::vector<std::uint16_t> joints;
    std::vector<glm::vec4> weights;
    for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
      weights.emplace_back(0.0F);
      for (std::size_t k = 0; k < 4; ++k) {
        const bool is_there = 4 * set + k < per_vertex;
        const std::size_t at = v * per_vertex + 4 * set + k;
        joints.push_back(is_there ? primitive.joints[at] : std::uint16_t{0});
        if (is_there) weights.back()[static_cast<int>(k)] = primitive.joint_weights[at];
      }
    }
    attributes["JOINTS_" + std::to_string(set)] =
        document.add_accessor(std::as_bytes(std::span(joints)), Document::Target::attributes, kU16, "VEC4",
                              primitive.positions.size());
    attributes["WEIGHTS_" + std::to_string(set)] = add_vectors(document, weights);
  }
}

// What displaces nothing is written as displacements by nothing: a target is never empty.
Json targets_json(Document& document, const Primitive& primitive) {
  Json targets = Json::array();
  for (const MorphTarget& target : primitive.targets) {
    Json json = Json::object();
    const std::vector<glm::vec3> nothing(primitive.positions.size(), glm::vec3(0));
    json["POSITION"] = add_positions(document, target.positions.empty() ? nothing : target.positions);
    if (!target.normals.empty() && !primitive.normals.empty())
      json["NORMAL"] = add_vectors(document, target.normals);
    if (!target.tangents.empty() && !primitive.tangents.empty() && !primitive.normals.empty())
      json["TANGENT"] = add_vectors(document, target.tangents);
    targets.push_back(std::move(json));
  }
  return targets;
}

Json primitive_json(Document& document, const Primitive& primitive) {
  Json attributes;
  attributes["POSITION"] = add_positions(document, primitive.positions);
  if (!primitive.normals.empty()) attributes["NORMAL"] = add_vectors(document, primitive.normals);
  if (!primitive.tangents.empty() && !primitive.normals.empty())
    attributes["TANGENT"] = add_vectors(document, primitive.tangents);
  const auto& [first, second] = primitive.uv;
  if (!first.empty()) attributes["TEXCOORD_0"] = add_vectors(document, first);
  if (!second.empty()) {
    attributes["TEXCOORD_1"] = add_vectors(document, second);
    // Sets are numbered without gaps: the same numbers stand for a first one that nobody uses.
    if (first.empty()) attributes["TEXCOORD_0"] = attributes["TEXCOORD_1"];
  }
  if (!primitive.colors.empty()) attributes["COLOR_0"] = add_vectors(document, primitive.colors);
  add_influences(document, primitive, attributes);
  Json json = {{"attributes", std::move(attributes)}};
  if (!primitive.targets.empty()) json["targets"] = targets_json(document, primitive);
  if (!primitive.indices.empty()) json["indices"] = add_indices(document, primitive);
  if (primitive.material >= 0) json["material"] = primitive.material;
  return json;
}

}  // namespace

std::vector<int> write_meshes(const Scene& scene, Document& document) {
  std::vector<int> written;
  for (const Mesh& mesh : scene.meshes) {
    Json primitives = Json::array();
    for (const Primitive& primitive : mesh.primitives) {
      if (!primitive.positions.empty()) primitives.push_back(primitive_json(document, primitive));
    }
    Json json;
    if (!mesh.name.empty()) json["name"] = mesh.name;
    const bool is_empty = primitives.empty();
    json["primitives"] = std::move(primitives);
    written.push_back(is_empty ? -1 : document.add("meshes", std::move(json)));
  }
  return written;
}

}  // namespace laterna::gltf
