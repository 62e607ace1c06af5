#include "camera_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace laterna::app {
namespace {

// Weights of the stops before, at, after and after that.
std::array<double, 4> spline_weights(double t) {
  return {t * (-0.5 + t * (1 - 0.5 * t)), 1 + t * t * (-2.5 + 1.5 * t), t * (0.5 + t * (2 - 1.5 * t)),
          t * t * (-0.5 + 0.5 * t)};
}

}  // namespace

View view_on_path(std::span<const View> stops, double t) {
  const auto last = static_cast<std::ptrdiff_t>(stops.size()) - 1;
  const auto from = std::clamp(static_cast<std::ptrdiff_t>(std::floor(t)), std::ptrdiff_t{0},
                               std::max<std::ptrdiff_t>(last - 1, 0));
  const std::array<double, 4> weights = spline_weights(std::clamp(t - static_cast<double>(from), 0.0, 1.0));
  const auto stop = [&](std::ptrdiff_t i) -> const View& {
    return stops[static_cast<std::size_t>(std::clamp(from + i - 1, std::ptrdiff_t{0}, last))];
  };
  const glm::dquat middle = glm::quat_cast(stop(1).pose.world_from_view_rotation);
  View view = stop(1);
  view.pose.position_ws = glm::dvec3(0);
  glm::dquat rotation(0, 0, 0, 0);
  std::array<double, 4> sides{};
  for (std::ptrdiff_t i = 0; i < 4; ++i) {
    const double weight = weights[static_cast<std::size_t>(i)];
    const View& at = stop(i);
    view.pose.position_ws += weight * at.pose.position_ws;
    // Of the two quaternions of a rotation, the one on this side.
    const glm::dquat q = glm::quat_cast(at.pose.world_from_view_rotation);
    rotation = rotation + q * (glm::dot(q, middle) < 0 ? -weight : weight);
    const Projection& p = at.projection;
    const std::array<double, 4> of_stop = {p.left, p.right, p.bottom, p.top};
    for (std::size_t k = 0; k < 4; ++k) sides[k] += weight * of_stop[k];
  }
  view.pose.world_from_view_rotation = glm::mat3_cast(glm::normalize(rotation));
  view.projection.left = sides[0], view.projection.right = sides[1];
  view.projection.bottom = sides[2], view.projection.top = sides[3];
  return view;
}

View with_aspect(View view, double aspect) {
  Projection& p = view.projection;
  const double middle = (p.left + p.right) / 2, half = (p.top - p.bottom) / 2 * aspect;
  p.left = middle - half, p.right = middle + half;
  return view;
}

}  // namespace laterna::app
