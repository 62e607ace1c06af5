#include "bake/bright_luxels.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "base/elementary.h"

namespace laterna::bake {
namespace {

// What shines more than this times the mean is bright.
constexpr double kEven = 2;
// Luxels nearer than so many of their widths are.
constexpr float kNear = 3;
// Luxels are taken as one where they are seen under an angle whose sine is no more, and face nearly the same way: so
// long is the mean of their normals.
constexpr float kLargestSine = 0.1F;
constexpr float kLeastAgreement = 0.97F;
// Whether they are seen is asked by so many rays where they bring as much as a sky of what is hardly not bright would, and by
// fewer where they bring less: penumbrae of lamps are smooth, and of a thousand faint luxels each needs one.
constexpr float kRaysForEven = 16;
constexpr float kMostRays = 64;
// Boxes that are summed one by one, those that bring most first: where much is bright there would be thousands. What remains
// is sampled.
constexpr float kMostBoxes = 128;
constexpr float kSampleRays = 64;

float strongest(const glm::vec3& light) { return std::max(light.x, std::max(light.y, light.z)); }

// From a point to a disc of that area.
float form_factor(float area, float cosine_at_receiver, float cosine_at_emitter, float squared_distance) {
  const float both = std::max(0.0F, cosine_at_receiver) * std::max(0.0F, cosine_at_emitter);
  return area * both / (static_cast<float>(kPi) * squared_distance + area);
}

// Whether nothing of a box is above the plane through `point`.
bool is_below(const glm::vec3& low, const glm::vec3& high, const glm::vec3& point, const glm::vec3& normal) {
  const glm::vec3 farthest = glm::mix(low, high, glm::vec3(glm::greaterThan(normal, glm::vec3(0))));
  return glm::dot(farthest - point, normal) <= 0;
}

}  // namespace

struct BrightLuxels::Sum {
  std::uint32_t receiver;
  float effort;
  const LuxelRays& rays;
  LuxelRays::Scratch& scratch;
  Brought brought;

  void add(const glm::vec3& irradiance, float distance) {
    brought.irradiance += irradiance;
    brought.per_distance += sum_of(irradiance) / distance;
  }
};

BrightLuxels::BrightLuxels(const LuxelTree& tree, std::span<const glm::vec3> exitance)
    : tree_(tree), exitance_(exitance), shine_(tree.nodes().size()) {
  double area = 0;
  double flux = 0;
  for (std::size_t place = 0; place < exitance.size(); ++place) {
    const double own = tree.luxels()[place].area;
    area += own;
    flux += own * static_cast<double>(strongest(exitance[place]));
  }
  if (!(flux > 0)) return;
  most_even_ = static_cast<float>(kEven * flux / area);
  for (auto node = static_cast<std::uint32_t>(shine_.size()); node-- > 0;) shine_[node] = shine_below(node);
  flux_before_.reserve(exitance.size() + 1);
  flux_before_.push_back(0);
  for (std::uint32_t place = 0; place < exitance.size(); ++place)
    flux_before_.push_back(flux_before_.back() + static_cast<double>(shine_of(place).strength));
}

bool BrightLuxels::is_bright(std::uint32_t place) const { return strongest(exitance_[place]) > most_even_; }

bool BrightLuxels::is_near(std::uint32_t receiver, std::uint32_t place) const {
  const Luxel& luxel = tree_.luxels()[place];
  const glm::vec3 way = luxel.position_ws - tree_.luxels()[receiver].position_ws;
  return glm::dot(way, way) < kNear * kNear * luxel.area;
}

void BrightLuxels::Shine::add(const Shine& other) {
  if (other.strength == 0) return;
  if (strength == 0) {
    *this = other;
    return;
  }
  flux += other.flux;
  strength += other.strength;
  const float part = other.strength / strength;
  centre = glm::mix(centre, other.centre, part);
  axis = glm::mix(axis, other.axis, part);
  low_ws = glm::min(low_ws, other.low_ws);
  high_ws = glm::max(high_ws, other.high_ws);
  area += other.area;
  largest = std::max(largest, other.largest);
}

// The box holds the luxels' centres; half a square's diagonal is added.
void BrightLuxels::Shine::find_radius() {
  radius = glm::length(glm::max(centre - low_ws, high_ws - centre)) + std::sqrt(0.5F * largest);
}

BrightLuxels::Shine BrightLuxels::shine_of(std::uint32_t place) const {
  if (!is_bright(place)) return {};
  const Luxel& luxel = tree_.luxels()[place];
  const glm::vec3 flux = exitance_[place] * luxel.area;
  return {flux,         luxel.position_ws, luxel.normal_ws, luxel.position_ws, luxel.position_ws,
          sum_of(flux), luxel.area,        luxel.area};
}

// Children have been done before.
BrightLuxels::Shine BrightLuxels::shine_below(std::uint32_t node) const {
  const LuxelNode& box = tree_.nodes()[node];
  Shine all;
  if (box.is_leaf()) {
    for (std::uint32_t place = box.first; place < box.last; ++place) all.add(shine_of(place));
  } else {
    all.add(shine_[node + 1]);
    all.add(shine_[box.second]);
  }
  all.find_radius();
  return all;
}

bool BrightLuxels::can_be_one(const Sum& sum, std::uint32_t node) const {
  const Shine& shine = shine_[node];
  if (glm::length(shine.axis) < kLeastAgreement) return false;
  const glm::vec3 way = shine.centre - tree_.luxels()[sum.receiver].position_ws;
  return shine.radius * shine.radius <= kLargestSine * kLargestSine * glm::dot(way, way);
}

// One of a node's luxels, by what they give: for equally spread numbers each as often as it gives light. A search without
// branches: as many picks are made as rays are sent, and to go down the tree took as long as a ray.
std::uint32_t BrightLuxels::pick(std::uint32_t node, double number) const {
  const LuxelNode& box = tree_.nodes()[node];
  const double wanted = flux_before_[box.first] + number * (flux_before_[box.last] - flux_before_[box.first]);
  std::uint32_t place = box.first;
  for (std::uint32_t count = box.last - box.first; count > 1;) {
    const std::uint32_t half = count / 2;
    place = flux_before_[place + half] <= wanted ? place + half : place;
    count -= half;
  }
  // By rounding it may be one that follows the last that is bright.
  while (place > box.first && flux_before_[place + 1] == flux_before_[place]) --place;
  return place;
}

// `seen`: the place of one of the luxels, for a number in [0, 1).
template <class Seen>
void BrightLuxels::add(Sum& sum, const Shine& shine, Seen seen) const {
  const Luxel& receiver = tree_.luxels()[sum.receiver];
  const glm::vec3 way = shine.centre - receiver.position_ws;
  const float squared = glm::dot(way, way);
  const float distance = std::sqrt(squared);
  const glm::vec3 direction = way / distance;
  const float factor = form_factor(shine.area, glm::dot(receiver.normal_ws, direction),
                                   -glm::dot(shine.axis, direction), squared);
  if (factor == 0) return;
  const glm::vec3 unshadowed = shine.flux * (factor / shine.area);
  const float wanted = std::ceil(strongest(unshadowed) / most_even_ * kRaysForEven * sum.effort);
  const int rays = static_cast<int>(std::clamp(wanted, 1.0F, std::max(1.0F, kMostRays * sum.effort)));
  glm::vec3 arrived(0);
  for (int ray = 0; ray < rays; ++ray) {
    const std::uint32_t place = seen((ray + shift_of(sum.receiver).u) / rays);
    arrived += sum.rays.transmittance(sum.receiver, place, sum.scratch);
  }
  sum.add(unshadowed * (arrived / static_cast<float>(rays)), distance);
}

// Of each box some luxels, each with the form factor of its own; the more, the more it may bring.
void BrightLuxels::add_samples(Sum& sum, std::span<const std::pair<float, std::uint32_t>> boxes) const {
  float all = 0;
  for (const auto& [bound, node] : boxes) all += bound;
  for (const auto& [bound, node] : boxes)
    add_sample(sum, node, static_cast<int>(std::ceil(kSampleRays * sum.effort * bound / all)));
}

void BrightLuxels::add_sample(Sum& sum, std::uint32_t node, int rays) const {
  const Luxel& receiver = tree_.luxels()[sum.receiver];
  const Shine& shine = shine_[node];
  const float part = shine.strength / static_cast<float>(rays);
  for (int ray = 0; ray < rays; ++ray) {
    const std::uint32_t place = pick(node, (ray + shift_of(sum.receiver).u) / rays);
    if (is_near(sum.receiver, place)) continue;
    const Luxel& luxel = tree_.luxels()[place];
    const glm::vec3 way = luxel.position_ws - receiver.position_ws;
    const float squared = glm::dot(way, way);
    const float distance = std::sqrt(squared);
    const glm::vec3 direction = way / distance;
    const float factor = form_factor(luxel.area, glm::dot(receiver.normal_ws, direction),
                                     -glm::dot(luxel.normal_ws, direction), squared);
    if (factor == 0) continue;
    const glm::vec3 unshadowed = exitance_[place] * (part * factor / (sum_of(exitance_[place]) * luxel.area));
    sum.add(unshadowed * sum.rays.transmittance(sum.receiver, place, sum.scratch), distance);
  }
}

float BrightLuxels::bound_at(std::uint32_t receiver, std::uint32_t node) const {
  const LuxelNode& box = tree_.nodes()[node];
  const glm::vec3& point = tree_.luxels()[receiver].position_ws;
  const glm::vec3 outside = glm::max(glm::max(box.low_ws - point, point - box.high_ws), glm::vec3(0));
  const Shine& shine = shine_[node];
  return shine.strength / (static_cast<float>(kPi) * glm::dot(outside, outside) + shine.largest);
}

BrightLuxels::Brought BrightLuxels::brought_to(std::uint32_t receiver, float effort, const LuxelRays& rays,
                                               LuxelRays::Scratch& scratch) const {
  Sum sum = {receiver, effort, rays, scratch, {}};
  if (most_even_ == 0) return sum.brought;
  const Luxel& luxel = tree_.luxels()[receiver];
  auto& open = scratch.boxes;
  open.clear();
  const auto push = [&](std::uint32_t node) {
    const Shine& shine = shine_[node];
    if (shine.strength == 0 || is_below(shine.low_ws, shine.high_ws, luxel.position_ws, luxel.normal_ws))
      return;
    open.emplace_back(bound_at(receiver, node), node);
    std::ranges::push_heap(open);
  };
  push(0);
  const auto most_boxes = static_cast<std::size_t>(std::ceil(kMostBoxes * effort));
  for (std::size_t taken = 0; !open.empty();) {
    std::ranges::pop_heap(open);
    const std::uint32_t index = open.back().second;
    open.pop_back();
    const LuxelNode& node = tree_.nodes()[index];
    if (can_be_one(sum, index)) {
      add(sum, shine_[index], [&](double number) { return pick(index, number); });
      ++taken;
    } else if (node.is_leaf()) {
      for (std::uint32_t place = node.first; place < node.last; ++place) {
        if (!is_bright(place) || is_near(receiver, place)) continue;
        add(sum, shine_of(place), [&](double) { return place; });
        ++taken;
      }
    } else if (taken + open.size() >= most_boxes) {
      open.emplace_back(bound_at(receiver, index), index);
      break;
    } else {
      push(index + 1);
      push(node.second);
    }
  }
  add_samples(sum, open);
  return sum.brought;
}

}  // namespace laterna::bake
