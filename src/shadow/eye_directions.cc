#include "shadow/eye_directions.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace laterna::shadow {
namespace {

__extension__ using Wide = __int128;  // three products of 2⁶¹ and 2³⁰

int sign_of(Wide value) { return value > 0 ? 1 : (value < 0 ? -1 : 0); }

Wide product(const EdgeNormal& edge, const EyeDirection& direction) {
  return Wide{edge.x} * direction.x + Wide{edge.y} * direction.y + Wide{edge.w} * direction.w;
}

// How many times the scene's size the eye of an orthographic camera is put behind it: far enough that its lines of sight
// pass through the camera's own pixels, near enough that float positions keep their differences in its directions.
constexpr double kEyeDistance = 4096;

}  // namespace

EdgeNormal edge_between(const EyeDirection& a, const EyeDirection& b) {
  const auto wide = [](std::int32_t v) { return std::int64_t{v}; };
  return {wide(a.y) * b.w - wide(a.w) * b.y, wide(a.w) * b.x - wide(a.x) * b.w,
          wide(a.x) * b.y - wide(a.y) * b.x};
}

int side_of(const EdgeNormal& edge, const EyeDirection& direction) {
  if (const int sign = sign_of(product(edge, direction)); sign != 0) return sign;
  if (edge.x != 0) return sign_of(edge.x);
  if (edge.y != 0) return sign_of(edge.y);
  return sign_of(edge.w);
}

int turn_of(const EyeDirection& a, const EyeDirection& b, const EyeDirection& c) {
  return sign_of(product(edge_between(a, b), c));
}

Eye::Eye(const raster::RasterView& camera, const frame::Bounds& bounds) {
  while (unit_ < 0.5 * std::max(camera.width, camera.height)) unit_ *= 2;
  position_ws_ = camera.eye_ws;
  x_row_ = camera.x_row;
  y_row_ = camera.y_row;
  w_row_ = camera.w_row;
  if (camera.is_orthographic) {
    const glm::dvec3 forward = -camera.w_row;
    const glm::dvec3 centre = 0.5 * (glm::dvec3(bounds.low) + glm::dvec3(bounds.high));
    const double size = std::max(glm::length(glm::dvec3(bounds.high) - glm::dvec3(bounds.low)), 1e-3);
    const double distance = kEyeDistance * size;
    // The camera's own axis, which its pixels are counted from, at the middle of the scene.
    const double middle = glm::dot(forward, centre - camera.eye_ws);
    position_ws_ = camera.eye_ws + (middle - distance) * forward;
    x_row_ = camera.x_row * distance + camera.x_add * forward;
    y_row_ = camera.y_row * distance + camera.y_add * forward;
    w_row_ = forward;
  }
  x_row_ /= unit_;
  y_row_ /= unit_;
  handedness_ = glm::dot(x_row_, glm::cross(y_row_, w_row_)) < 0 ? -1 : 1;
}

EyeDirection Eye::to_infinity(const glm::dvec3& direction_ws) const {
  const double x = glm::dot(x_row_, direction_ws);
  const double y = glm::dot(y_row_, direction_ws);
  const double w = glm::dot(w_row_, direction_ws);
  const double largest = std::max({std::abs(x), std::abs(y), std::abs(w)});
  // What lies in the eye itself is seen in any direction: it moves by nothing.
  if (!(largest > 0)) return {0, 0, kDirectionScale};
  const auto whole = [&](double v) {
    return static_cast<std::int32_t>(std::floor(v / largest * kDirectionScale + 0.5));
  };
  return {whole(x), whole(y), whole(w)};
}

EyeDirection Eye::to_point(const glm::dvec3& position_ws) const {
  return to_infinity(position_ws - position_ws_);
}

}  // namespace laterna::shadow
