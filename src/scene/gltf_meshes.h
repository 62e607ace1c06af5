// meshes[] of a glTF file: primitives become indexed or plain lists of triangles.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
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

  /// The scene's index of a mesh of the file, posed by `node_weights` (or the mesh's own when null) if it
  /// morphs.
  int use(int mesh, const JsonValue* node_weights);
  std::vector<Mesh> take() { return std::move(meshes_); }

 private:
  struct Source;  // where one primitive's attributes come from

  Mesh read_mesh(const JsonValue& value, const std::vector<double>& weights);
  std::optional<Primitive> read_primitive(const JsonValue& value, const std::vector<double>& weights);
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
  bool fits_limits(JsonObject& object, const Primitive& primitive);
  std::vector<double> weights_of(const JsonValue& mesh, const JsonValue* node_weights);

  const JsonDocument& json_;
  Buffers& buffers_;
  Accessors& accessors_;
  Materials& materials_;
  FaultList& faults_;
  std::vector<const JsonValue*> values_;
  std::map<std::pair<int, std::vector<double>>, int> index_of_;
  std::vector<Mesh> meshes_;
  std::uint64_t vertex_total_ = 0;
};

}  // namespace laterna::gltf
