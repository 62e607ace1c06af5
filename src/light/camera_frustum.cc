#include "light/camera_frustum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "base/elementary.h"

namespace laterna::light {
namespace {

// A side of a view: a point p is within where normal · (p − eye) ≥ offset.
struct Side {
  glm::dvec3 normal;
  double offset;
};

std::array<Side, 4> sides_of(const View& view) {
  const Projection& p = view.projection;
  const glm::dvec3 right = view.pose.right_ws(), up = view.pose.up_ws(), forward = view.pose.forward_ws();
  if (p.is_orthographic) return {{{right, p.left}, {-right, -p.right}, {up, p.bottom}, {-up, -p.top}}};
  return {{{right - p.left * forward, 0},
           {p.right * forward - right, 0},
           {up - p.bottom * forward, 0},
           {p.top * forward - up, 0}}};
}

double power_of_two_below(double distance) { return exponential2(std::floor(logarithm2(distance))); }
double power_of_two_above(double distance) { return exponential2(std::ceil(logarithm2(distance))); }

}  // namespace

ClusterBox box_of(const Cluster& cluster) {
  const glm::dvec3 low(cluster.low_ws[0], cluster.low_ws[1], cluster.low_ws[2]);
  const glm::dvec3 high(cluster.high_ws[0], cluster.high_ws[1], cluster.high_ws[2]);
  return {0.5 * (low + high), 0.5 * (high - low)};
}

std::vector<ClusterBox> find_seen_boxes(const View& camera, const frame::Frame& frame) {
  const std::array<Side, 4> sides = sides_of(camera);
  std::vector<ClusterBox> seen;
  for (const Cluster& c : frame.clusters) {
    if ((c.flags & kVisible) == 0) continue;
    const ClusterBox box = box_of(c);
    const glm::dvec3 middle = box.middle - camera.pose.position_ws;
    const auto is_within = [&](const Side& side) {
      return glm::dot(side.normal, middle) + glm::dot(glm::abs(side.normal), box.reach) >= side.offset;
    };
    if (std::all_of(sides.begin(), sides.end(), is_within)) seen.push_back(box);
  }
  return seen;
}

Range find_depth_range(const View& camera, const frame::Frame& frame) {
  const glm::dvec3 forward = camera.pose.forward_ws();
  const Projection& p = camera.projection;
  Range seen;
  for (const ClusterBox& box : find_seen_boxes(camera, frame)) {
    seen.include(glm::dot(forward, box.middle - camera.pose.position_ws),
                 glm::dot(glm::abs(forward), box.reach));
  }
  Range range = {std::max(seen.low, p.near), std::min(seen.high, p.far)};
  if (!(range.low < range.high)) return {p.near, p.near + 1};
  if (!p.is_orthographic) {
    range.low = std::max(p.near, power_of_two_below(range.low));
    range.high = std::min(p.far, power_of_two_above(range.high));
  }
  return range;
}

}  // namespace laterna::light
