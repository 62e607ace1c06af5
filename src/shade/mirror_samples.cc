#include "shade/mirror_samples.h"

#include <algorithm>
#include <cmath>

namespace laterna::shade {

bool are_alike(const TileResult& tile, std::size_t pixel) {
  const float r = tile.beauty.r[pixel], g = tile.beauty.g[pixel], b = tile.beauty.b[pixel];
  const float most = kAlikeSamples * std::max({std::abs(r), std::abs(g), std::abs(b)});
  for (const TileColor& sample : tile.samples) {
    const bool is_near = std::abs(sample.r[pixel] - r) <= most && std::abs(sample.g[pixel] - g) <= most &&
                         std::abs(sample.b[pixel] - b) <= most;
    if (!is_near) return false;  // nor is what is no number
  }
  return true;
}

MirrorSamples::MirrorSamples(const light::PixelBox& box, int samples)
    : box_(box),
      samples_(static_cast<std::size_t>(samples)),
      left_(box.x_begin / raster::kTileSide),
      top_(box.y_begin / raster::kTileSide),
      tiles_x_(raster::tiles_across(box.x_end) - left_) {
  tiles_.resize(static_cast<std::size_t>(tiles_x_) *
                static_cast<std::size_t>(raster::tiles_across(box.y_end) - top_));
}

std::size_t MirrorSamples::tile_number(int tile_x, int tile_y) const {
  return static_cast<std::size_t>(tile_y - top_) * static_cast<std::size_t>(tiles_x_) +
         static_cast<std::size_t>(tile_x - left_);
}

void MirrorSamples::write(int tile_x, int tile_y, const TileResult& tile) {
  constexpr int kSide = raster::kTileSide;
  const int x_begin = std::max(box_.x_begin - tile_x * kSide, 0),
            x_end = std::min(box_.x_end - tile_x * kSide, kSide);
  const int y_begin = std::max(box_.y_begin - tile_y * kSide, 0),
            y_end = std::min(box_.y_end - tile_y * kSide, kSide);
  std::vector<std::uint16_t> kept;  // pixels of the tile
  for (int y = y_begin; y < y_end; ++y) {
    for (int x = x_begin; x < x_end; ++x) {
      const int pixel = raster::index_in_tile(x, y);
      if (!are_alike(tile, static_cast<std::size_t>(pixel)))
        kept.push_back(static_cast<std::uint16_t>(pixel));
    }
  }
  Tile& to = tiles_[tile_number(tile_x, tile_y)];
  to = {};
  if (kept.empty()) return;
  to.places.assign(raster::kTilePixels, kNone);
  to.radiance.reserve(kept.size() * samples_);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const std::size_t pixel = kept[i];
    to.places[pixel] = static_cast<std::uint16_t>(i);
    for (std::size_t s = 0; s < samples_; ++s) {
      const TileColor& sample = tile.samples[s];
      to.radiance.emplace_back(sample.r[pixel], sample.g[pixel], sample.b[pixel]);
    }
  }
}

const glm::vec3* MirrorSamples::at(int x, int y) const {
  constexpr int kSide = raster::kTileSide;
  const Tile& tile = tiles_[tile_number(x / kSide, y / kSide)];
  if (tile.places.empty()) return nullptr;
  const std::uint16_t place =
      tile.places[static_cast<std::size_t>(raster::index_in_tile(x % kSide, y % kSide))];
  return place == kNone ? nullptr : tile.radiance.data() + place * samples_;
}

std::size_t MirrorSamples::memory_bytes() const {
  std::size_t bytes = tiles_.capacity() * sizeof(Tile);
  for (const Tile& tile : tiles_) {
    bytes +=
        tile.places.capacity() * sizeof(tile.places[0]) + tile.radiance.capacity() * sizeof(tile.radiance[0]);
  }
  return bytes;
}

}  // namespace laterna::shade
