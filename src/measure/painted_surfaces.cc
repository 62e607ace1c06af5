#include "measure/painted_surfaces.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace laterna::measure {

Result<LayeredImage> paint_surfaces(const Renderer& renderer, const View& camera,
                                    const RenderSettings& settings,
                                    const std::function<glm::dvec3(const SeenSurface& seen)>& find_color) {
  RenderSettings wanted = settings;
  wanted.layers = {Layer::position, Layer::normal, Layer::object};
  wanted.shadows = ShadowTechnique::none;
  wanted.samples = 1;
  Result<LayeredImage> drawn = renderer.render(camera, wanted);
  if (!drawn) return drawn;
  const auto vector_at = [&](const char* name, std::size_t i) {
    const std::string base = name;
    return glm::dvec3(drawn->find(base + ".X")->values[i], drawn->find(base + ".Y")->values[i],
                      drawn->find(base + ".Z")->values[i]);
  };
  const std::vector<float>& object = drawn->find("id.object")->values;
  LayeredImage picture;
  picture.width = drawn->width;
  picture.height = drawn->height;
  for (const char* name : {"R", "G", "B"}) picture.channels.push_back({name, drawn->find(name)->values});
  for (std::size_t i = 0; i < object.size(); ++i) {
    if (object[i] < 0) continue;
    const int pixel = static_cast<int>(i);
    const SeenSurface seen = {vector_at("P", i), static_cast<std::uint32_t>(object[i]), pixel % picture.width,
                              pixel / picture.width};
    const glm::dvec3 gaze = camera.projection.is_orthographic
                                ? camera.pose.forward_ws()
                                : glm::normalize(seen.point_ws - camera.pose.position_ws);
    const double shade = 0.3 + 0.7 * std::abs(glm::dot(gaze, vector_at("N", i)));
    const glm::dvec3 color = find_color(seen) * shade;
    for (int c = 0; c < 3; ++c)
      picture.channels[static_cast<std::size_t>(c)].values[i] = static_cast<float>(color[c]);
  }
  return picture;
}

}  // namespace laterna::measure
