#include "scene/rig_reader.h"

#include <fmt/format.h>

#include "scene/fault_list.h"
#include "scene/json_document.h"
#include "scene/json_object.h"
#include "scene/rig_environment.h"
#include "scene/rig_frustum.h"
#include "scene/rig_lights.h"
#include "scene/rig_path.h"
#include "scene/rig_pose.h"
#include "scene/rig_surfaces.h"
#include "scene/rig_terrain.h"
#include "scene/scene_settings.h"
#include "scene/spelling.h"
#include "scene/unique_names.h"
#include "scene/uri.h"

namespace laterna {
namespace {

// A rig is its user's own text: it names any file.
class RigFiles final : public LightFiles {
 public:
  RigFiles(const std::filesystem::path& folder, std::vector<Picture>& pictures)
      : folder_(folder), pictures_(pictures) {}

  tl::expected<std::filesystem::path, std::string> find(std::string_view name) override {
    return resolve_typed_file(folder_, name);
  }
  std::optional<std::filesystem::path> pattern(std::string_view name) override { return folder_ / name; }

  int read_picture(JsonObject& light, std::string_view key) override {
    return add_rig_picture(light, key, folder_, pictures_);
  }

  int add(Picture picture) override {
    pictures_.push_back(std::move(picture));
    return static_cast<int>(pictures_.size()) - 1;
  }
  [[nodiscard]] const Picture& at(int picture) const override {
    return pictures_[static_cast<std::size_t>(picture)];
  }

 private:
  const std::filesystem::path& folder_;
  std::vector<Picture>& pictures_;
};

class RigReader {
 public:
  RigReader(const JsonDocument& json, const std::filesystem::path& folder, FaultList& faults)
      : json_(json), folder_(folder), faults_(faults), files_(folder_, rig_.scene.pictures) {}

  Rig read() {
    JsonObject root(json_, json_.root(), faults_);
    read_scene_settings(json_, root, faults_, rig_.scene);
    if (const JsonValue* value = root.object("environment"))
      rig_.scene.environment = read_rig_environment(json_, *value, folder_, rig_.scene.pictures, faults_);
    if (const JsonValue* cameras = root.array("cameras")) {
      for (const JsonValue& value : cameras->children) read_camera(value);
    }
    if (const JsonValue* lights = root.array("lights")) {
      for (const JsonValue& value : lights->children) read_light(value);
    }
    if (const JsonValue* nodes = root.array("nodes")) {
      for (const JsonValue& value : nodes->children) read_override(value);
    }
    if (const JsonValue* terrain = root.array("terrain")) {
      for (const JsonValue& value : terrain->children) {
        const std::string name = fmt::format("terrain {}", 1 + (&value - terrain->children.data()));
        read_rig_terrain(json_, value, folder_, name, rig_.scene, faults_);
      }
    }
    if (const JsonValue* surfaces = root.array("surfaces")) {
      for (const JsonValue& value : surfaces->children) read_surface(value);
    }
    root.report_unknown_members("a rig");
    name_unnamed(rig_.scene.cameras, camera_names_, "camera");
    name_unnamed(rig_.scene.lights, light_names_, "light");
    name_paths();
    find_own_projectors();
    rig_.scene.warnings = faults_.warnings();
    return std::move(rig_);
  }

 private:
  void read_camera(const JsonValue& value) {
    const std::size_t errors_before = faults_.error_count();
    JsonObject object(json_, value, faults_);
    if (!value.is_object()) return;
    Camera camera;
    camera.name = object.string("name").value_or("");
    if (object.has("name") && camera.name.empty()) object.error("name", "is empty");
    const std::optional<glm::dmat4> pose = read_pose(object);
    if (const auto frustum = read_frustum(json_, object, faults_, FrustumOf::camera, std::nullopt)) {
      camera.projection = frustum->projection;
      camera.aspect_from_picture = !frustum->aspect_is_given;
    }
    object.any("path");  // read when the camera has its node
    object.report_unknown_members("a camera");
    claim_name(object, camera.name, camera_names_);
    if (!pose || faults_.error_count() != errors_before) return;
    Node node;
    node.name = camera.name;
    node.camera = static_cast<int>(rig_.scene.cameras.size());
    node.parent_from_node = *pose;
    rig_.scene.cameras.push_back(std::move(camera));
    rig_.scene.nodes.push_back(std::move(node));
    read_path(value, {&rig_.scene.cameras.back(), nullptr});
  }

  void read_light(const JsonValue& value) {
    std::optional<RigLight> read = read_rig_light(json_, value, files_, faults_);
    if (!read) return;
    JsonObject object(json_, value, faults_);
    claim_name(object, read->light.name, light_names_);
    Node node;
    node.name = read->light.name;
    node.light = static_cast<int>(rig_.scene.lights.size());
    node.parent_from_node = read->world_from_light;
    // A point light moves without turning.
    node.transform = Transform{glm::dvec3(node.parent_from_node[3]), {0, 0, 0, 1}, glm::dvec3(1)};
    rig_.scene.lights.push_back(std::move(read->light));
    rig_.scene.nodes.push_back(std::move(node));
    read_path(value, {nullptr, &rig_.scene.lights.back()});
  }

  // Of the camera or light that was read last.
  void read_path(const JsonValue& value, PathOwner owner) {
    owner.index =
        static_cast<int>(owner.camera != nullptr ? rig_.scene.cameras.size() : rig_.scene.lights.size()) - 1;
    owner.node = static_cast<int>(rig_.scene.nodes.size()) - 1;
    std::optional<Clip> path = read_rig_path(json_, value, owner, faults_);
    if (!path) return;
    path_nodes_.push_back(owner.node);
    rig_.scene.clips.push_back(std::move(*path));
  }

  // Once cameras and lights without names have been given some.
  void name_paths() {
    for (std::size_t i = 0; i < path_nodes_.size(); ++i) {
      const Node& node = rig_.scene.nodes[static_cast<std::size_t>(path_nodes_[i])];
      rig_.scene.clips[i].name = fmt::format("path of {}", node.name);
    }
  }

  void read_override(const JsonValue& value) {
    JsonObject object(json_, value, faults_);
    NodeOverride change;
    object.require("name");
    change.name = object.string("name").value_or("");
    if (object.has("name") && change.name.empty()) object.error("name", "is empty");
    change.flags = read_node_flags(object);
    object.any("path");
    object.report_unknown_members("a node");
    change.file = faults_.file();
    change.place = json_.place(value, "name");
    change.path = read_rig_path(json_, value, {}, faults_);
    rig_.overrides.push_back(std::move(change));
  }

  void read_surface(const JsonValue& value) {
    auto surface = read_rig_surface(json_, value, folder_, rig_.scene.pictures, faults_);
    if (surface) rig_.surfaces.push_back(std::move(*surface));
  }

  // A rig's own light is meant before one of the same name elsewhere.
  void find_own_projectors() {
    for (SurfaceOverride& surface : rig_.surfaces) {
      for (SurfaceOverride::Layer& layer : surface.layers) {
        const std::vector<Light>& lights = rig_.scene.lights;
        for (std::size_t i = 0; i < lights.size(); ++i) {
          if (layer.slide && lights[i].name == *layer.slide) layer.layer.projector = static_cast<int>(i);
        }
      }
    }
  }

  static void claim_name(JsonObject& object, const std::string& name, UniqueNames& names) {
    if (name.empty()) return;
    if (names.is_taken(name)) {
      object.error("name", fmt::format("{} is taken already", in_quotes(name)));
    } else {
      names.take(name);
    }
  }

  // Once all written names are known: "light 2" for the second light.
  template <class Named>
  void name_unnamed(std::vector<Named>& things, UniqueNames& names, std::string_view kind) {
    for (std::size_t i = 0; i < things.size(); ++i) {
      if (things[i].name.empty()) things[i].name = names.take(fmt::format("{} {}", kind, i + 1));
    }
    for (Node& node : rig_.scene.nodes) {
      const int index = kind == "camera" ? node.camera : node.light;
      if (index >= 0) node.name = things[static_cast<std::size_t>(index)].name;
    }
  }

  const JsonDocument& json_;
  const std::filesystem::path& folder_;
  FaultList& faults_;
  UniqueNames camera_names_, light_names_;
  std::vector<int> path_nodes_;  // of each clip
  Rig rig_;
  RigFiles files_;
};

}  // namespace

Result<Rig> read_rig(std::string_view text, const std::string& file, const std::filesystem::path& folder) {
  const Result<JsonDocument> json = JsonDocument::parse(text, file, JsonDocument::Place::line_and_path);
  if (!json) return tl::unexpected(json.error());
  FaultList faults(file);
  Rig rig = RigReader(*json, folder, faults).read();
  if (faults.has_errors()) return tl::unexpected(Error(Failure::bad_input, faults.errors()));
  return rig;
}

}  // namespace laterna
