#include "bake/luxel_tree.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

namespace laterna::bake {
namespace {

// A luxel speaks for points up to so many of its widths away: triangles thinner than a luxel have none of their own.
constexpr float kReach = 4;
// Cosine between a luxel's normal, which may be a smooth one, and that of a triangle that it may stand for.
constexpr float kLeastAgreement = 0.2F;
// Added to 1, the square of what a distance off the surface counts.
constexpr float kOffSurface = 15;

struct Extent {
  glm::vec3 low{std::numeric_limits<float>::infinity()};
  glm::vec3 high{-std::numeric_limits<float>::infinity()};

  void add(const glm::vec3& v) {
    low = glm::min(low, v);
    high = glm::max(high, v);
  }
};

// The end of a box that is farthest along a direction.
glm::vec3 farthest_along(const glm::vec3& direction, const glm::vec3& low, const glm::vec3& high) {
  return glm::mix(low, high, glm::greaterThan(direction, glm::vec3(0)));
}

// No luxel of the box has less of LuxelTree::squared_distance().
float least_squared_distance(const LuxelNode& node, const MetSurface& met) {
  const glm::vec3 outside =
      glm::max(glm::max(node.low_ws - met.position_ws, met.position_ws - node.high_ws), glm::vec3(0));
  const glm::vec3& n = met.normal_ws;
  const float above = glm::dot(farthest_along(-n, node.low_ws, node.high_ws) - met.position_ws, n);
  const float below = -glm::dot(farthest_along(n, node.low_ws, node.high_ws) - met.position_ws, n);
  const float off_surface = std::max(0.0F, std::max(above, below));
  // Short of it by more than roundings.
  return 0.9999F * (glm::dot(outside, outside) + kOffSurface * off_surface * off_surface);
}

// Whether one of its luxels may face as a surface does.
bool may_agree(const LuxelNode& node, const MetSurface& met) {
  return glm::dot(farthest_along(met.normal_ws, node.low_normal, node.high_normal), met.normal_ws) >=
         0.9999F * kLeastAgreement;
}

// Of six axes, three of position and three of normal, the one along which luxels differ most. Normals count half the box's
// diagonal: facing away weighs as much as lying at the box's other end.
int longest_axis(const Extent& positions, const Extent& normals) {
  const glm::vec3 size = positions.high - positions.low;
  const glm::vec3 turn = (normals.high - normals.low) * (0.5F * glm::length(size));
  const std::array<float, 6> extents = {size.x, size.y, size.z, turn.x, turn.y, turn.z};
  return static_cast<int>(std::max_element(extents.begin(), extents.end()) - extents.begin());
}

float coordinate(const Luxel& luxel, int axis) {
  return axis < 3 ? luxel.position_ws[axis] : luxel.normal_ws[axis - 3];
}

}  // namespace

LuxelTree::LuxelTree(const frame::Frame& frame, std::span<const Luxel> luxels)
    : frame_(frame), luxels_(luxels.begin(), luxels.end()), order_(luxels.size()) {
  for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<std::uint32_t>(i);
  nodes_.reserve(4 * luxels.size() / kLeafSize + 1);
  if (!luxels.empty()) split(0, static_cast<std::uint32_t>(luxels.size()));
  for (std::size_t place = 0; place < order_.size(); ++place) luxels_[place] = luxels[order_[place]];

  std::vector<double> areas(frame.object_names.size());
  std::vector<std::size_t> counts(areas.size());
  for (std::uint32_t place = 0; place < luxels_.size(); ++place) {
    const std::uint32_t object = object_at(place);
    areas[object] += static_cast<double>(luxels_[place].area);
    ++counts[object];
  }
  mean_areas_.resize(areas.size());
  for (std::size_t object = 0; object < areas.size(); ++object) {
    if (counts[object] > 0)
      mean_areas_[object] = static_cast<float>(areas[object] / static_cast<double>(counts[object]));
  }
}

// Luxels keep their places until all are ordered; `order_` alone is sorted.
void LuxelTree::split(std::uint32_t first, std::uint32_t last) {
  const std::size_t index = nodes_.size();
  Extent positions;
  Extent normals;
  float largest = 0;
  for (std::uint32_t i = first; i < last; ++i) {
    positions.add(luxels_[order_[i]].position_ws);
    normals.add(luxels_[order_[i]].normal_ws);
    largest = std::max(largest, luxels_[order_[i]].area);
  }
  nodes_.push_back({positions.low, positions.high, first, last, 0, largest, normals.low, normals.high});
  if (last - first <= kLeafSize) return;
  const int axis = longest_axis(positions, normals);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                   [&](std::uint32_t a, std::uint32_t b) {
                     const float at_a = coordinate(luxels_[a], axis);
                     const float at_b = coordinate(luxels_[b], axis);
                     return at_a != at_b ? at_a < at_b : a < b;
                   });
  split(first, middle);
  nodes_[index].second = static_cast<std::uint32_t>(nodes_.size());
  split(middle, last);
}

float LuxelTree::squared_distance(const MetSurface& met, std::uint32_t place) const {
  const glm::vec3 offset = luxels_[place].position_ws - met.position_ws;
  const float off_surface = glm::dot(offset, met.normal_ws);
  return glm::dot(offset, offset) + kOffSurface * off_surface * off_surface;
}

std::optional<std::uint32_t> LuxelTree::find(const MetSurface& met) const {
  const float mean_area = mean_areas_[met.object];
  if (!(mean_area > 0)) return std::nullopt;
  float nearest = std::numeric_limits<float>::infinity();
  std::optional<std::uint32_t> found;
  const auto look_into = [&](const LuxelNode& leaf) {
    for (std::uint32_t place = leaf.first; place < leaf.last; ++place) {
      const Luxel& luxel = luxels_[place];
      if (glm::dot(luxel.normal_ws, met.normal_ws) < kLeastAgreement) continue;
      const float distance = squared_distance(met, place);
      if (distance >= nearest || distance > kReach * kReach * std::max(mean_area, luxel.area)) continue;
      if (object_at(place) != met.object) continue;
      nearest = distance;
      found = place;
    }
  };
  struct Open {
    std::uint32_t node;
    float distance;
  };
  std::array<Open, 64> open;  // a balanced tree of 2³¹ luxels is 29 deep
  std::size_t count = 0;
  open[count++] = {0, least_squared_distance(nodes_[0], met)};
  while (count > 0) {
    const auto [index, distance] = open[--count];
    const LuxelNode& node = nodes_[index];
    // A single large luxel far off must not make all others be looked at.
    if (distance >= nearest || distance > kReach * kReach * std::max(mean_area, node.largest_area) ||
        !may_agree(node, met))
      continue;
    if (node.is_leaf()) {
      look_into(node);
      continue;
    }
    const Open one = {index + 1, least_squared_distance(nodes_[index + 1], met)};
    const Open other = {node.second, least_squared_distance(nodes_[node.second], met)};
    const bool one_is_nearer = one.distance <= other.distance;
    open[count++] = one_is_nearer ? other : one;
    open[count++] = one_is_nearer ? one : other;
  }
  return found;
}

}  // namespace laterna::bake
