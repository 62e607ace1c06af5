#include "measure/painted_surfaces.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "measure/seen_geometry.h"

namespace laterna::measure {

Result<LayeredImage> paint_surfaces(const Renderer& renderer, const View& camera,
                                    const RenderSettings& settings,
                                    const std::function<glm::dvec3(const SeenSurface& seen)>& find_color) {
  RenderSettings wanted = settings;
  wanted.samples = 1;
  const Result<SeenGeometry> drawn = draw_geometry(renderer, camera, wanted);
  if (!drawn) return tl::unexpected(drawn.error());
  LayeredImage picture;
  picture.width = settings.width;
  picture.height = settings.height;
  for (const char* name : {"R", "G", "B"})
    picture.channels.push_back({name, drawn->unshadowed.find(name)->values});
  for (std::size_t i = 0; i < drawn->object.size(); ++i) {
    if (drawn->object[i] < 0) continue;
    const int pixel = static_cast<int>(i);
    const SeenSurface seen = {drawn->position_ws[i], static_cast<std::uint32_t>(drawn->object[i]),
                              pixel % picture.width, pixel / picture.width};
    const glm::dvec3 gaze = camera.projection.is_orthographic
                                ? camera.pose.forward_ws()
                                : glm::normalize(seen.point_ws - camera.pose.position_ws);
    const double shade = 0.3 + 0.7 * std::abs(glm::dot(gaze, glm::dvec3(drawn->normal_ws[i])));
    const glm::dvec3 color = find_color(seen) * shade;
    for (int c = 0; c < 3; ++c)
      picture.channels[static_cast<std::size_t>(c)].values[i] = static_cast<float>(color[c]);
  }
  return picture;
}

}  // namespace laterna::measure
