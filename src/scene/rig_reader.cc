#include "scene/rig_reader.h"

#include <fmt/format.h>

#include "scene/fault_list.h"
#include "scene/json_document.h"
#include "scene/json_object.h"
#include "scene/rig_frustum.h"
#include "scene/rig_lights.h"
#include "scene/rig_pose.h"
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
    const std::optional<std::string> name = light.string(key);
    if (!name) return -1;
    auto path = find(*name);
    if (!path) {
      light.error(key, path.error());
      return -1;
    }
    Picture picture;
    picture.file = std::move(*path);
    picture.name = picture.file.string();
    return add(std::move(picture));
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
    if (const JsonValue* cameras = root.array("cameras")) {
      for (const JsonValue& value : cameras->children) read_camera(value);
    }
    if (const JsonValue* lights = root.array("lights")) {
      for (const JsonValue& value : lights->children) read_light(value);
    }
    if (const JsonValue* nodes = root.array("nodes")) {
      for (const JsonValue& value : nodes->children) read_override(value);
    }
    root.report_unknown_members("a rig");
    name_unnamed(rig_.scene.cameras, camera_names_, "camera");
    name_unnamed(rig_.scene.lights, light_names_, "light");
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
    object.report_unknown_members("a camera");
    claim_name(object, camera.name, camera_names_);
    if (!pose || faults_.error_count() != errors_before) return;
    Node node;
    node.name = camera.name;
    node.camera = static_cast<int>(rig_.scene.cameras.size());
    node.parent_from_node = *pose;
    rig_.scene.cameras.push_back(std::move(camera));
    rig_.scene.nodes.push_back(std::move(node));
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
    rig_.scene.lights.push_back(std::move(read->light));
    rig_.scene.nodes.push_back(std::move(node));
  }

  void read_override(const JsonValue& value) {
    JsonObject object(json_, value, faults_);
    NodeOverride change;
    object.require("name");
    change.name = object.string("name").value_or("");
    if (object.has("name") && change.name.empty()) object.error("name", "is empty");
    change.flags = read_node_flags(object);
    object.report_unknown_members("a node");
    change.file = faults_.file();
    change.place = json_.place(value, "name");
    rig_.overrides.push_back(std::move(change));
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
