#include "render/camera_views.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/elementary.h"
#include "base/refuse.h"

namespace laterna::render {
namespace {

// A picture of another aspect than the frustum's shows more, never less; or the width follows the picture.
Projection fitted(const Camera& camera, int width, int height) {
  Projection p = camera.projection;
  const double aspect = static_cast<double>(width) / height;
  const bool widen = camera.aspect_from_picture || aspect > p.aspect();
  if (widen) {
    const double middle = (p.left + p.right) / 2;
    const double half = (p.top - p.bottom) * aspect / 2;
    // A frustum that is off its axis stays so in proportion.
    const double shift = (p.right - p.left) > 0 ? middle / (p.right - p.left) * 2 * half : 0;
    p.left = shift - half;
    p.right = shift + half;
  } else {
    const double middle = (p.bottom + p.top) / 2;
    const double half = (p.right - p.left) / aspect / 2;
    const double shift = middle / (p.top - p.bottom) * 2 * half;
    p.bottom = shift - half;
    p.top = shift + half;
  }
  return p;
}

std::string names_of(const frame::Frame& frame) {
  std::string names;
  for (const frame::PlacedCamera& placed : frame.cameras) {
    names += (names.empty() ? "\"" : ", \"") + placed.camera->name + "\"";
  }
  return names.empty() ? "it has none" : "it has " + names;
}

}  // namespace

Result<View> camera_view(const frame::Frame& frame, const std::string& name, int width, int height) {
  for (const frame::PlacedCamera& placed : frame.cameras) {
    if (name.empty() || placed.camera->name == name)
      return View{placed.pose, fitted(*placed.camera, width, height)};
  }
  return refuse("the scene has no camera \"" + name + "\": " + names_of(frame));
}

View overview(const frame::Frame& frame, int width, int height) {
  const Angle yfov = Angle::degrees(40);
  const double aspect = static_cast<double>(std::max(width, 1)) / std::max(height, 1);
  const glm::dvec3 low(frame.bounds.low);
  const glm::dvec3 high(frame.bounds.high);
  const glm::dvec3 centre = 0.5 * (low + high);
  const double radius = std::max(0.5 * glm::length(high - low), 1e-6);
  const glm::dvec3 toward_eye = glm::normalize(glm::dvec3(0.55, 0.35, 1.0));
  View view;
  view.pose = *Pose::look_at(centre + toward_eye, centre, glm::dvec3(0, 1, 0));
  // As near as leaves every corner of the bounds in the picture, and a little air around them.
  constexpr double kAir = 1.06;
  const double half_height = tangent(0.5 * yfov.in_radians()) / kAir;
  double distance = 0.01 * radius;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p = glm::dvec3((corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
                                    (corner & 4) != 0 ? high.z : low.z) -
                         centre;
    const double x = std::abs(glm::dot(p, view.pose.right_ws())) / (half_height * aspect);
    const double y = std::abs(glm::dot(p, view.pose.up_ws())) / half_height;
    distance = std::max(distance, std::max(x, y) + glm::dot(p, toward_eye));
  }
  view.pose.position_ws = centre + toward_eye * distance;
  view.projection =
      Projection::perspective(yfov, aspect, distance / 1000, std::numeric_limits<double>::infinity());
  return view;
}

}  // namespace laterna::render
