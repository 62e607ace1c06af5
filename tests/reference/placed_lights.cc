#include "reference/placed_lights.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "reference/shapes.h"

namespace laterna::reference {
namespace {

// The box that the scene's meshes fill.
struct Box {
  glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

  [[nodiscard]] glm::dvec3 at(double x, double y, double z) const {
    return low + (high - low) * glm::dvec3(x, y, z);
  }
};

Box box_of(const Scene& scene) {
  Box box;
  const std::vector<glm::dmat4> world_from_node = world_from_nodes(scene);
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    if (scene.nodes[n].mesh < 0) continue;
    for (const Primitive& primitive :
         scene.meshes[static_cast<std::size_t>(scene.nodes[n].mesh)].primitives) {
      for (const glm::vec3& position : primitive.positions) {
        const glm::dvec3 p(world_from_node[n] * glm::dvec4(glm::dvec3(position), 1));
        box.low = glm::min(box.low, p);
        box.high = glm::max(box.high, p);
      }
    }
  }
  if (!(box.low.x <= box.high.x)) throw std::runtime_error("the scene has no meshes");
  return box;
}

Light light_of(const std::string& name, LightType type) {
  Light light;
  light.name = name;
  light.type = type;
  return light;
}

}  // namespace

void place_lights(Scene& scene, const std::string& only) {
  for (Light& light : scene.lights) light.enabled = false;
  const Box box = box_of(scene);
  const auto is_wanted = [&](const char* name) { return only.empty() || only == name; };
  if (is_wanted(kPlacedLights[0])) {
    const glm::dvec3 middle = box.at(0.5, 0.5, 0.5);
    // As high as it is far to the side, which is 45°.
    add_light(scene, light_of(kPlacedLights[0], LightType::directional),
              middle + glm::dvec3(0.8, 1, 0.6) * glm::length(box.high - box.low), middle);
  }
  if (is_wanted(kPlacedLights[1])) {
    add_light(scene, light_of(kPlacedLights[1], LightType::spot), box.at(0.3, 0.9, 0.7),
              box.at(0.55, 0.1, 0.45), {0, 0, 1});
  }
  if (is_wanted(kPlacedLights[2])) {
    const glm::dvec3 place = box.at(0.6, 0.65, 0.55);
    add_light(scene, light_of(kPlacedLights[2], LightType::point), place, place + glm::dvec3(0, 0, -1));
  }
}

std::array<View, 2> placed_views(const Renderer& renderer, int width, int height) {
  const Box box = box_of(renderer.scene());
  const double size = glm::length(box.high - box.low);
  return {renderer.overview(width, height),
          look(box.at(0.1, 0.55, 0.9), box.at(0.6, 0.4, 0.4), 65, static_cast<double>(width) / height,
               {0, 1, 0}, 0.001 * size, 100 * size)};
}

}  // namespace laterna::reference
