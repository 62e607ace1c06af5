#include "bake/page_light.h"

#include <algorithm>

namespace laterna::bake {
namespace {

constexpr int kRowsPerStrip = kTileRowsPerStrip * kTileSide;

// One tile; one for each thread.
class TileLight {
 public:
  TileLight(const PageContext& context, int first_row, StripValues& values)
      : context_(context), first_row_(first_row), values_(values) {}

  void find(glm::ivec2 tile) {
    find_receivers(context_.frame, context_.rays, context_.triangles, tile, context_.receivers, receivers_);
    if (receivers_.empty()) return;
    light(tile, false, values_.front);
    if (!values_.back.empty()) light(tile, true, values_.back);
    if (context_.occlusion != nullptr) find_openness(tile);
  }

 private:
  [[nodiscard]] std::size_t place_of(glm::ivec2 tile, std::uint32_t luxel) const {
    const auto row = static_cast<std::size_t>(tile.y * kTileSide - first_row_) + luxel / kTileSide;
    return row * static_cast<std::size_t>(values_.size.x) + static_cast<std::size_t>(tile.x * kTileSide) +
           luxel % kTileSide;
  }

  // Calls use(place, first, end) for the receivers of each luxel.
  template <class Use>
  void for_luxels(glm::ivec2 tile, Use use) const {
    for (std::size_t first = 0; first < receivers_.size();) {
      std::size_t end = first + 1;
      while (end < receivers_.size() && receivers_[end].luxel == receivers_[first].luxel) ++end;
      use(place_of(tile, receivers_[first].luxel), first, end);
      first = end;
    }
  }

  void light(glm::ivec2 tile, bool of_back, std::span<float> rgb) {
    irradiance_.assign(receivers_.size(), glm::vec3(0));
    context_.light.add(receivers_, of_back, irradiance_);
    for_luxels(tile, [&](std::size_t place, std::size_t first, std::size_t end) {
      glm::vec3 sum(0);
      for (std::size_t i = first; i < end; ++i) sum += irradiance_[i];
      for (int c = 0; c < 3; ++c)
        rgb[3 * place + static_cast<std::size_t>(c)] = sum[c] / static_cast<float>(end - first);
      values_.is_found[place] = 1;
    });
  }

  void find_openness(glm::ivec2 tile) {
    for_luxels(tile, [&](std::size_t place, std::size_t first, std::size_t end) {
      const std::span<const Receiver> receivers = std::span(receivers_).subspan(first, end - first);
      float& openness = values_.openness[place];
      openness = context_.occlusion->openness(receivers, false);
      if (!values_.back.empty()) openness = 0.5F * (openness + context_.occlusion->openness(receivers, true));
    });
  }

  const PageContext& context_;
  int first_row_;
  StripValues& values_;
  std::vector<Receiver> receivers_;
  std::vector<glm::vec3> irradiance_;
};

}  // namespace

StripValues::StripValues(glm::ivec2 luxels, bool with_back, bool with_occlusion) : size(luxels) {
  const auto count = static_cast<std::size_t>(luxels.x) * static_cast<std::size_t>(luxels.y);
  numbers.assign(count * (4 + (with_back ? 3U : 0U) + (with_occlusion ? 1U : 0U)), 0.0F);
  std::span<float> rest(numbers);
  const auto take = [&](std::size_t length) {
    const std::span<float> taken = rest.first(length);
    rest = rest.subspan(length);
    return taken;
  };
  is_found = take(count);
  front = take(3 * count);
  if (with_back) back = take(3 * count);
  if (with_occlusion) openness = take(count);
  std::ranges::fill(openness, 1.0F);
}

std::size_t strip_count(glm::ivec2 page) {
  return static_cast<std::size_t>((page.y + kRowsPerStrip - 1) / kRowsPerStrip);
}

glm::ivec2 strip_size(glm::ivec2 page, std::size_t strip) {
  return {page.x, std::min(kRowsPerStrip, page.y - static_cast<int>(strip) * kRowsPerStrip)};
}

void light_strip(const PageContext& context, std::size_t strip, StripValues& values) {
  const glm::ivec2 tiles = context.triangles.tiles();
  const int first_row = static_cast<int>(strip) * kTileRowsPerStrip;
  const int rows = std::min(kTileRowsPerStrip, tiles.y - first_row);
  context.pool.for_each(static_cast<std::size_t>(rows * tiles.x), [&](std::size_t index, int) {
    if (context.progress.is_cancelled()) return;
    const auto number = static_cast<int>(index);
    TileLight(context, first_row * kTileSide, values).find({number % tiles.x, first_row + number / tiles.x});
    context.progress.advance();
  });
}

}  // namespace laterna::bake
