#include "scene/gltf_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "scene/gltf_extension.h"
#include "scene/number_scans.h"
#include "scene/surface_attributes.h"
#include "scene/vertex_joining.h"

namespace laterna::gltf {
namespace {

// Weights that add up to 1 but for rounding stay as they are; a vertex that nothing pulls goes with the first joint.
void normalise_weights(Primitive& primitive) {
  const auto per_vertex = static_cast<std::size_t>(primitive.influences);
  for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
    float* weights = primitive.joint_weights.data() + v * per_vertex;
    double sum = 0;
    for (std::size_t k = 0; k < per_vertex; ++k) sum += weights[k];
    if (std::abs(sum - 1) < 1e-6) continue;
    if (!(sum > 0)) weights[0] = 1;
    for (std::size_t k = 0; sum > 0 && k < per_vertex; ++k) weights[k] = static_cast<float>(weights[k] / sum);
  }
}

}  // namespace

struct Meshes::Source {
  const JsonValue* attributes = nullptr;
  std::optional<DracoMesh> draco;
  const JsonValue* draco_attributes = nullptr;
  std::size_t vertex_count = 0;  // known once POSITION has been read
};

Meshes::Meshes(const JsonDocument& json, Buffers& buffers, Accessors& accessors, Materials& materials,
               FaultList& faults)
    : json_(json), buffers_(buffers), accessors_(accessors), materials_(materials), faults_(faults) {
  JsonObject root(json, json.root(), faults);
  const JsonValue* list = root.array("meshes");
  if (list == nullptr) return;
  for (const JsonValue& value : list->children) values_.push_back(&value);
}

int Meshes::use(int mesh, const Use& how) {
  const JsonValue& value = *values_[static_cast<std::size_t>(mesh)];
  Reading reading{mesh, {}, how.morphs, how.has_skin};
  if (!how.morphs) reading.weights = weights_of(mesh, how.node_weights);
  const auto [entry, is_new] = index_of_.try_emplace(reading, static_cast<int>(meshes_.size()));
  if (is_new) meshes_.push_back(read_mesh(value, reading));
  return entry->second;
}

std::vector<double> Meshes::weights_of(int mesh, const JsonValue* node_weights) {
  const JsonValue* list =
      node_weights != nullptr ? node_weights : values_[static_cast<std::size_t>(mesh)]->find("weights");
  std::vector<double> weights;
  if (list == nullptr) return weights;
  if (!list->is_array()) {
    faults_.error(json_.place(*list), fmt::format("expected an array, got {}", describe(*list)));
    return weights;
  }
  for (const JsonValue& weight : list->children) {
    if (weight.kind != JsonValue::Kind::number || !std::isfinite(weight.number)) {
      faults_.error(json_.place(weight), fmt::format("expected a number, got {}", describe(weight)));
    }
    weights.push_back(weight.number);
  }
  return weights;
}

Mesh Meshes::read_mesh(const JsonValue& value, const Reading& reading) {
  JsonObject object(json_, value, faults_);
  Mesh mesh;
  mesh.name = object.string("name").value_or("");
  object.require("primitives");
  const JsonValue* list = object.array("primitives");
  if (list == nullptr) return mesh;
  if (list->children.empty()) object.error("primitives", "expected at least one primitive");
  for (const JsonValue& primitive : list->children) {
    if (std::optional<Primitive> read = read_primitive(primitive, reading))
      mesh.primitives.push_back(std::move(*read));
  }
  return mesh;
}

std::optional<Topology> Meshes::read_topology(JsonObject& object) {
  const std::uint64_t mode = object.whole("mode").value_or(4);
  if (mode > 6) {
    object.error("mode", fmt::format("expected 0 to 6, got {}", mode));
    return std::nullopt;
  }
  const auto topology = static_cast<Topology>(mode);
  if (topology >= Topology::triangles) return topology;
  object.warning(
      {}, topology == Topology::points ? "points are not drawn: left out" : "lines are not drawn: left out");
  return std::nullopt;
}

std::optional<Primitive> Meshes::read_primitive(const JsonValue& value, const Reading& reading) {
  JsonObject object(json_, value, faults_);
  const std::size_t errors_before = faults_.error_count();
  const std::optional<Topology> topology = read_topology(object);
  object.require("attributes");
  Source source;
  source.attributes = object.object("attributes");
  if (!topology || source.attributes == nullptr) return std::nullopt;
  if (source.attributes->find("POSITION") == nullptr) {
    object.warning("attributes", "has no POSITION: left out");
    return std::nullopt;
  }
  Primitive primitive;
  if (!open_source(object, source) || !read_attributes(source, primitive)) return std::nullopt;
  primitive.material = materials_.use(object.index("material", materials_.count(), "materials"));
  if (!read_triangles(object, source, *topology, primitive) ||
      !apply_morph(object, reading.weights, primitive))
    return std::nullopt;
  if (reading.morphs && !read_targets(object, primitive)) return std::nullopt;
  if (reading.has_skin && !read_influences(object, source, primitive)) return std::nullopt;
  drop_unused_vertices(primitive);
  if (!fits_limits(object, primitive) || faults_.error_count() != errors_before) return std::nullopt;
  const Material* material = primitive.material < 0 ? nullptr : &materials_[primitive.material];
  if (primitive.normals.empty() && (reading.morphs || reading.has_skin)) {
    complete_moving_attributes(primitive, material, json_.place(value), faults_);
  } else {
    complete_attributes(primitive, material, std::nullopt, json_.place(value), faults_);
  }
  return primitive;
}

bool Meshes::open_source(JsonObject& object, Source& source) {
  const JsonValue* extension = find_extension(object.value(), "KHR_draco_mesh_compression");
  if (extension == nullptr) return true;
  JsonObject draco(json_, *extension, faults_);
  if (!draco.require("bufferView") || !draco.require("attributes")) return false;
  const int view = draco.index("bufferView", buffers_.view_count(), "bufferViews");
  source.draco_attributes = draco.object("attributes");
  if (view < 0 || source.draco_attributes == nullptr) return false;
  const std::optional<OwnedSpan> bytes = buffers_.read(view);
  if (!bytes) return false;
  auto mesh = DracoMesh::decode(bytes->bytes);
  if (!mesh) {
    draco.error({}, mesh.error());
    return false;
  }
  source.draco = std::move(*mesh);
  return true;
}

bool Meshes::read_attributes(Source& source, Primitive& primitive) {
  if (!read_attribute(source, "POSITION", primitive.positions)) return false;
  bool is_sound = read_attribute(source, "NORMAL", primitive.normals);
  is_sound &= read_attribute(source, "TANGENT", primitive.tangents);
  is_sound &= read_attribute(source, "TEXCOORD_0", primitive.uv[0]);
  is_sound &= read_attribute(source, "TEXCOORD_1", primitive.uv[1]);
  is_sound &= read_attribute(source, "COLOR_0", primitive.colors);
  if (primitive.normals.empty()) primitive.tangents.clear();  // glTF: they mean nothing without normals
  return is_sound;
}

// Whether the attribute is absent or was read; false when it is faulty.
template <class Vector>
bool Meshes::read_attribute(Source& source, std::string_view name, std::vector<Vector>& values) {
  JsonObject attributes(json_, *source.attributes, faults_);
  if (!attributes.has(name)) return true;
  const int accessor = attributes.index(name, accessors_.size(), "accessors");
  if (accessor < 0) return false;
  const std::string place = json_.place(*source.attributes, name);
  if (source.draco && source.draco_attributes->find(name) != nullptr) {
    JsonObject ids(json_, *source.draco_attributes, faults_);
    const std::optional<std::uint64_t> id = ids.whole(name);
    if (!id || !read_draco_attribute(source, name, accessor, *id, values)) return false;
  } else {
    std::optional<std::vector<Vector>> read;
    if constexpr (std::is_same_v<Vector, glm::vec4>) {
      read = name == "COLOR_0" ? accessors_.read_colors(accessor, place)
                               : accessors_.read<Vector>(accessor, place);
    } else {
      read = accessors_.read<Vector>(accessor, place);
    }
    if (!read) return false;
    values = std::move(*read);
  }
  if (name == "POSITION") source.vertex_count = values.size();
  if (values.size() == source.vertex_count) return true;
  attributes.error(name,
                   fmt::format("has {} elements, but POSITION has {}", values.size(), source.vertex_count));
  return false;
}

template <class Vector>
bool Meshes::read_draco_attribute(Source& source, std::string_view name, int accessor, std::uint64_t id,
                                  std::vector<Vector>& values) {
  JsonObject ids(json_, *source.draco_attributes, faults_);
  const bool is_color = name == "COLOR_0";
  const auto wanted = static_cast<std::size_t>(Vector::length());
  const auto components = static_cast<std::size_t>(accessors_.components(accessor));
  if (components != wanted && !(is_color && components == 3)) {
    ids.error(name,
              fmt::format("expected {} components, but accessors[{}] has {}", wanted, accessor, components));
    return false;
  }
  if (accessors_.element_count(accessor) != source.draco->vertex_count()) {
    ids.error(name, fmt::format("the compressed mesh has {} vertices, but accessors[{}] counts {}",
                                source.draco->vertex_count(), accessor, accessors_.element_count(accessor)));
    return false;
  }
  const auto floats = source.draco->attribute(id, components, is_color || accessors_.is_normalized(accessor));
  if (!floats) {
    ids.error(name, floats.error());
    return false;
  }
  values.assign(source.draco->vertex_count(), Vector(1));
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t c = 0; c < components; ++c)
      values[i][static_cast<int>(c)] = (*floats)[i * components + c];
  }
  return true;
}

bool Meshes::read_triangles(JsonObject& object, const Source& source, Topology topology,
                            Primitive& primitive) {
  std::vector<std::uint32_t> indices;
  if (source.draco) {
    indices = source.draco->indices();
    topology = Topology::triangles;
  } else if (object.has("indices")) {
    const int accessor = object.index("indices", accessors_.size(), "accessors");
    if (accessor < 0) return false;
    auto read = accessors_.read_indices(accessor, json_.place(object.value(), "indices"));
    if (!read) return false;
    indices = std::move(*read);
  }
  const std::size_t count = indices.empty() ? primitive.positions.size() : indices.size();
  const std::size_t beyond = first_beyond(indices, primitive.positions.size());
  if (beyond < indices.size()) {
    object.error("indices", fmt::format("index {} is {}, beyond the {} vertices", beyond, indices[beyond],
                                        primitive.positions.size()));
    return false;
  }
  if (count < 3 || (topology == Topology::triangles && count % 3 != 0)) {
    object.warning({},
                   fmt::format("{} corners make no whole number of triangles: the rest is left out", count));
  }
  if (topology == Topology::triangles && indices.empty()) {  // positions already come in triples
    const std::size_t whole = primitive.positions.size() / 3 * 3;
    primitive.positions.resize(whole);
    if (!primitive.normals.empty()) primitive.normals.resize(whole);
    if (!primitive.tangents.empty()) primitive.tangents.resize(whole);
    if (!primitive.colors.empty()) primitive.colors.resize(whole);
    for (auto& uv : primitive.uv) uv.resize(uv.empty() ? 0 : whole);
    return whole > 0;
  }
  primitive.indices = triangle_list(std::move(indices), primitive.positions.size(), topology);
  return !primitive.indices.empty();
}

bool Meshes::apply_morph(JsonObject& object, const std::vector<double>& weights, Primitive& primitive) {
  const JsonValue* targets = object.array("targets");
  const std::size_t count = targets == nullptr ? 0 : targets->children.size();
  if (weights.empty()) return true;
  if (count != weights.size()) {
    object.error("targets", fmt::format("expected {} morph targets, one for each weight, got {}",
                                        weights.size(), count));
    return false;
  }
  bool is_sound = true;
  for (std::size_t i = 0; i < count; ++i) {
    if (weights[i] == 0) continue;
    JsonObject target(json_, targets->children[i], faults_);
    is_sound &= add_target(target, weights[i], primitive);
  }
  return is_sound;
}

bool Meshes::add_target(JsonObject& target, double weight, Primitive& primitive) {
  const auto add = [&](std::string_view name, auto& values) {
    const int accessor = target.index(name, accessors_.size(), "accessors");
    if (accessor < 0) return !target.has(name);
    if (values.empty()) return true;  // the base has none: nothing to displace
    const auto offsets = accessors_.read<glm::vec3>(accessor, json_.place(target.value(), name));
    if (!offsets) return false;
    if (offsets->size() < values.size()) {
      target.error(
          name, fmt::format("has {} elements, but the mesh has {} vertices", offsets->size(), values.size()));
      return false;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        values[i][c] = static_cast<float>(values[i][c] + weight * (*offsets)[i][c]);
        if (std::isfinite(values[i][c])) continue;
        target.error(name, fmt::format("weight {} moves vertex {} beyond all numbers", weight, i));
        return false;
      }
    }
    return true;
  };
  return add("POSITION", primitive.positions) && add("NORMAL", primitive.normals) &&
         add("TANGENT", primitive.tangents);
}

bool Meshes::read_targets(JsonObject& object, Primitive& primitive) {
  const JsonValue* targets = object.array("targets");
  if (targets == nullptr) return true;
  if (targets->children.size() > kMaxMorphTargets) {
    object.error("targets", fmt::format("{} are more than {}", targets->children.size(), kMaxMorphTargets));
    return false;
  }
  bool is_sound = true;
  for (const JsonValue& value : targets->children) {
    JsonObject target(json_, value, faults_);
    is_sound = is_sound && read_target(target, primitive, primitive.targets.emplace_back());
  }
  return is_sound;
}

bool Meshes::read_target(JsonObject& target, const Primitive& primitive, MorphTarget& read) {
  const std::size_t vertices = primitive.positions.size();
  bool is_sound = read_displacements(target, "POSITION", vertices, read.positions);
  // What the mesh itself does not have cannot be displaced.
  if (!primitive.normals.empty()) is_sound &= read_displacements(target, "NORMAL", vertices, read.normals);
  if (!primitive.tangents.empty()) is_sound &= read_displacements(target, "TANGENT", vertices, read.tangents);
  return is_sound;
}

bool Meshes::read_displacements(JsonObject& target, std::string_view name, std::size_t vertices,
                                std::vector<glm::vec3>& values) {
  const int accessor = target.index(name, accessors_.size(), "accessors");
  if (accessor < 0) return !target.has(name);
  morphed_total_ += vertices;
  if (morphed_total_ > kMaxMorphedVertices) {
    target.error(name,
                 fmt::format("the file's morph targets displace more than {} vertices", kMaxMorphedVertices));
    return false;
  }
  auto read = accessors_.read<glm::vec3>(accessor, json_.place(target.value(), name));
  if (!read) return false;
  if (read->size() < vertices) {
    target.error(name, fmt::format("has {} elements, but the mesh has {} vertices", read->size(), vertices));
    return false;
  }
  read->resize(vertices);
  values = std::move(*read);
  return true;
}

// JOINTS_0 and WEIGHTS_0, and as many further sets as there are.
bool Meshes::read_influences(JsonObject& object, Source& source, Primitive& primitive) {
  JsonObject attributes(json_, *source.attributes, faults_);
  int sets = 0;
  while (attributes.has(fmt::format("JOINTS_{}", sets)) || attributes.has(fmt::format("WEIGHTS_{}", sets)))
    ++sets;
  if (sets == 0) {
    object.warning("attributes", "has no JOINTS_0, though its node has a skin: no joint pulls it");
    return true;
  }
  influence_total_ += source.vertex_count * static_cast<std::uint64_t>(4 * sets);
  if (influence_total_ > kMaxInfluences) {
    attributes.error({},
                     fmt::format("the file's vertices have more than {} joints and weights", kMaxInfluences));
    return false;
  }
  primitive.influences = 4 * sets;
  primitive.joints.assign(primitive.positions.size() * 4 * static_cast<std::size_t>(sets), 0);
  primitive.joint_weights.assign(primitive.joints.size(), 0);
  for (int set = 0; set < sets; ++set) {
    if (!add_influences(source, set, primitive)) return false;
  }
  normalise_weights(primitive);
  return true;
}

bool Meshes::add_influences(Source& source, int set, Primitive& primitive) {
  JsonObject attributes(json_, *source.attributes, faults_);
  const std::string joints_name = fmt::format("JOINTS_{}", set),
                    weights_name = fmt::format("WEIGHTS_{}", set);
  if (!attributes.require_all({joints_name, weights_name})) return false;
  std::vector<glm::vec4> joints, weights;
  if (!read_attribute(source, joints_name, joints) || !read_attribute(source, weights_name, weights))
    return false;
  for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
    for (int k = 0; k < 4; ++k) {
      const float joint = joints[v][k], weight = weights[v][k];
      if (!(joint >= 0 && joint <= 65535) || joint != std::floor(joint)) {
        attributes.error(joints_name,
                         fmt::format("vertex {}: expected the number of a joint, got {}", v, joint));
        return false;
      }
      if (!(weight >= 0)) {
        attributes.error(weights_name,
                         fmt::format("vertex {}: expected a weight of at least 0, got {}", v, weight));
        return false;
      }
      const std::size_t at =
          v * static_cast<std::size_t>(primitive.influences) + static_cast<std::size_t>(4 * set + k);
      // Exporters leave numbers of joints that pull by nothing at all.
      primitive.joints[at] = weight > 0 ? static_cast<std::uint16_t>(joint) : std::uint16_t{0};
      primitive.joint_weights[at] = weight;
    }
  }
  return true;
}

bool Meshes::fits_limits(JsonObject& object, const Primitive& primitive) {
  // Flat normals unshare the vertices: three per triangle.
  const std::size_t corners =
      primitive.indices.empty() ? primitive.positions.size() : primitive.indices.size();
  vertex_total_ += std::max(primitive.positions.size(), primitive.normals.empty() ? corners : 0);
  if (vertex_total_ <= kMaxVertices && corners / 3 <= kMaxTriangles) return true;
  object.error(
      {}, fmt::format("the file holds more than {} vertices or {} triangles", kMaxVertices, kMaxTriangles));
  return false;
}

}  // namespace laterna::gltf
