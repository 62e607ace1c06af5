#include "image/video_colour.h"

#include <algorithm>
#include <cmath>

namespace laterna::image {
namespace {

constexpr int kFractionBits = 32;
constexpr double kOne = 4294967296.0;  // 2^kFractionBits

struct LumaWeights {
  double red, blue;
};

LumaWeights luma_weights(LaternaVideoMatrix matrix) {
  switch (matrix) {
    case kVideoBt601:
      return {0.299, 0.114};
    case kVideoBt2020:
      return {0.2627, 0.0593};
    case kVideoSmpte240m:
      return {0.212, 0.087};
    case kVideoBt709:
    case kVideoRgb:
      break;
  }
  return {0.2126, 0.0722};
}

// Samples of a component, one row.
class Row {
 public:
  Row(const LaternaVideoComponent& component, int y, bool is_big_endian)
      : at_(component.data + y * component.stride),
        step_(component.step),
        shift_(component.shift),
        mask_((1U << component.depth) - 1),
        is_wide_(component.depth + component.shift > 8),
        high_(is_big_endian ? 0 : 1) {}

  [[nodiscard]] std::uint32_t operator[](int x) const {
    const std::uint8_t* at = at_ + static_cast<std::ptrdiff_t>(x) * step_;
    const std::uint32_t word =
        is_wide_ ? static_cast<std::uint32_t>(at[high_]) << 8U | at[1 - high_] : std::uint32_t{*at};
    return word >> static_cast<unsigned>(shift_) & mask_;
  }

 private:
  const std::uint8_t* at_;
  int step_, shift_;
  std::uint32_t mask_;
  bool is_wide_;
  int high_;  // where the high byte is
};

template <class Value>
Value rounded(std::int64_t sum, std::int64_t largest) {
  const std::int64_t value = (sum + (std::int64_t{1} << (kFractionBits - 1))) >> kFractionBits;
  return static_cast<Value>(std::clamp<std::int64_t>(value, 0, largest));
}

// Codes from `low` to `low` + `span` become 0 to `largest`, to the nearest.
template <class Value>
void copy_component(const LaternaVideoPicture& picture, int component, Image& image, int channel,
                    std::uint32_t low, std::uint32_t span) {
  const auto largest = static_cast<std::uint64_t>(static_cast<Value>(-1));
  const std::span<Value> values = image.values<Value>();
  const auto step = static_cast<std::size_t>(image.channels());
  auto to = static_cast<std::size_t>(channel);
  for (int y = 0; y < picture.height; ++y) {
    const Row row(picture.components[component], y, picture.is_big_endian != 0);
    for (int x = 0; x < picture.width; ++x, to += step) {
      const std::uint32_t code = row[x];
      const std::uint64_t above = std::min(code < low ? 0 : code - low, span);
      values[to] = static_cast<Value>((above * largest * 2 + span) / (std::uint64_t{2} * span));
    }
  }
}

template <class Value>
void copy_components(const LaternaVideoPicture& picture, int first, int end, bool is_limited, Image& image) {
  for (int c = first; c < end; ++c) {
    const auto depth = static_cast<unsigned>(picture.components[c].depth);
    const std::uint32_t unit = depth < 8 ? 0 : 1U << (depth - 8);
    if (is_limited && unit > 0) {
      copy_component<Value>(picture, c, image, c, 16 * unit, 219 * unit);
    } else {
      copy_component<Value>(picture, c, image, c, 0, (1U << depth) - 1);
    }
  }
}

}  // namespace

void VideoColour::make_terms(const Key& key) {
  key_ = key;
  const auto [kr, kb] = luma_weights(key.matrix);
  const double kg = 1 - kr - kb;
  const double codes = static_cast<double>(1 << key.depth);
  const double unit = codes / 256;
  const bool is_full = key.is_full_range != 0;
  const double black = is_full ? 0 : 16 * unit;
  const double luma_span = is_full ? codes - 1 : 219 * unit;
  const double chroma_span = is_full ? codes - 1 : 224 * unit;
  const auto fill = [&](Terms& terms, double zero, double span, double factor) {
    terms.resize(static_cast<std::size_t>(codes));
    for (std::size_t code = 0; code < terms.size(); ++code) {
      const double part = (static_cast<double>(code) - zero) * (factor * key.largest) / span;
      terms[code] = static_cast<std::int64_t>(std::floor(part * kOne + 0.5));
    }
  };
  fill(luma_, black, luma_span, 1);
  fill(red_from_cr_, codes / 2, chroma_span, 2 * (1 - kr));
  fill(blue_from_cb_, codes / 2, chroma_span, 2 * (1 - kb));
  fill(green_from_cr_, codes / 2, chroma_span, -2 * (1 - kr) * kr / kg);
  fill(green_from_cb_, codes / 2, chroma_span, -2 * (1 - kb) * kb / kg);
}

template <class Value>
void VideoColour::convert_chroma(const LaternaVideoPicture& picture, Image& image) {
  const bool is_big_endian = picture.is_big_endian != 0;
  const std::span<Value> values = image.values<Value>();
  const auto step = static_cast<std::size_t>(image.channels());
  std::size_t to = 0;
  for (int y = 0; y < picture.height; ++y) {
    const Row luma(picture.components[0], y, is_big_endian);
    const Row cb_row(picture.components[1], y >> picture.chroma_shift_y, is_big_endian);
    const Row cr_row(picture.components[2], y >> picture.chroma_shift_y, is_big_endian);
    for (int x = 0; x < picture.width; ++x, to += step) {
      const std::int64_t light = luma_[luma[x]];
      const std::uint32_t cb = cb_row[x >> picture.chroma_shift_x];
      const std::uint32_t cr = cr_row[x >> picture.chroma_shift_x];
      values[to] = rounded<Value>(light + red_from_cr_[cr], key_.largest);
      values[to + 1] = rounded<Value>(light + green_from_cb_[cb] + green_from_cr_[cr], key_.largest);
      values[to + 2] = rounded<Value>(light + blue_from_cb_[cb], key_.largest);
    }
  }
}

Image VideoColour::convert(const LaternaVideoPicture& picture) {
  int deepest = 0;
  for (int c = 0; c < picture.component_count; ++c) deepest = std::max(deepest, picture.components[c].depth);
  const bool is_wide = deepest > 8;
  Image image(picture.width, picture.height, picture.component_count,
              is_wide ? PixelType::u16 : PixelType::u8, Transfer::srgb);
  const int colours = picture.component_count - (image.has_alpha() ? 1 : 0);
  const auto copy = [&](int first, int end, bool is_limited) {
    if (is_wide) {
      copy_components<std::uint16_t>(picture, first, end, is_limited, image);
    } else {
      copy_components<std::uint8_t>(picture, first, end, is_limited, image);
    }
  };
  if (picture.matrix == kVideoRgb || colours == 1) {
    copy(0, colours, picture.is_full_range == 0);
  } else {
    const Key key = {picture.matrix, picture.is_full_range, picture.components[0].depth,
                     is_wide ? 65535 : 255};
    if (!(key == key_)) make_terms(key);
    if (is_wide) {
      convert_chroma<std::uint16_t>(picture, image);
    } else {
      convert_chroma<std::uint8_t>(picture, image);
    }
  }
  copy(colours, picture.component_count, false);
  return image;
}

}  // namespace laterna::image
