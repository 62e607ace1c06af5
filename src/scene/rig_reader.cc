#include "scene/rig_reader.h"

#include <fmt/format.h>

#include "scene/fault_list.h"
#include "scene/json_document.h"
#include "scene/json_object.h"
#include "scene/rig_environment.h"
#include "scene/rig_frustum.h"
#include "scene/rig_lights.h"
#include "scene/rig_pose.h"
#include "scene/rig_ranges.h"
#include "scene/spelling.h"
#include "scene/unique_names.h"

namespace laterna {
namespace {

class RigReader {
 public:
  RigReader(const JsonDocument& json, const std::filesystem::path& folder, FaultList& faults)
      : json_(json), folder_(folder), faults_(faults) {}

  Rig read() {
    JsonObject root(json_, json_.root(), faults_);
    read_settings(root);
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
  void read_settings(JsonObject& root) {
    Scene& scene = rig_.scene;
    if (const auto ambient = root.numbers<3>("ambient", kAmountOfLight)) {
      scene.ambient = glm::vec3((*ambient)[0], (*ambient)[1], (*ambient)[2]);
      scene.ambient_is_set = true;
    }
    if (const auto background = root.numbers<3>("background", kAmountOfLight)) {
      scene.background = glm::vec3((*background)[0], (*background)[1], (*background)[2]);
    }
    if (const JsonValue* value = root.object("environment"))
      scene.environment = read_rig_environment(json_, *value, folder_, scene.pictures, faults_);
    if (const JsonValue* value = root.object("shading")) {
      JsonObject shading(json_, *value, faults_);
      PhongHighlight highlight;
      highlight.specular =
          static_cast<float>(shading.number("specular", kAmountOfLight).value_or(highlight.specular));
      highlight.shininess =
          static_cast<float>(shading.number("shininess", kPositive).value_or(highlight.shininess));
      shading.report_unknown_members("shading");
      scene.phong = highlight;
    }
  }

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
    std::optional<RigLight> read = read_rig_light(json_, value, folder_, rig_.scene.pictures, faults_);
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
    change.casts_shadow = object.boolean("casts_shadow");
    change.receives_shadow = object.boolean("receives_shadow");
    change.visible = object.boolean("visible");
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
