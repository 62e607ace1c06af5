// The samples of a tile, sorted by surface: a batch that is shaded together uses the same textures.
#pragma once

#include <array>
#include <vector>

#include "frame/frame.h"
#include "raster/triangle_bins.h"

namespace laterna::shade {

class SurfaceGroups {
 public:
  explicit SurfaceGroups(const frame::Frame& frame) : frame_(frame) {}

  /// A 4 × 4 block and those of its samples that lie on the group's surface.
  struct Block {
    std::uint16_t block, mask;
  };
  struct Group {
    std::uint32_t surface = 0;
    std::vector<Block> blocks;
  };

  void collect(const std::array<TriangleId, raster::kTilePixels>& ids);
  [[nodiscard]] std::span<const Group> groups() const { return {groups_.data(), used_}; }

 private:
  Group& group_of(std::uint32_t surface);
  void add_mixed_block(std::uint16_t block, const TriangleId* ids);

  const frame::Frame& frame_;
  std::vector<Group> groups_;  // kept for their memory
  std::size_t used_ = 0;
};

}  // namespace laterna::shade
