#include "bake/luxel_padding.h"

#include <algorithm>
#include <array>

namespace laterna::bake {
namespace {

struct Filled {
  std::size_t place;
  std::array<std::size_t, 8> from;
  std::size_t count;
};

template <class Value>
void fill(Image& picture, const Filled& luxel, float rounding) {
  const auto channels = static_cast<std::size_t>(picture.channels());
  const std::span<Value> values = picture.values<Value>();
  for (std::size_t c = 0; c < channels; ++c) {
    float sum = 0;
    for (std::size_t k = 0; k < luxel.count; ++k)
      sum += static_cast<float>(values[luxel.from[k] * channels + c]);
    values[luxel.place * channels + c] = static_cast<Value>(sum / static_cast<float>(luxel.count) + rounding);
  }
}

}  // namespace

std::size_t continue_surfaces(std::span<Image* const> pictures, std::span<const std::uint8_t> is_found,
                              int luxels) {
  const std::int64_t width = pictures.front()->width(), height = pictures.front()->height();
  std::vector<std::uint8_t> is_done(is_found.begin(), is_found.end());
  std::size_t count = 0;
  for (int step = 0; step < luxels; ++step) {
    std::vector<Filled> ring;
    for (std::int64_t y = 0; y < height; ++y) {
      for (std::int64_t x = 0; x < width; ++x) {
        Filled luxel = {static_cast<std::size_t>(y * width + x), {}, 0};
        if (is_done[luxel.place] != 0) continue;
        for (std::int64_t v = std::max<std::int64_t>(y - 1, 0); v <= std::min(y + 1, height - 1); ++v) {
          for (std::int64_t u = std::max<std::int64_t>(x - 1, 0); u <= std::min(x + 1, width - 1); ++u) {
            const auto from = static_cast<std::size_t>(v * width + u);
            if (is_done[from] != 0) luxel.from[luxel.count++] = from;
          }
        }
        if (luxel.count > 0) ring.push_back(luxel);
      }
    }
    for (const Filled& luxel : ring) {
      for (Image* picture : pictures) {
        if (picture->type() == PixelType::f32) {
          fill<float>(*picture, luxel, 0);
        } else {
          fill<std::uint8_t>(*picture, luxel, 0.5F);
        }
      }
      is_done[luxel.place] = 1;
    }
    count += ring.size();
    if (ring.empty()) break;
  }
  return count;
}

}  // namespace laterna::bake
