#include "render/scene_defaults.h"

#include <algorithm>

#include "frame/place_lights.h"
#include "scene/surface_attributes.h"

namespace laterna::render {
namespace {

constexpr float kPi32 = 3.14159265F;

}  // namespace

void add_default_light(Scene& scene) {
  // A projector that is off and only paints is no light.
  const std::vector<int> decals = frame::decal_lights(scene);
  const bool has_light = std::any_of(scene.nodes.begin(), scene.nodes.end(), [&](const Node& n) {
    return n.light >= 0 && (scene.lights[static_cast<std::size_t>(n.light)].enabled ||
                            std::find(decals.begin(), decals.end(), n.light) == decals.end());
  });
  if (has_light || scene.ambient_is_set || scene.environment) return;
  if (!scene.photographs.empty() && !scene.photograph_settings.are_lit) return;  // they need no light
  Light sun;
  sun.name = "default sun";
  sun.type = LightType::directional;
  sun.intensity = kPi32;  // white, square to the light: 1
  scene.lights.push_back(sun);
  Node node;
  node.name = sun.name;
  node.light = static_cast<int>(scene.lights.size()) - 1;
  const Pose pose = *Pose::look_at({-0.4, 1, 0.7}, {0, 0, 0}, {0, 1, 0});
  node.parent_from_node = pose.world_from_view();
  scene.nodes.push_back(node);
  scene.ambient = glm::vec3(0.25F);
  scene.warnings.push_back(
      {{}, {}, "the scene has no light: it is lit by a default sun and a little ambient light"});
}

void add_missing_tangents(Scene& scene) {
  FaultList faults("");
  for (Mesh& mesh : scene.meshes) {
    for (Primitive& primitive : mesh.primitives) {
      if (primitive.material < 0 || !primitive.tangents.empty()) continue;
      const Material& material = scene.materials[static_cast<std::size_t>(primitive.material)];
      if (tangent_uv_set(material)) complete_attributes(primitive, &material, {}, mesh.name, faults);
    }
  }
  scene.warnings.insert(scene.warnings.end(), faults.warnings().begin(), faults.warnings().end());
}

}  // namespace laterna::render
