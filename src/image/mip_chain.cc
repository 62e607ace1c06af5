#include "image/mip_chain.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"

namespace laterna::image {
namespace {

constexpr float kMax11 = 2047.0F;
constexpr float kMax10 = 1023.0F;

using Float4 = std::array<float, 4>;

std::uint32_t quantise(float value, float largest) {
  return static_cast<std::uint32_t>(std::clamp(value, 0.0F, 1.0F) * largest + 0.5F);
}

std::uint32_t encode_colour(const Float4& c) {
  const auto root = [](float v) { return std::sqrt(std::max(v, 0.0F)); };
  return quantise(root(c[0]), kMax11) << 21U | quantise(root(c[1]), kMax11) << 10U |
         quantise(root(c[2]), kMax10);
}

std::uint32_t encode_data(const Float4& c) {
  return quantise(c[0], 255) | quantise(c[1], 255) << 8U | quantise(c[2], 255) << 16U |
         quantise(c[3], 255) << 24U;
}

// 8-bit codes, decoded.
struct ByteTable {
  std::array<float, 256> value;
  explicit ByteTable(bool is_srgb) : value() {
    for (int i = 0; i < 256; ++i) {
      value[static_cast<std::size_t>(i)] =
          static_cast<float>(is_srgb ? linear_from_srgb(i / 255.0) : i / 255.0);
    }
  }
};

// Reads a row of any picture as linear r, g, b, a.
class RowReader {
 public:
  RowReader(const Image& picture, bool is_srgb)
      : picture_(picture), is_srgb_(is_srgb), bytes_(is_srgb), is_grey_(picture.channels() <= 2) {}

  void read(int y, Float4* row) const {
    switch (picture_.type()) {
      case PixelType::u8:
        read_bytes(y, row);
        break;
      case PixelType::u16:
      case PixelType::f32:
        read_values(y, row);
        break;
    }
  }

 private:
  void read_bytes(int y, Float4* row) const {
    const auto channels = static_cast<std::size_t>(picture_.channels());
    const std::uint8_t* p =
        picture_.values<std::uint8_t>().data() +
        static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width()) * channels;
    for (int x = 0; x < picture_.width(); ++x, p += channels, ++row) {
      const float alpha = picture_.has_alpha() ? static_cast<float>(p[channels - 1]) / 255.0F : 1.0F;
      *row = is_grey_ ? Float4{bytes_.value[p[0]], bytes_.value[p[0]], bytes_.value[p[0]], alpha}
                      : Float4{bytes_.value[p[0]], bytes_.value[p[1]], bytes_.value[p[2]], alpha};
    }
  }

  void read_values(int y, Float4* row) const {
    for (int x = 0; x < picture_.width(); ++x, ++row) {
      for (int c = 0; c < 3; ++c) {
        const float v = picture_.value(x, y, is_grey_ ? 0 : c);
        (*row)[static_cast<std::size_t>(c)] = is_srgb_ ? static_cast<float>(linear_from_srgb(v)) : v;
      }
      (*row)[3] = picture_.has_alpha() ? picture_.value(x, y, picture_.channels() - 1) : 1.0F;
    }
  }

  const Image& picture_;
  bool is_srgb_;
  ByteTable bytes_;
  bool is_grey_;
};

// Source span of one destination texel along an axis: two texels where the size is even, three where it is
// odd.
struct Span {
  int first = 0, count = 0;
  float weight[3] = {};
};

std::vector<Span> spans(int from, int to) {
  std::vector<Span> all(static_cast<std::size_t>(to));
  for (int i = 0; i < to; ++i) {
    Span& s = all[static_cast<std::size_t>(i)];
    if (from == to) {
      s = {i, 1, {1}};
    } else if (from == 2 * to) {
      s = {2 * i, 2, {0.5F, 0.5F}};
    } else {
      // from = 2 to + 1: destination texel i covers [i from/to, (i + 1) from/to). Guthe and Heckbert,
      // Non-power-of-two mipmapping, 2005.
      const auto n = static_cast<float>(from);
      const auto m = static_cast<float>(to);
      const auto k = static_cast<float>(i);
      s = {2 * i, 3, {(m - k) / n, m / n, (k + 1) / n}};
    }
  }
  return all;
}

class Builder {
 public:
  Builder(const Image& picture, MipUse use) : picture_(picture), use_(use) {
    const bool is_srgb = use != MipUse::data && picture.transfer() == Transfer::srgb;
    chain_.format = format();
    lay_out();
    if (chain_.format == TexelFormat::wide) {
      chain_.wide.resize(std::size_t{chain_.texel_count} * 3);
    } else {
      chain_.texels.resize(chain_.texel_count);
    }
    if (use == MipUse::colour_with_alpha && picture.has_alpha())
      chain_.alpha.resize(chain_.texel_count + 3, 0);
    const RowReader reader(picture, is_srgb);
    const auto width = static_cast<std::size_t>(picture.width());
    if (chain_.level_count == 1) {
      rows_.resize(1);
      reader.read(0, rows_.data());
      store(chain_.levels[0], 0, rows_.data());
      return;
    }
    // The full size is read three rows at a time and never held as floats.
    std::vector<Float4> ring(3 * width);
    rows_.resize(static_cast<std::size_t>(chain_.levels[1].width) *
                 static_cast<std::size_t>(chain_.levels[1].height));
    int read = 0;
    shrink(1, [&](int y) {
      for (; read <= y; ++read) {
        Float4* row = ring.data() + static_cast<std::size_t>(read % 3) * width;
        reader.read(read, row);
        store(chain_.levels[0], read, row);
      }
      return static_cast<const Float4*>(ring.data() + static_cast<std::size_t>(y % 3) * width);
    });
    for (int level = 2; level < chain_.level_count; ++level) {
      const auto from_width =
          static_cast<std::size_t>(chain_.levels[static_cast<std::size_t>(level) - 1].width);
      // In place: a destination row never lies behind the source rows it is made of.
      shrink(level, [&](int y) {
        return static_cast<const Float4*>(rows_.data() + static_cast<std::size_t>(y) * from_width);
      });
    }
  }

  MipChain take() { return std::move(chain_); }

 private:
  [[nodiscard]] TexelFormat format() const {
    if (picture_.type() != PixelType::u8) return TexelFormat::wide;
    if (use_ == MipUse::data) return TexelFormat::data;
    return picture_.transfer() == Transfer::srgb ? TexelFormat::colour : TexelFormat::wide;
  }

  void lay_out() {
    int w = picture_.width();
    int h = picture_.height();
    for (;;) {
      chain_.levels[static_cast<std::size_t>(chain_.level_count++)] = {w, h, chain_.texel_count};
      chain_.texel_count += static_cast<std::uint32_t>(w) * static_cast<std::uint32_t>(h);
      if (w == 1 && h == 1) break;
      w = std::max(1, w / 2);
      h = std::max(1, h / 2);
    }
  }

  void store(const MipLevel& level, int y, const Float4* row) {
    const std::size_t first =
        level.first + static_cast<std::size_t>(y) * static_cast<std::size_t>(level.width);
    const auto width = static_cast<std::size_t>(level.width);
    switch (chain_.format) {
      case TexelFormat::colour:
        for (std::size_t x = 0; x < width; ++x) chain_.texels[first + x] = encode_colour(row[x]);
        break;
      case TexelFormat::data:
        for (std::size_t x = 0; x < width; ++x) chain_.texels[first + x] = encode_data(row[x]);
        break;
      case TexelFormat::wide:
        for (std::size_t x = 0; x < width; ++x) {
          for (std::size_t c = 0; c < 3; ++c) chain_.wide[chain_.texel_count * c + first + x] = row[x][c];
        }
        break;
    }
    if (chain_.alpha.empty()) return;
    for (std::size_t x = 0; x < width; ++x)
      chain_.alpha[first + x] = static_cast<std::uint8_t>(quantise(row[x][3], 255));
  }

  // Level `level` into rows_ from the one before it, whose rows `source_row` gives.
  template <class SourceRow>
  void shrink(int level, SourceRow source_row) {
    const MipLevel& from = chain_.levels[static_cast<std::size_t>(level) - 1];
    const MipLevel& to = chain_.levels[static_cast<std::size_t>(level)];
    const std::vector<Span> across = spans(from.width, to.width);
    const std::vector<Span> down = spans(from.height, to.height);
    for (int y = 0; y < to.height; ++y) {
      const Span& v = down[static_cast<std::size_t>(y)];
      const Float4* in[3] = {};
      for (int j = 0; j < v.count; ++j) in[j] = source_row(v.first + j);
      Float4* out = rows_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(to.width);
      for (int x = 0; x < to.width; ++x) {
        const Span& u = across[static_cast<std::size_t>(x)];
        Float4 sum{};
        for (int j = 0; j < v.count; ++j) {
          for (int i = 0; i < u.count; ++i) {
            const float weight = u.weight[i] * v.weight[j];
            for (std::size_t c = 0; c < 4; ++c) sum[c] += weight * in[j][u.first + i][c];
          }
        }
        out[x] = sum;
      }
      store(to, y, out);
    }
  }

  const Image& picture_;
  MipUse use_;
  MipChain chain_;
  std::vector<Float4> rows_;
};

}  // namespace

MipChain make_mip_chain(const Image& picture, MipUse use) { return Builder(picture, use).take(); }

std::array<float, 4> texel(const MipChain& chain, int level, int x, int y) {
  const MipLevel& l = chain.levels[static_cast<std::size_t>(level)];
  const std::size_t i =
      l.first + static_cast<std::size_t>(y) * static_cast<std::size_t>(l.width) + static_cast<std::size_t>(x);
  const float alpha = chain.alpha.empty() ? 1.0F : static_cast<float>(chain.alpha[i]) / 255.0F;
  if (chain.format == TexelFormat::wide) {
    return {chain.wide[i], chain.wide[chain.texel_count + i],
            chain.wide[std::size_t{2} * chain.texel_count + i], alpha};
  }
  const std::uint32_t t = chain.texels[i];
  if (chain.format == TexelFormat::data) {
    const auto part = [&](unsigned shift) { return static_cast<float>(t >> shift & 255U) / 255.0F; };
    return {part(0), part(8), part(16), part(24)};
  }
  const auto square = [](float v) { return v * v; };
  return {square(static_cast<float>(t >> 21U) / kMax11),
          square(static_cast<float>(t >> 10U & 2047U) / kMax11),
          square(static_cast<float>(t & 1023U) / kMax10), alpha};
}

}  // namespace laterna::image
