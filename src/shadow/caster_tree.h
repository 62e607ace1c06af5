// The frame's shadow casters as exact shadows read them: triangles in packets of 16, and boxes around packets and around
// boxes, 16 to a node, so that a whole vector of them is held against a shaft of light at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/aligned_vector.h"
#include "frame/frame.h"

namespace laterna::shadow {

inline constexpr std::size_t kTreeWidth = 16;

/// Neighbouring triangles. Lanes beyond the last repeat it.
struct alignas(kCacheLine) CasterPacket {
  /// Of corners a, b and c: x, y and z in world space.
  float corner[3][3][kTreeWidth];
  TriangleId id[kTreeWidth];
  std::uint32_t count;
};

/// Boxes around what hangs below. Unused ones are empty: their low is above their high, and no shaft meets them.
struct alignas(kCacheLine) CasterNode {
  float low[3][kTreeWidth], high[3][kTreeWidth];
  /// Index of a node, or of a packet where kIsPacket is set.
  std::uint32_t child[kTreeWidth];
};
inline constexpr std::uint32_t kIsPacket = 0x80000000U;

/// A list of nodes to visit need not be longer: 15 for each level of the tree, which has at most 87.
inline constexpr std::size_t kMostNodesAhead = 2048;

class CasterTree {
 public:
  /// Of the clusters that cast shadows: those that are not blended, or those that are.
  enum class Casters : std::uint8_t { opaque, blended };
  /// Of those, the clusters whose flags, where `mask` has bits, are `flags`.
  CasterTree(const frame::Frame& frame, Casters casters, std::uint32_t mask = 0, std::uint32_t flags = 0);

  [[nodiscard]] bool is_empty() const { return packets_.empty(); }
  /// The first is the root.
  [[nodiscard]] const CasterNode* nodes() const { return nodes_.data(); }
  [[nodiscard]] const CasterPacket* packets() const { return packets_.data(); }
  [[nodiscard]] std::size_t packet_count() const { return packets_.size(); }
  [[nodiscard]] std::size_t memory_bytes() const {
    return nodes_.size() * sizeof(CasterNode) + packets_.size() * sizeof(CasterPacket);
  }
  /// Largest absolute coordinate of any corner.
  [[nodiscard]] float extent() const { return extent_; }

 private:
  class Builder;
  AlignedVector<CasterNode> nodes_;
  AlignedVector<CasterPacket> packets_;
  float extent_ = 0;
};

}  // namespace laterna::shadow
