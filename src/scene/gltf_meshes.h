// meshes[] of a glTF file: primitives become indexed or plain lists of triangles.
#pragma once

#include <compare>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "laterna/scene.h"
#include "scene/draco_primitive.h"
#include "scene/gltf_accessors.h"
#include "scene/gltf_materials.h"
#include "scene/triangle_lists.h"

namespace laterna::gltf {

class Meshes {
 public:
  Meshes(const JsonDocument& json, Buffers& buffers, Accessors& accessors, Materials& materials,
         FaultList& faults);

  /// meshes[].size() of the file.
  [[nodiscard]] std::size_t count() const { return values_.size(); }

  /// How a node wears a mesh.
  struct Use {
    const JsonValue* node_weights = nullptr;  ///< null: the mesh's own
    bool morphs = false;  ///< its morph targets are kept; otherwise it is drawn toward them once and for all
    bool has_skin = false;  ///< which joints pull its vertices is kept
  };
  /// The scene's index of a mesh of the file, worn so.
  int use(int mesh, const Use& how);
  /// A node's weights of morph targets: its own, or its mesh's.
  std::vector<double> weights_of(int mesh, const JsonValue* node_weights);
  std::vector<Mesh> take() { return std::move(meshes_); }

 private:
  struct Source;  // where one primitive's attributes come from

  // What tells one reading of a mesh from another.
  struct Reading {
    int mesh;
    std::vector<double> weights;  // drawn toward its targets by these; empty: not at all
    bool morphs, has_skin;
    auto operator<=>(const Reading&) const = default;
  };

  Mesh read_mesh(const JsonValue& value, const Reading& reading);
  std::optional<Primitive> read_primitive(const JsonValue& value, const Reading& reading);
  std::optional<Topology> read_topology(JsonObject& object);
  bool open_source(JsonObject& object, Source& source);
  bool read_attributes(Source& source, Primitive& primitive);
  template <class Vector>
  bool read_attribute(Source& source, std::string_view name, std::vector<Vector>& values);
  template <class Vector>
  bool read_draco_attribute(Source& source, std::string_view name, int accessor, std::uint64_t id,
                            std::vector<Vector>& values);
  bool read_triangles(JsonObject& object, const Source& source, Topology topology, Primitive& primitive);
  bool apply_morph(JsonObject& object, const std::vector<double>& weights, Primitive& primitive);
  bool add_target(JsonObject& target, double weight, Primitive& primitive);
  bool read_targets(JsonObject& object, Primitive& primitive);
  bool read_target(JsonObject& target, const Primitive& primitive, MorphTarget& read);
  bool read_displacements(JsonObject& target, std::string_view name, std::size_t vertices,
                          std::vector<glm::vec3>& values);
  bool read_influences(JsonObject& object, Source& source, Primitive& primitive);
  bool add_influences(Source& source, int set, Primitive& primitive);
  bool fits_limits(JsonObject& object, const Primitive& primitive);

  const JsonDocument& json_;
  Buffers& buffers_;
  Accessors& accessors_;
  Materials& materials_;
  FaultList& faults_;
  std::vector<const JsonValue*> values_;
  std::map<Reading, int> index_of_;
  std::vector<Mesh> meshes_;
  std::uint64_t vertex_total_ = 0, morphed_total_ = 0, influence_total_ = 0;
};

}  // namespace laterna::gltf
