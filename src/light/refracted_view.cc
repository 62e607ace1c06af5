#include "light/refracted_view.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace laterna::light {
namespace {

// A ray from a view, and what is left of it behind the plane.
struct BentRay {
  glm::dvec3 along_ws, bent_ws;  // unit
  double cosine;                 // of the ray to the plane's normal, 0.001 or more
  glm::dvec3 place_ws;           // on the plane
  double distance;               // of the place, along the view's axis
  double rise;  // how many times as high above the plane one stands who looks straight along the bent ray
};

// Directions alone, of a ray of any length.
BentRay bend(const RefractingPlane& plane, const glm::dvec3& ray) {
  BentRay bent{};
  bent.along_ws = glm::normalize(ray);
  bent.cosine = std::clamp(-glm::dot(plane.normal_ws, bent.along_ws), 1e-3, 1.0);
  // Snell's law; beyond what can leave, the most glancing that does.
  const glm::dvec3 across = bent.along_ws + bent.cosine * plane.normal_ws;
  const double sine = glm::length(across), bent_sine = std::min(sine / plane.index, 0.99);
  const double bent_cosine = std::sqrt(1 - bent_sine * bent_sine);
  bent.bent_ws = (sine > 0 ? across / sine * bent_sine : glm::dvec3(0)) - bent_cosine * plane.normal_ws;
  bent.rise = sine > 1e-6 ? bent_cosine / bent_sine * sine / bent.cosine : plane.index;
  return bent;
}

BentRay bend(const View& view, const RefractingPlane& plane, const glm::dvec2& image) {
  const Projection& p = view.projection;
  const Pose& pose = view.pose;
  const double x = p.left + (p.right - p.left) * image.x, y = p.top + (p.bottom - p.top) * image.y;
  const glm::dvec3 aside = pose.right_ws() * x + pose.up_ws() * y;
  const glm::dvec3 from = pose.position_ws + (p.is_orthographic ? aside : glm::dvec3(0));
  const glm::dvec3 ray = pose.forward_ws() + (p.is_orthographic ? glm::dvec3(0) : aside);
  BentRay bent = bend(plane, ray);
  bent.distance = (glm::dot(plane.normal_ws, from) - plane.offset) / (bent.cosine * glm::length(ray));
  bent.place_ws = from + ray * bent.distance;
  return bent;
}

// Looks along `forward_ws`, turned as `like` is.
glm::dmat3 turned_to(const Pose& like, const glm::dvec3& forward_ws) {
  glm::dvec3 right = glm::cross(forward_ws, like.up_ws());
  if (glm::length(right) < 1e-3) right = like.right_ws() - glm::dot(like.right_ws(), forward_ws) * forward_ws;
  right = glm::normalize(right);
  return {right, glm::cross(right, forward_ws), -forward_ws};
}

}  // namespace

// An eye above the plane sees along rays that, behind it, come from about one point above the eye: where the bent ray through the
// middle, drawn back, meets the eye's plumb line (the sagittal focus).
RefractedView refracted_view(const View& from, int width, int height, const RefractingPlane& plane,
                             const SeenOfPlane& seen) {
  const BentRay middle = bend(from, plane, seen.middle);
  const bool is_orthographic = from.projection.is_orthographic;
  RefractedView made{from, {}, 0};
  Pose& pose = made.view.pose;
  Projection& projection = made.view.projection;
  double reach = 0;
  for (const glm::dvec3& corner : seen.corners_ws)
    reach = std::max(reach, glm::length(corner - middle.place_ws));
  const double height_above = glm::dot(plane.normal_ws, pose.position_ws) - plane.offset;
  const double distance = middle.distance + reach;  // orthographic: far enough that all of it lies before
  const glm::dvec3 eye = is_orthographic
                             ? middle.place_ws - middle.bent_ws * distance
                             : pose.position_ws + plane.normal_ws * (height_above * (middle.rise - 1));
  pose.world_from_view_rotation = turned_to(from.pose, glm::normalize(middle.place_ws - eye));
  pose.position_ws = eye;
  projection.far += is_orthographic ? 2 * reach : glm::length(eye - from.pose.position_ws);

  constexpr int kPlacesOnSide = 8;
  constexpr double kWidest = 6;  // tangent: where parts lie nearly square to the axis
  constexpr double kWidestBent =
      4;  // of rays that fan out: the wider, the coarser is what lies in the middle
  glm::dvec2 low(1e300), high(-1e300);
  double density = 0;  // pixels that a unit of the frustum must have, of those that it has in the other view
  const auto scale_of = [&](const glm::dvec3& way, double widest) {
    return is_orthographic ? 1 : 1 / std::max(glm::dot(pose.forward_ws(), way), glm::length(way) / widest);
  };
  const auto hold = [&](const glm::dvec3& way, double widest) {
    const glm::dvec2 at =
        glm::dvec2(glm::dot(pose.right_ws(), way), glm::dot(pose.up_ws(), way)) * scale_of(way, widest);
    low = glm::min(low, at);
    high = glm::max(high, at);
  };
  for (const glm::dvec3& corner : seen.corners_ws) {
    const glm::dvec3 way = corner - eye;
    const double before = glm::dot(from.pose.forward_ws(), corner - from.pose.position_ws);
    hold(way, kWidest);
    density = std::max(density, is_orthographic ? 1.0 : 1 / (scale_of(way, kWidest) * before));
  }
  // Out of water rays fan out more than straight ones from the eye: what lies far off along them is held too.
  for (std::size_t i = 0; !is_orthographic && plane.index < 1 && i < seen.corners_ws.size(); ++i) {
    const glm::dvec3 &a = seen.corners_ws[i], &b = seen.corners_ws[(i + 1) % seen.corners_ws.size()];
    for (int k = 0; k < kPlacesOnSide; ++k)
      hold(
          bend(plane, glm::mix(a, b, static_cast<double>(k) / kPlacesOnSide) - from.pose.position_ws).bent_ws,
          kWidestBent);
  }
  const glm::dvec2 centre = 0.5 * (low + high), half = 0.55 * (high - low);
  glm::dvec2 size(from.projection.right - from.projection.left, from.projection.top - from.projection.bottom);
  size /= density;
  size *= std::max({1.0, 2 * half.x / size.x, 2 * half.y / size.y});
  projection.left = centre.x - 0.5 * size.x;
  projection.right = centre.x + 0.5 * size.x;
  projection.bottom = centre.y - 0.5 * size.y;
  projection.top = centre.y + 0.5 * size.y;
  const glm::dvec2 pixels = glm::dvec2(width, height) * half / size,
                   middle_pixel = 0.5 * glm::dvec2(width, height);
  const auto begin = [](double at) { return std::max(static_cast<int>(std::floor(at)) - 2, 0); };
  const auto end = [](double at, int most) { return std::min(static_cast<int>(std::ceil(at)) + 2, most); };
  made.box = {begin(middle_pixel.x - pixels.x), begin(middle_pixel.y - pixels.y),
              end(middle_pixel.x + pixels.x, width), end(middle_pixel.y + pixels.y, height)};
  made.pixel = size.x / width * (is_orthographic ? 1 : glm::length(middle.place_ws - eye));
  return made;
}

}  // namespace laterna::light
