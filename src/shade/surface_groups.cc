#include "shade/surface_groups.h"

namespace laterna::shade {

void SurfaceGroups::collect(const std::array<TriangleId, raster::kTilePixels>& ids) {
  used_ = 0;
  for (std::size_t block = 0; block < raster::kTilePixels / raster::kBlockPixels; ++block) {
    const TriangleId* of_block = ids.data() + block * raster::kBlockPixels;
    TriangleId difference = 0;
    for (std::size_t i = 1; i < raster::kBlockPixels; ++i) difference |= of_block[i] ^ of_block[0];
    const auto index = static_cast<std::uint16_t>(block);
    if (cluster_of(difference) != 0) {
      add_mixed_block(index, of_block);
    } else if (of_block[0] != kNoTriangle) {
      group_of(frame_.clusters[cluster_of(of_block[0])].material).blocks.push_back({index, 0xFFFFU});
    }
  }
}

void SurfaceGroups::add_mixed_block(std::uint16_t block, const TriangleId* ids) {
  std::uint32_t left = 0;
  std::array<std::uint32_t, raster::kBlockPixels> surface{};
  for (std::uint32_t i = 0; i < raster::kBlockPixels; ++i) {
    if (ids[i] == kNoTriangle) continue;
    left |= 1U << i;
    surface[i] = frame_.clusters[cluster_of(ids[i])].material;
  }
  while (left != 0) {
    const std::uint32_t wanted = surface[static_cast<std::size_t>(__builtin_ctz(left))];
    std::uint32_t mask = 0;
    for (std::uint32_t i = 0; i < raster::kBlockPixels; ++i)
      mask |= static_cast<std::uint32_t>(surface[i] == wanted) << i;
    mask &= left;
    group_of(wanted).blocks.push_back({block, static_cast<std::uint16_t>(mask)});
    left &= ~mask;
  }
}

SurfaceGroups::Group& SurfaceGroups::group_of(std::uint32_t surface) {
  for (std::size_t i = 0; i < used_; ++i) {
    if (groups_[i].surface == surface) return groups_[i];
  }
  if (used_ == groups_.size()) groups_.emplace_back();
  Group& group = groups_[used_++];
  group.surface = surface;
  group.blocks.clear();
  return group;
}

}  // namespace laterna::shade
