#include "scene/gltf_mesh_writer.h"

#include <glm/common.hpp>

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
  Json json = {{"attributes", std::move(attributes)}};
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
