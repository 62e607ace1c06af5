#include "shade/mirror_picture.h"

#include <algorithm>
#include <cmath>

namespace laterna::shade {

MirrorPicture::MirrorPicture(const light::MirrorView& seen, const Mirror& mirror, int width, int height,
                             int samples, double seconds, SampleIndex of_mean)
    : mirror_(&mirror),
      seen_(seen),
      samples_(static_cast<std::size_t>(samples)),
      seconds_(seconds),
      cone_rays_(shade::cone_rays(of_mean)),
      drawn_(seen.view, width, height),
      box_(seen.is_refracted ? seen.box : light::mirrored(seen.box, width)),
      levels_(1) {
  Level& finest = levels_[0];
  finest.width = box_.x_end - box_.x_begin;
  finest.height = box_.y_end - box_.y_begin;
  finest.pixels.resize(static_cast<std::size_t>(finest.width) * static_cast<std::size_t>(finest.height));
  if (needs_samples() && !needs_depth()) kept_samples_.emplace(seen_.box, samples);
}

void MirrorPicture::write(int tile_x, int tile_y, const TileResult& tile) {
  constexpr int kSide = raster::kTileSide;
  if (kept_samples_) kept_samples_->write(tile_x, tile_y, tile);
  Level& finest = levels_[0];
  const light::PixelBox& drawn = seen_.box;
  const int x_begin = std::max(drawn.x_begin, tile_x * kSide),
            x_end = std::min(drawn.x_end, (tile_x + 1) * kSide);
  const int y_begin = std::max(drawn.y_begin, tile_y * kSide),
            y_end = std::min(drawn.y_end, (tile_y + 1) * kSide);
  for (int y = y_begin; y < y_end; ++y) {
    const std::size_t row =
        static_cast<std::size_t>(y - box_.y_begin) * static_cast<std::size_t>(finest.width);
    for (int x = x_begin; x < x_end; ++x) {
      const auto i = static_cast<std::size_t>(raster::index_in_tile(x - tile_x * kSide, y - tile_y * kSide));
      const float nearness = needs_depth() ? 1 / tile.depth[i] : 0;
      const int column = seen_.is_refracted ? x : drawn_.width - 1 - x;
      const std::size_t pixel = row + static_cast<std::size_t>(column - box_.x_begin);
      const bool is_mixed = needs_samples() && needs_depth() && !are_alike(tile, i);
      const TileColor& shown = is_mixed ? tile.samples.front() : tile.beauty;
      finest.pixels[pixel] = {shown.r[i], shown.g[i], shown.b[i], nearness};
    }
  }
}

// How far what is shown reaches.
void MirrorPicture::find_extent() {
  const raster::RasterView& drawn = drawn_;
  const Level& finest = levels_[0];
  for (int y = 0; y < finest.height; ++y) {
    for (int x = 0; x < finest.width; ++x) {
      const float nearness = finest.at(x, y).w;
      if (nearness <= 0) continue;
      farthest_ = std::max(farthest_, 1 / nearness);
      const int column = seen_.is_refracted ? box_.x_begin + x : drawn.width - 1 - (box_.x_begin + x);
      const double pixel_x = column + 0.5 - drawn.origin_x, pixel_y = box_.y_begin + y + 0.5 - drawn.origin_y;
      const glm::dvec3 ray = drawn.direction_0 + drawn.direction_x * pixel_x + drawn.direction_y * pixel_y;
      const double distance = 1 / static_cast<double>(nearness);
      const glm::dvec3 place = drawn.is_orthographic
                                   ? ray + drawn.axis_ws * drawn.reversed_from_distance(distance)
                                   : drawn.eye_ws + ray * distance;
      deepest_ = std::max(deepest_, seen_.side(place));
    }
  }
}

void MirrorPicture::finish() {
  if (needs_depth()) find_extent();
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

glm::vec3 MirrorPicture::at_sample(int x, int y, std::size_t number) const {
  if (!kept_samples_) return glm::vec3(at(x, y));
  const int column = std::clamp(x, box_.x_begin, box_.x_end - 1),
            row = std::clamp(y, box_.y_begin, box_.y_end - 1);
  const glm::vec3* samples = kept_samples_->at(drawn_.width - 1 - column, row);
  return samples == nullptr ? glm::vec3(at(x, y)) : samples[number];
}

const glm::vec4& MirrorPicture::nearest(float x, float y) const {
  const auto pixel = [](float place, int begin, int end) {
    return static_cast<int>(
        std::clamp(std::floor(place), static_cast<float>(begin), static_cast<float>(end - 1)));
  };
  return at(pixel(x, box_.x_begin, box_.x_end), pixel(y, box_.y_begin, box_.y_end));
}

glm::vec4 MirrorPicture::on_surface(float x, float y) const {
  constexpr float kMostChange = 0.02F;  // of the nearest, from pixel to pixel of one surface
  const auto corner = [](float place) { return std::clamp(std::floor(place - 0.5F), -1e6F, 1e6F); };
  const int i = static_cast<int>(corner(x)), j = static_cast<int>(corner(y));
  const float taps[] = {at(i, j).w, at(i + 1, j).w, at(i, j + 1).w, at(i + 1, j + 1).w};
  const auto [least, most] = std::minmax_element(std::begin(taps), std::end(taps));
  return *most - *least <= kMostChange * *most ? interpolated(x, y, 0) : nearest(x, y);
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
