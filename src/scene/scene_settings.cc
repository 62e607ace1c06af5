#include "scene/scene_settings.h"

#include "scene/rig_ranges.h"

namespace laterna {

void read_scene_settings(const JsonDocument& json, JsonObject& object, FaultList& faults, Scene& scene) {
  if (const auto ambient = object.numbers<3>("ambient", kAmountOfLight)) {
    scene.ambient = glm::vec3((*ambient)[0], (*ambient)[1], (*ambient)[2]);
    scene.ambient_is_set = true;
  }
  if (const auto background = object.numbers<3>("background", kAmountOfLight)) {
    scene.background = glm::vec3((*background)[0], (*background)[1], (*background)[2]);
  }
  if (const JsonValue* value = object.object("shading")) {
    JsonObject shading(json, *value, faults, object.names());
    PhongHighlight highlight;
    highlight.specular =
        static_cast<float>(shading.number("specular", kAmountOfLight).value_or(highlight.specular));
    highlight.shininess =
        static_cast<float>(shading.number("shininess", kPositive).value_or(highlight.shininess));
    shading.report_unknown_members("shading");
    scene.phong = highlight;
  }
}

void NodeFlags::apply(Node& node) const {
  node.casts_shadow = casts_shadow.value_or(node.casts_shadow);
  node.receives_shadow = receives_shadow.value_or(node.receives_shadow);
  node.visible = visible.value_or(node.visible);
}

NodeFlags read_node_flags(JsonObject& object) {
  return {object.boolean("casts_shadow"), object.boolean("receives_shadow"), object.boolean("visible")};
}

}  // namespace laterna
