#include "bake/light_sharing.h"

namespace laterna::bake {
namespace {

// Of the harmonic mean distance.
constexpr float kShare = 0.15F;
// The same for what is no farther off than two luxels: finer than that reflected light is not looked for where luxels are large. A
// wall at a distance x has a mean distance of 4.7 x at least, so that of two luxels on either side of it neither reaches
// the other before 2 / (4.7 · 0.3) = 1.4 times that.
constexpr float kShareBeside = 0.3F, kBeside = 2;
// In luxels: what is shared farther makes nothing smoother that can be seen, and shadows of small things in reflected light
// are as fine.
constexpr float kMostWidths = 5;
// Of √(1 − n · n'), at which a luxel says nothing of another: normals 20° apart.
constexpr float kMostTurn = 0.25F;

float reach_of(float nearness, float width) {
  const float reach = std::max(kShare / nearness, std::min(kShareBeside / nearness, kBeside * width));
  return std::min(reach, kMostWidths * width);
}

}  // namespace

LightSharing::LightSharing(const LuxelTree& tree, std::span<const float> nearness)
    : tree_(tree), reach_(nearness.size()) {
  for (const LuxelNode& node : tree.nodes()) {
    if (!node.is_leaf()) continue;
    // A few rays know the distance badly. The leaf's luxels lie side by side; what is nearer to one of them counts there.
    float mean = 0;
    for (std::uint32_t place = node.first; place < node.last; ++place) mean += nearness[place];
    mean /= static_cast<float>(node.last - node.first);
    // Of one that lies wholly on its surface: those at rims stand for less.
    const float width = std::sqrt(node.largest_area);
    for (std::uint32_t place = node.first; place < node.last; ++place)
      reach_[place] = reach_of(std::max(mean, nearness[place]), width);
  }
}

bool LightSharing::may_share(const LuxelNode& node, const Luxel& luxel, float reach) {
  const glm::vec3 outside =
      glm::max(glm::max(node.low_ws - luxel.position_ws, luxel.position_ws - node.high_ws), glm::vec3(0));
  if (!(glm::dot(outside, outside) < reach * reach)) return false;
  const glm::vec3 closest = glm::max(luxel.normal_ws * node.low_normal, luxel.normal_ws * node.high_normal);
  return closest.x + closest.y + closest.z > 1 - kMostTurn * kMostTurn;
}

float LightSharing::weight_of(const Luxel& luxel, float reach, std::uint32_t other) const {
  const Luxel& there = tree_.luxels()[other];
  const float least = std::min(reach, reach_[other]);
  const float distance = glm::length(there.position_ws - luxel.position_ws);
  if (!(distance < least)) return 0;
  const float turn = std::sqrt(std::max(0.0F, 1 - glm::dot(luxel.normal_ws, there.normal_ws)));
  const float apart = distance / least + turn / kMostTurn;
  return apart < 1 ? 1 - apart * apart : 0;
}

}  // namespace laterna::bake
