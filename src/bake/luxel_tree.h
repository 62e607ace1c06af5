// Luxels in order of where they lie and where they face: boxes within boxes, for finding what a ray has met and for
// treating many luxels as one.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "bake/luxel.h"
#include "frame/frame.h"

namespace laterna::bake {

/// Luxels [first, last) of the tree's order. Its first child follows it, the second is `second`; a leaf has none.
struct LuxelNode {
  glm::vec3 low_ws, high_ws;  ///< of the positions
  std::uint32_t first = 0, last = 0;
  std::uint32_t second = 0;
  float largest_area = 0;                   ///< of the luxels
  glm::vec3 low_normal{0}, high_normal{0};  ///< of their normals, coordinate by coordinate
  [[nodiscard]] bool is_leaf() const { return second == 0; }
};

/// A point on a surface that a ray may meet, and the triangle's unit normal on the side from which it comes.
struct MetSurface {
  glm::vec3 position_ws, normal_ws;
  std::uint32_t object = 0;
};

class LuxelTree {
 public:
  static constexpr std::uint32_t kLeafSize = 8;

  /// The luxels have been checked; fewer than 2³¹. The frame must outlive the tree.
  LuxelTree(const frame::Frame& frame, std::span<const Luxel> luxels);

  /// The luxels in the tree's order. Places in it are how the rest of the room names luxels.
  [[nodiscard]] std::span<const Luxel> luxels() const { return luxels_; }
  /// Which of the given luxels stands at a place.
  [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }
  /// Parents before their children; the first is the root.
  [[nodiscard]] std::span<const LuxelNode> nodes() const { return nodes_; }

  /// Mean area of an object's luxels; 0 where it has none.
  [[nodiscard]] float mean_area(std::uint32_t object) const { return mean_areas_[object]; }
  /// The place of the luxel that stands for a point: the nearest of the same object that faces the same way, no farther off
  /// than a few of its own widths. Distances off the surface count four times, so that of two parallel sheets the right one
  /// is found.
  [[nodiscard]] std::optional<std::uint32_t> find(const MetSurface& met) const;
  /// What is least of the luxel that find() finds.
  [[nodiscard]] float squared_distance(const MetSurface& met, std::uint32_t place) const;

 private:
  void split(std::uint32_t first, std::uint32_t last);
  [[nodiscard]] std::uint32_t object_at(std::uint32_t place) const {
    return frame_.clusters[cluster_of(luxels_[place].triangle)].object;
  }

  const frame::Frame& frame_;
  std::vector<Luxel> luxels_;
  std::vector<std::uint32_t> order_;
  std::vector<LuxelNode> nodes_;
  std::vector<float> mean_areas_;  // by object
};

}  // namespace laterna::bake
