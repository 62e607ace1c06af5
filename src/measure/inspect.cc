#include "base/refuse.h"
#include "laterna/measure.h"

#include <algorithm>
#include <cmath>

namespace laterna {

Result<PointReport> inspect_point(const Renderer& renderer, const View& camera, int width, int height,
                                  const std::string& light, const glm::dvec3& point_ws) {
  if (!std::isfinite(point_ws.x) || !std::isfinite(point_ws.y) || !std::isfinite(point_ws.z)) {
    return refuse("the point's coordinates must be finite");
  }
  if (width < 1 || height < 1) return refuse("the picture's width and height must be at least 1");
  const Result<View> light_view = renderer.light_view(light);
  if (!light_view) return tl::unexpected(light_view.error());
  PointReport report;
  report.world = point_ws;
  report.clip_from_world = camera.clip_from_world();
  report.light_from_world = light_view->clip_from_world();
  report.texture_from_world = light_view->image_from_world();

  report.eye_linear = eye_linear_planes(camera, *light_view);

  const glm::dvec4 world(point_ws, 1);
  report.clip = report.clip_from_world * world;
  report.screen = glm::dvec2(report.clip) / report.clip.w;
  report.pixel = {(report.screen.x + 1) / 2 * width, (1 - report.screen.y) / 2 * height};
  report.light = report.light_from_world * world;
  const glm::dvec4 texture = report.texture_from_world * world;
  report.texture = glm::dvec3(texture) / texture.w;
  report.distance = -(light_view->view_from_world() * world).z;
  // As the shading has it: nothing behind the lens, nor before the near plane of parallel light, is lit.
  const Projection& projection = light_view->projection;
  report.is_ahead =
      projection.is_orthographic ? report.distance > std::min(projection.near, 0.0) : report.distance > 0;
  const auto in_unit = [](double v) { return v >= 0 && v <= 1; };
  std::optional<glm::dvec2> place(report.texture);
  if (const auto slide = renderer.slide_from_world(light, point_ws)) place = report.slide = *slide;
  report.is_inside = report.is_ahead && place && in_unit(place->x) && in_unit(place->y);
  return report;
}

}  // namespace laterna
