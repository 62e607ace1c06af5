#include "shadow/nearest_pyramid.h"

#include <algorithm>

namespace laterna::shadow {
namespace {

// One tile's blocks, which lie one after the other.
void reduce_blocks(const float* tile, float* cells, int stride) {
  for (int block = 0; block < raster::kBlocksPerSide * raster::kBlocksPerSide; ++block) {
    const float* texels = tile + static_cast<std::ptrdiff_t>(block) * raster::kBlockPixels;
    float nearest = texels[0];
    for (int i = 1; i < raster::kBlockPixels; ++i) nearest = std::max(nearest, texels[i]);
    cells[(block / raster::kBlocksPerSide) * stride + block % raster::kBlocksPerSide] = nearest;
  }
}

}  // namespace

NearestPyramid::NearestPyramid(const DepthMap& map, const TaskPool& pool) {
  static_assert(raster::kBlockSide == 1 << kFirstLevel);
  Level first;
  first.width = map.tiles_x() * raster::kBlocksPerSide;
  first.height = map.tiles_y() * raster::kBlocksPerSide;
  first.cells.resize(static_cast<std::size_t>(first.width) * static_cast<std::size_t>(first.height));
  pool.for_each(map.tile_count(), [&](std::size_t i, int) {
    const std::size_t tile_x = i % static_cast<std::size_t>(map.tiles_x());
    const std::size_t tile_y = i / static_cast<std::size_t>(map.tiles_x());
    float* cells = first.cells.data() + (tile_y * static_cast<std::size_t>(first.width) + tile_x) *
                                            static_cast<std::size_t>(raster::kBlocksPerSide);
    reduce_blocks(map.texels() + i * raster::kTilePixels, cells, first.width);
  });
  levels_.push_back(std::move(first));
  while (levels_.back().cells.size() > 1) {
    const Level& finer = levels_.back();
    Level coarser;
    coarser.width = (finer.width + 1) / 2;
    coarser.height = (finer.height + 1) / 2;
    for (int y = 0; y < coarser.height; ++y) {
      const float* rows[2] = {
          finer.cells.data() + static_cast<std::ptrdiff_t>(2 * y) * finer.width,
          finer.cells.data() +
              static_cast<std::ptrdiff_t>(std::min(2 * y + 1, finer.height - 1)) * finer.width};
      for (int x = 0; x < coarser.width; ++x) {
        const int left = 2 * x;
        const int right = std::min(2 * x + 1, finer.width - 1);
        coarser.cells.push_back(std::max({rows[0][left], rows[0][right], rows[1][left], rows[1][right]}));
      }
    }
    levels_.push_back(std::move(coarser));
  }
}

float NearestPyramid::nearest_about(float x, float y, float reach) const {
  // The finest level at which the square touches no more than 2 × 2 cells.
  std::size_t level = 0;
  auto cell = static_cast<float>(1 << kFirstLevel);
  while (level + 1 < levels_.size() && 2 * reach > cell) {
    ++level;
    cell *= 2;
  }
  const Level& cells = levels_[level];
  const auto index = [cell](float texel, int count) {
    const auto last = static_cast<float>(count - 1);
    const float held = texel > 0 ? std::min(texel / cell, last) : 0.0F;
    return static_cast<int>(held);
  };
  const int left = index(x - reach, cells.width);
  const int right = index(x + reach, cells.width);
  const float* top =
      cells.cells.data() + static_cast<std::ptrdiff_t>(index(y - reach, cells.height)) * cells.width;
  const float* bottom =
      cells.cells.data() + static_cast<std::ptrdiff_t>(index(y + reach, cells.height)) * cells.width;
  return std::max({top[left], top[right], bottom[left], bottom[right]});
}

std::size_t NearestPyramid::memory_bytes() const {
  std::size_t bytes = 0;
  for (const Level& level : levels_) bytes += level.cells.capacity() * sizeof(float);
  return bytes;
}

NearestPyramids::NearestPyramids(std::span<const std::shared_ptr<DepthMap>> maps, const TaskPool& pool) {
  for (const auto& map : maps) of_map.emplace_back(*map, pool);
}

std::size_t NearestPyramids::memory_bytes() const {
  std::size_t bytes = 0;
  for (const NearestPyramid& pyramid : of_map) bytes += pyramid.memory_bytes();
  return bytes;
}

}  // namespace laterna::shadow
