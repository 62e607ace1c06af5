#include <glm/common.hpp>
#include <limits>

#include "base/refuse.h"
#include "laterna/accuracy.h"

namespace laterna {
namespace {

struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};
  [[nodiscard]] bool is_empty() const { return low.x > high.x; }
  /// 0 in the middle, −1 and 1 on the sides.
  [[nodiscard]] glm::dvec3 at(const glm::dvec3& share) const {
    return 0.5 * (low + high) + 0.5 * (high - low) * share;
  }
};

Box box_of(const Mesh& mesh) {
  Box box;
  for (const Primitive& primitive : mesh.primitives) {
    for (const glm::vec3& position : primitive.positions) {
      box.low = glm::min(box.low, glm::dvec3(position));
      box.high = glm::max(box.high, glm::dvec3(position));
    }
  }
  return box;
}

// Around every mesh's box, where it stands.
Box bounds_of(const Scene& scene) {
  std::vector<Box> meshes;
  for (const Mesh& mesh : scene.meshes) meshes.push_back(box_of(mesh));
  const std::vector<glm::dmat4> world_from_node = world_from_nodes(scene);
  Box bounds;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (node.mesh < 0 || meshes[static_cast<std::size_t>(node.mesh)].is_empty()) continue;
    std::vector<glm::dmat4> places = node.node_from_instance;
    if (places.empty()) places.emplace_back(1.0);
    for (const glm::dmat4& place : places) {
      for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 side((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                              (corner & 4) != 0 ? 1 : -1);
        const glm::dvec3 point_ws =
            world_from_node[i] * place * glm::dvec4(meshes[static_cast<std::size_t>(node.mesh)].at(side), 1);
        bounds.low = glm::min(bounds.low, point_ws);
        bounds.high = glm::max(bounds.high, point_ws);
      }
    }
  }
  return bounds;
}

Result<void> add(Scene& scene, Light light, const glm::dvec3& position_ws, const glm::dvec3& target_ws) {
  Result<Pose> pose = Pose::look_at(position_ws, target_ws, {0, 1, 0});
  // Straight down, as in a scene without width.
  if (!pose) pose = Pose::look_at(position_ws, target_ws, {0, 0, -1});
  if (!pose) pose = Pose::look_at(position_ws, position_ws - glm::dvec3(0, 1, 0), {0, 0, -1});
  if (!pose) return tl::unexpected(pose.error());
  Node node;
  node.name = light.name;
  node.light = static_cast<int>(scene.lights.size());
  node.parent_from_node = pose->world_from_view();
  scene.lights.push_back(std::move(light));
  scene.nodes.push_back(std::move(node));
  return {};
}

Light light_of(const char* name, LightType type, double intensity) {
  Light light;
  light.name = name;
  light.type = type;
  light.intensity = intensity;
  return light;
}

}  // namespace

Result<Scene> with_standard_lights(Scene scene) {
  if (std::vector<Diagnostic> faults = validate(scene); !faults.empty())
    return tl::unexpected(Error(Failure::bad_input, std::move(faults)));
  const Box bounds = bounds_of(scene);
  if (bounds.is_empty()) return refuse("the scene has no surface that lights could be placed by");
  for (Light& light : scene.lights) {
    light.enabled = false;
    // A scene's own light of such a name would be taken for ours.
    if (light.name.starts_with("auto ")) light.name = "own " + light.name;
  }
  // Lit at half the diagonal's distance as by 1 lux.
  const glm::dvec3 size = bounds.high - bounds.low;
  const double candela = 0.25 * (size.x * size.x + size.y * size.y + size.z * size.z);
  // 45° high: as far up as along, to the right of and before the scene.
  const glm::dvec3 toward_sun(0.6, 1, 0.8);
  Light spot = light_of("auto spot", LightType::spot, candela);
  spot.inner_cone = Angle::degrees(30);
  spot.outer_cone = Angle::degrees(40);
  const glm::dvec3 middle = bounds.at({0, 0, 0});
  for (Result<void> added :
       {add(scene, light_of("auto sun", LightType::directional, 1), middle + toward_sun, middle),
        add(scene, spot, bounds.at({-0.5, 0.8, 0.4}), bounds.at({0.2, -1, -0.1})),
        add(scene, light_of("auto point", LightType::point, candela), bounds.at({0.3, 0.5, -0.35}),
            middle)}) {
    if (!added) return tl::unexpected(std::move(added.error()));
  }
  return scene;
}

}  // namespace laterna
