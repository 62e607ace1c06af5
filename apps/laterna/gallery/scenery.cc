#include "scenery.h"

#include <cmath>
#include <memory>
#include <utility>

#include "paintings.h"

namespace laterna::app {
namespace {

Node& add_node(Scene& scene, std::string name) {
  Node& node = scene.nodes.emplace_back();
  node.name = std::move(name);
  return node;
}

Light& add_light(Scene& scene, std::string name, LightType type, Gaze gaze, glm::vec3 color) {
  Node& node = add_node(scene, name);
  node.light = static_cast<int>(scene.lights.size());
  const glm::dvec3 along = gaze.to - gaze.from;
  const bool is_steep = std::abs(along.x) + std::abs(along.z) < 0.01 * std::abs(along.y);
  const Result<Pose> pose =
      Pose::look_at(gaze.from, gaze.to, is_steep ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0));
  if (pose) node.parent_from_node = pose->world_from_view();
  Light& light = scene.lights.emplace_back();
  light.name = std::move(name);
  light.type = type;
  light.color = color;
  light.attenuation = Attenuation::none;
  return light;
}

}  // namespace

int add_picture(Scene& scene, std::string name, Image pixels) {
  Picture& picture = scene.pictures.emplace_back();
  picture.name = std::move(name);
  picture.pixels = std::make_shared<const Image>(std::move(pixels));
  return static_cast<int>(scene.pictures.size()) - 1;
}

int add_material(Scene& scene, std::string name, glm::vec3 color, int texture, float roughness) {
  Material& material = scene.materials.emplace_back();
  material.name = std::move(name);
  material.base_color = glm::vec4(color, 1);
  material.base_color_texture.picture = texture;
  material.metallic = 0;
  material.roughness = roughness;
  return static_cast<int>(scene.materials.size()) - 1;
}

int add_object(Scene& scene, std::string name, Primitive primitive, int material) {
  primitive.material = material;
  Node& node = add_node(scene, name);
  node.mesh = static_cast<int>(scene.meshes.size());
  Mesh& mesh = scene.meshes.emplace_back();
  mesh.name = std::move(name);
  mesh.primitives.push_back(std::move(primitive));
  return static_cast<int>(scene.nodes.size()) - 1;
}

Light& add_sun(Scene& scene, std::string name, Gaze gaze, glm::vec3 color) {
  return add_light(scene, std::move(name), LightType::directional, gaze, color);
}

Light& add_lamp(Scene& scene, std::string name, Gaze gaze, Angle outer_cone, glm::vec3 color) {
  Light& light = add_light(scene, std::move(name), LightType::spot, gaze, color);
  light.outer_cone = outer_cone;
  light.inner_cone = Angle::degrees(outer_cone.in_degrees() * 0.85);
  return light;
}

Light& add_projector(Scene& scene, std::string name, Gaze gaze, Angle yfov, int slide) {
  Light& light = add_light(scene, std::move(name), LightType::projector, gaze, glm::vec3(1));
  light.projection = Projection::perspective(yfov, 1, 0.1, std::numeric_limits<double>::infinity());
  light.slide = slide;
  return light;
}

int add_floor(Scene& scene, float size) {
  const int tiles = add_material(scene, "tiles", glm::vec3(1), add_picture(scene, "tiles", paint_tiles(256)));
  return add_object(scene, "floor", rectangle({0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {size, size}, 2.0F), tiles);
}

void set_mood(Scene& scene, float ambient) {
  scene.ambient = ambient * glm::vec3(0.92F, 0.96F, 1.0F);
  scene.ambient_is_set = true;
  scene.background = glm::vec3(0.50F, 0.58F, 0.68F);
}

}  // namespace laterna::app
