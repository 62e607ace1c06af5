#include "shade/mirror_picture.h"

#include <algorithm>
#include <cmath>

namespace laterna::shade {

MirrorPicture::MirrorPicture(const light::MirrorView& seen, const Mirror& mirror, int width, double seconds)
    : mirror_(&mirror),
      normal_ws_(seen.normal_ws),
      seconds_(seconds),
      picture_width_(width),
      drawn_(seen.box),
      box_(light::mirrored(seen.box, width)),
      levels_(1) {
  Level& finest = levels_[0];
  finest.width = box_.x_end - box_.x_begin;
  finest.height = box_.y_end - box_.y_begin;
  finest.pixels.resize(static_cast<std::size_t>(finest.width) * static_cast<std::size_t>(finest.height));
}

void MirrorPicture::write(int tile_x, int tile_y, const TileResult& tile) {
  constexpr int kSide = raster::kTileSide;
  Level& finest = levels_[0];
  const int x_begin = std::max(drawn_.x_begin, tile_x * kSide),
            x_end = std::min(drawn_.x_end, (tile_x + 1) * kSide);
  const int y_begin = std::max(drawn_.y_begin, tile_y * kSide),
            y_end = std::min(drawn_.y_end, (tile_y + 1) * kSide);
  for (int y = y_begin; y < y_end; ++y) {
    glm::vec4* row = finest.pixels.data() +
                     static_cast<std::size_t>(y - box_.y_begin) * static_cast<std::size_t>(finest.width);
    for (int x = x_begin; x < x_end; ++x) {
      const auto i = static_cast<std::size_t>(raster::index_in_tile(x - tile_x * kSide, y - tile_y * kSide));
      const float nearness = needs_depth() ? 1 / tile.depth[i] : 0;
      row[picture_width_ - 1 - x - box_.x_begin] = {tile.beauty.r[i], tile.beauty.g[i], tile.beauty.b[i],
                                                    nearness};
    }
  }
}

void MirrorPicture::finish() {
  if (mirror_->roughness == 0) return;
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& fine = levels_.back();
    Level coarse;
    coarse.width = (fine.width + 1) / 2;
    coarse.height = (fine.height + 1) / 2;
    coarse.pixels.reserve(static_cast<std::size_t>(coarse.width) * static_cast<std::size_t>(coarse.height));
    for (int y = 0; y < coarse.height; ++y) {
      for (int x = 0; x < coarse.width; ++x) {
        coarse.pixels.push_back(0.25F * ((fine.at(2 * x, 2 * y) + fine.at(2 * x + 1, 2 * y)) +
                                         (fine.at(2 * x, 2 * y + 1) + fine.at(2 * x + 1, 2 * y + 1))));
      }
    }
    levels_.push_back(std::move(coarse));
  }
}

const glm::vec4& MirrorPicture::Level::at(int x, int y) const {
  const int column = std::clamp(x, 0, width - 1), row = std::clamp(y, 0, height - 1);
  return pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(column)];
}

const glm::vec4& MirrorPicture::at(int x, int y) const {
  return levels_[0].at(x - box_.x_begin, y - box_.y_begin);
}

int MirrorPicture::level_of(float side) const {
  int level = 0;
  while (level + 1 < static_cast<int>(levels_.size()) && static_cast<float>(2 << level) <= side) ++level;
  return level;
}

glm::vec4 MirrorPicture::interpolated(float x, float y, int level) const {
  const Level& of = levels_[static_cast<std::size_t>(level)];
  const auto side = static_cast<float>(1 << level);
  const auto place = [&](float at, int begin, int size) {
    return std::clamp((at - static_cast<float>(begin)) / side - 0.5F, 0.0F, static_cast<float>(size - 1));
  };
  const float u = place(x, box_.x_begin, of.width), v = place(y, box_.y_begin, of.height);
  const float column = std::floor(u), row = std::floor(v);
  const int i = static_cast<int>(column), j = static_cast<int>(row);
  const glm::vec4 upper = of.at(i, j) + (of.at(i + 1, j) - of.at(i, j)) * (u - column);
  const glm::vec4 lower = of.at(i, j + 1) + (of.at(i + 1, j + 1) - of.at(i, j + 1)) * (u - column);
  return upper + (lower - upper) * (v - row);
}

}  // namespace laterna::shade
