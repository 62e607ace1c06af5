// Luxels that see much the same share what their rays have found.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "bake/luxel_tree.h"

namespace laterna::bake {

/// How far what falls on one luxel says something of what falls on others: reflected light changes little within a part of the
/// harmonic mean distance of all that a luxel sees, and while normals turn little (Ward, Rubinstein and Clear, A ray tracing
/// solution for diffuse interreflection, 1988). Two luxels share where each is within reach of the other: so those on both sides
/// of a wall, which is near to both, never do.
class LightSharing {
 public:
  /// `nearness`: by place, the mean over all directions, weighted by their cosine, of 1 / distance of what is seen there, 1 / m.
  /// The tree must outlive this.
  LightSharing(const LuxelTree& tree, std::span<const float> nearness);

  /// Calls use(place of another luxel, weight in (0, 1]) for those that share with the luxel at `place`: all, or so many that no
  /// more are needed where many sheets lie in one place.
  template <class Use>
  void for_others(std::uint32_t place, Use use) const {
    const Luxel& luxel = tree_.luxels()[place];
    const float reach = reach_[place];
    std::array<std::uint32_t, 64> open;  // a balanced tree of 2³¹ luxels is 29 deep
    std::size_t count = 0;
    int left = kMostOthers;
    open[count++] = 0;
    while (count > 0 && left > 0) {
      const std::uint32_t index = open[--count];
      const LuxelNode& node = tree_.nodes()[index];
      if (!may_share(node, luxel, reach)) continue;
      if (!node.is_leaf()) {
        open[count++] = node.second;
        open[count++] = index + 1;
        continue;
      }
      for (std::uint32_t other = node.first; other < node.last; ++other) {
        const float weight = other == place ? 0 : weight_of(luxel, reach, other);
        if (weight == 0) continue;
        use(other, weight);
        --left;
      }
    }
  }

 private:
  // Three times as many as lie within reach on one surface.
  static constexpr int kMostOthers = 256;

  static bool may_share(const LuxelNode& node, const Luxel& luxel, float reach);
  // Falls from 1 to 0 at the end of reach (Epanechnikov's kernel).
  [[nodiscard]] float weight_of(const Luxel& luxel, float reach, std::uint32_t other) const;

  const LuxelTree& tree_;
  std::vector<float> reach_;  // by place, metres
};

}  // namespace laterna::bake
