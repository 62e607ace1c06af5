#include "frame/slide_points.h"

#include <algorithm>

namespace laterna::frame {

std::optional<glm::dvec2> slide_from_world(const PlacedLight& projector, const glm::dvec3& point_ws) {
  const View& view = projector.view;
  const double distance = -(view.view_from_world() * glm::dvec4(point_ws, 1)).z;
  // As the shading has it: nothing behind the lens, nor before the near plane of parallel light, is lit.
  const bool is_parallel = view.projection.is_orthographic;
  if (!(distance > (is_parallel ? std::min(view.projection.near, 0.0) : 0.0))) return std::nullopt;
  const glm::dvec4 image = view.image_from_world() * glm::dvec4(point_ws, 1);
  const glm::dvec2 place = glm::dvec2(image) / image.w;
  return projector.lens ? projector.lens->slide_from_beam(place) : place;
}

std::optional<glm::dvec3> world_from_slide(const PlacedLight& projector, glm::dvec2 slide, double distance) {
  const Projection& frame = projector.lens ? projector.lens->frame : projector.view.projection;
  glm::dvec2 direction(frame.left + slide.x * (frame.right - frame.left),
                       frame.top - slide.y * (frame.top - frame.bottom));
  if (projector.lens) {
    // OpenCV's y is downward.
    const auto ideal = undistorted(projector.lens->distortion, {direction.x, -direction.y});
    if (!ideal) return std::nullopt;
    direction = {ideal->x, -ideal->y};
  }
  if (!frame.is_orthographic) direction *= distance;
  return glm::dvec3(projector.pose.world_from_view() * glm::dvec4(direction, -distance, 1));
}

}  // namespace laterna::frame
