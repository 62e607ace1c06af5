#include "light/light_space_perspective.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <vector>

#include "light/camera_frustum.h"

namespace laterna::light {
namespace {

// A convex region of the plane square to the light.
using Polygon = std::vector<glm::dvec2>;

// Sutherland and Hodgman, Reentrant polygon clipping, 1974: what lies at `sign` · coordinate ≥ `limit`.
Polygon clip(const Polygon& polygon, int axis, double sign, double limit) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double from = sign * a[axis] - limit, to = sign * b[axis] - limit;
    if (from >= 0) kept.push_back(a);
    if ((from >= 0) != (to >= 0)) kept.push_back(a + (b - a) * (from / (from - to)));
  }
  return kept;
}

// Corners of the camera's frustum between two distances: bit 0 right, bit 1 top, bit 2 far.
std::array<glm::dvec3, 8> corners_of(const View& camera, const Range& depth) {
  const Projection& p = camera.projection;
  std::array<glm::dvec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    const double distance = (i & 4U) != 0 ? depth.high : depth.low;
    const double scale = p.is_orthographic ? 1 : distance;
    corners[i] = camera.pose.position_ws + camera.pose.forward_ws() * distance +
                 camera.pose.right_ws() * (scale * ((i & 1U) != 0 ? p.right : p.left)) +
                 camera.pose.up_ws() * (scale * ((i & 2U) != 0 ? p.top : p.bottom));
  }
  return corners;
}

// The light turned about its axis so that up is where the camera looks, as far as that is square to the light, and
// standing at the camera.
Pose turn_to_camera(const Pose& light, const Pose& camera) {
  const glm::dvec3 forward = light.forward_ws();
  const glm::dvec3 gaze = camera.forward_ws();
  const glm::dvec3 across = gaze - forward * glm::dot(forward, gaze);
  Pose turned = light;
  turned.position_ws = light.position_ws +
                       light.right_ws() * glm::dot(light.right_ws(), camera.position_ws - light.position_ws) +
                       light.up_ws() * glm::dot(light.up_ws(), camera.position_ws - light.position_ws);
  constexpr double kAlong =
      1e-3;  // the gaze is along the light: there is no direction to turn to, nor anything to gain
  if (glm::length(across) < kAlong) return turned;
  const glm::dvec3 up = glm::normalize(across);
  turned.world_from_view_rotation = glm::dmat3(glm::cross(forward, up), up, -forward);
  return turned;
}

Range along(const glm::dvec3& axis, const Pose& pose, const std::vector<ClusterBox>& boxes) {
  Range range;
  for (const ClusterBox& box : boxes)
    range.include(glm::dot(axis, box.middle - pose.position_ws), glm::dot(glm::abs(axis), box.reach));
  return range;
}

Range intersect(const Range& a, const Range& b) { return {std::max(a.low, b.low), std::min(a.high, b.high)}; }

// Where the picture needs the map: corners, in the light's plane, of what the camera sees that lies between casters
// and light or behind them.
Polygon find_needed(const View& camera, const Pose& light, const frame::Frame& frame,
                    const LightBox& casters) {
  const std::vector<ClusterBox> seen = find_seen_boxes(camera, frame);
  const Range x = intersect(casters.x, along(light.right_ws(), light, seen));
  const Range y = intersect(casters.y, along(light.up_ws(), light, seen));
  const std::array<glm::dvec3, 8> corners = corners_of(camera, find_depth_range(camera, frame));
  constexpr std::array<std::array<std::size_t, 4>, 6> kFaces = {
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  Polygon needed;
  for (const auto& face : kFaces) {
    Polygon polygon;
    for (const std::size_t i : face) {
      const glm::dvec3 p = corners[i] - light.position_ws;
      polygon.emplace_back(glm::dot(light.right_ws(), p), glm::dot(light.up_ws(), p));
    }
    polygon = clip(clip(clip(clip(polygon, 0, 1, x.low), 0, -1, -x.high), 1, 1, y.low), 1, -1, -y.high);
    needed.insert(needed.end(), polygon.begin(), polygon.end());
  }
  return needed;
}

// How far behind `first` casters reach of which a part lies beyond it: the eye of the warp stands behind them, because
// triangles cannot be drawn across it.
double reach_behind(double first, const Pose& light, const frame::Frame& frame) {
  double reach = 0;
  for (const Cluster& c : frame.clusters) {
    if ((c.flags & kCastsShadow) == 0) continue;
    const ClusterBox box = box_of(c);
    const double middle = glm::dot(light.up_ws(), box.middle - light.position_ws);
    const double half = glm::dot(glm::abs(light.up_ws()), box.reach);
    if (middle + half >= first) reach = std::max(reach, first - (middle - half));
  }
  return reach;
}

// The paper's distance of the eye from where the region begins, n_opt: it makes the error equal at both ends of the
// camera's depth range.
double best_eye_distance(const View& camera, const Pose& light, const Range& depth) {
  constexpr double kNoPerspective = 1e9;
  if (camera.projection.is_orthographic) return kNoPerspective;
  const double cosine = glm::dot(camera.pose.forward_ws(), light.forward_ws());
  const double sine = std::sqrt(std::max(1 - cosine * cosine, 1e-12));
  return (depth.low + std::sqrt(depth.low * depth.high)) / sine;
}

// x, y of the light's plane, and depth before `depth_low`; the fourth coordinate is 1 at y = first and grows by one every
// `eye_distance` metres.
glm::dmat4 make_warp(const Pose& light, double first, double eye_distance, double depth_low) {
  const auto row = [&](const glm::dvec3& axis, double add) {
    return glm::dvec4(axis, add - glm::dot(axis, light.position_ws));
  };
  const glm::dvec4 y = row(light.up_ws(), -first);
  const glm::dvec4 rows[4] = {row(light.right_ws(), 0), y, row(-light.forward_ws(), depth_low),
                              y / eye_distance + glm::dvec4(0, 0, 0, 1)};
  return glm::transpose(glm::dmat4(rows[0], rows[1], rows[2], rows[3]));
}

}  // namespace

ShadowView light_space_perspective_view(const frame::PlacedLight& placed, const frame::Frame& frame,
                                        const ShadowSettings& settings, const View* camera) {
  const ShadowView whole = fit_to_box(placed.pose, box_of_casters(placed.pose, frame), settings.resolution);
  if (camera == nullptr) return whole;
  const Pose light = turn_to_camera(placed.pose, camera->pose);
  const LightBox casters = box_of_casters(light, frame);
  const Polygon needed = find_needed(*camera, light, frame, casters);
  if (needed.empty()) return whole;
  Range y;
  for (const glm::dvec2& p : needed) y.include(p.y, 0);
  // Room for filters at the near rim, where the warp would run away.
  y.low -= 0.01 * y.length();
  if (!(y.length() > 0)) return whole;
  constexpr double kRoom = 1.1;
  const double eye_distance = std::max(best_eye_distance(*camera, light, find_depth_range(*camera, frame)),
                                       kRoom * reach_behind(y.low, light, frame));
  Range warped_x, warped_y;
  for (const glm::dvec2& p : needed) {
    const double w = 1 + (p.y - y.low) / eye_distance;
    warped_x.include(p.x / w, 0);
    warped_y.include((p.y - y.low) / w, 0);
  }
  warped_y.low = 0;
  if (!(warped_x.length() > 0)) return whole;
  ShadowView shadow;
  shadow.width = shadow.height = settings.resolution;
  // Texels to spare on each side, for filters.
  const int rim = 2 + settings.kernel / 2;
  const double spare = static_cast<double>(rim) / std::max(1, settings.resolution - 2 * rim);
  const auto side = [&](const Range& range) {
    const double more = spare * range.length();
    return Range{range.low - more, range.high + more};
  };
  const Range x_side = side(warped_x), y_side = side(warped_y);
  shadow.warp = {make_warp(light, y.low, eye_distance, casters.depth.low), {light, whole.view.projection}};
  shadow.view.projection = {true,        x_side.low, x_side.high,           y_side.low,
                            y_side.high, 0,          casters.depth.length()};
  return shadow;
}

}  // namespace laterna::light
