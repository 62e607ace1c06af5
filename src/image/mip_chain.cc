#include "image/mip_chain.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "image/colour.h"
#include "image/image_rows.h"
#include "image/mip_rows.h"

namespace laterna::image {
namespace {

// What the 8-bit codes of the channels come to in a texel; they are put together by "or".
using CodeTexels = std::array<std::array<std::uint32_t, 256>, 4>;

const std::array<float, 256>& code_fractions() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> fractions{};
    for (std::size_t code = 0; code < 256; ++code)
      fractions[code] = static_cast<float>(static_cast<double>(code) / 255);
    return fractions;
  }();
  return table;
}

// As linear_from_srgb() of Image::value(). Frames of deep films would spend most of their time in powers.
const std::vector<float>& linear_from_16_bits() {
  static const std::vector<float> table = [] {
    std::vector<float> values(65536);
    for (std::size_t code = 0; code < values.size(); ++code)
      values[code] = static_cast<float>(linear_from_srgb(static_cast<float>(code) / 65535.0F));
    return values;
  }();
  return table;
}

std::uint32_t quantised_root(float value, float largest) {
  return static_cast<std::uint32_t>(std::sqrt(value) * largest + 0.5F);
}

const CodeTexels& colour_texels() {
  static const CodeTexels table = [] {
    CodeTexels texels{};
    for (std::size_t code = 0; code < 256; ++code) {
      const float value = linear_from_srgb8()[code];
      texels[0][code] = quantised_root(value, kLargestRedGreen) << 21U;
      texels[1][code] = quantised_root(value, kLargestRedGreen) << 10U;
      texels[2][code] = quantised_root(value, kLargestBlue);
    }
    return texels;
  }();
  return table;
}

const CodeTexels& data_texels() {
  static const CodeTexels table = [] {
    CodeTexels texels{};
    for (std::uint32_t channel = 0; channel < 4; ++channel) {
      for (std::uint32_t code = 0; code < 256; ++code) texels[channel][code] = code << 8U * channel;
    }
    return texels;
  }();
  return table;
}

// Where a row's channels lie: grey is spread over r, g and b.
struct ChannelOffsets {
  explicit ChannelOffsets(const Image& picture)
      : step(static_cast<std::size_t>(picture.channels())),
        green(picture.channels() <= 2 ? 0 : 1),
        blue(picture.channels() <= 2 ? 0 : 2) {}
  std::size_t step, green, blue;
};

// Rows of any picture as planes of linear r, g, b and, where it is asked for, alpha.
class RowReader {
 public:
  RowReader(const Image& picture, bool is_srgb, bool has_alpha)
      : picture_(picture),
        is_srgb_(is_srgb),
        has_alpha_(has_alpha),
        offsets_(picture),
        width_(static_cast<std::size_t>(picture.width())),
        stride_(plane_stride(width_)) {}

  void read(int y, float* planes) const {
    if (picture_.type() == PixelType::u8) {
      read_codes(y, planes);
    } else {
      read_values(y, planes);
    }
    if (has_alpha_) read_alpha(y, planes + 3 * stride_);
  }

 private:
  [[nodiscard]] const std::uint8_t* codes(int y) const {
    return reinterpret_cast<const std::uint8_t*>(row_bytes(picture_, y).data());
  }

  void read_codes(int y, float* planes) const {
    const std::array<float, 256>& value = is_srgb_ ? linear_from_srgb8() : code_fractions();
    const std::uint8_t* code = codes(y);
    float* const green = planes + stride_;
    float* const blue = green + stride_;
    for (std::size_t x = 0; x < width_; ++x, code += offsets_.step) {
      planes[x] = value[code[0]];
      green[x] = value[code[offsets_.green]];
      blue[x] = value[code[offsets_.blue]];
    }
  }

  void read_alpha(int y, float* alpha) const {
    if (!picture_.has_alpha()) {
      std::fill_n(alpha, width_, 1.0F);
    } else if (picture_.type() == PixelType::u8) {
      const auto* code = codes(y) + offsets_.step - 1;
      for (std::size_t x = 0; x < width_; ++x) alpha[x] = code_fractions()[code[x * offsets_.step]];
    } else {
      for (int x = 0; x < picture_.width(); ++x) alpha[x] = picture_.value(x, y, picture_.channels() - 1);
    }
  }

  // A table pays where it is shorter than the picture.
  [[nodiscard]] bool reads_by_table() const {
    constexpr std::size_t kTable = 65536;
    return is_srgb_ && picture_.type() == PixelType::u16 && picture_.bytes().size() >= 2 * kTable;
  }

  void read_values(int y, float* planes) const {
    const bool is_grey = picture_.channels() <= 2;
    if (reads_by_table()) {
      const std::vector<float>& linear = linear_from_16_bits();
      const auto* code = reinterpret_cast<const std::uint16_t*>(row_bytes(picture_, y).data());
      for (std::size_t x = 0; x < width_; ++x, code += offsets_.step) {
        planes[x] = linear[code[0]];
        planes[stride_ + x] = linear[code[offsets_.green]];
        planes[2 * stride_ + x] = linear[code[offsets_.blue]];
      }
      return;
    }
    for (int c = 0; c < 3; ++c, planes += stride_) {
      for (int x = 0; x < picture_.width(); ++x) {
        const float v = picture_.value(x, y, is_grey ? 0 : c);
        planes[x] = is_srgb_ ? static_cast<float>(linear_from_srgb(v)) : v;
      }
    }
  }

  const Image& picture_;
  bool is_srgb_, has_alpha_;
  ChannelOffsets offsets_;
  std::size_t width_, stride_;
};

// From `from` texels to `to`, along one axis.
AxisMeans axis_means(int from, int to) {
  AxisMeans means;
  means.count = from == to ? 1 : from - 2 * to + 2;
  for (AlignedVector<float>& weights : means.weights)
    weights.resize(plane_stride(static_cast<std::size_t>(to)), 0);
  for (int i = 0; i < to; ++i) {
    // An odd size is 2 to + 1: texel i covers [i from/to, (i + 1) from/to). Guthe and Heckbert, Non-power-of-two
    // mipmapping, 2005.
    const auto n = static_cast<float>(from);
    const auto m = static_cast<float>(to);
    const auto k = static_cast<float>(i);
    std::array<float, 3> weights = {(m - k) / n, m / n, (k + 1) / n};
    if (means.count == 1) weights = {1, 0, 0};
    if (means.count == 2) weights = {0.5F, 0.5F, 0};
    for (std::size_t j = 0; j < 3; ++j) means.weights[j][static_cast<std::size_t>(i)] = weights[j];
  }
  return means;
}

// Every row goes down the chain as soon as it is there, so that all levels are made while the rows they come from are
// in cache, and no level is ever held as floats.
class Builder {
 public:
  Builder(const Image& picture, MipUse use, InstructionSet set)
      : picture_(picture),
        use_(use),
        shrink_row_(shrink_row_for(set)),
        encode_colour_(encode_colour_for(set)),
        encode_data_(encode_data_for(set)),
        encode_alpha_(encode_alpha_for(set)) {
    chain_.format = format();
    lay_out();
    if (chain_.format == TexelFormat::wide) {
      chain_.wide.resize(std::size_t{chain_.texel_count} * 3);
    } else {
      chain_.texels.resize(chain_.texel_count);
    }
    if (use == MipUse::colour_with_alpha && picture.has_alpha())
      chain_.alpha.resize(chain_.texel_count + 3, 0);
    has_alpha_ = chain_.format == TexelFormat::data || !chain_.alpha.empty();
    const std::size_t widest = plane_stride(static_cast<std::size_t>(picture.width()));
    texels_.resize(widest);
    alpha_.resize(widest);
    make_stages();
  }

  MipChain build() {
    const bool is_srgb = use_ != MipUse::data && picture_.transfer() == Transfer::srgb;
    const RowReader reader(picture_, is_srgb, has_alpha_);
    for (int y = 0; y < picture_.height(); ++y) {
      float* row = row_of(0, y);
      reader.read(y, row);
      add_row(0, y, row);
    }
    return std::move(chain_);
  }

 private:
  // A level while it is made: the last rows of it, and how they become the next level's.
  struct Stage {
    std::size_t row_stride = 0;
    AlignedVector<float> rows;  // row y at y % kRows
    AxisMeans across, down;     // to the next level; without a count where there is none
    int next_row = 0;           // the next level's row that is not made yet
  };
  static constexpr int kRows = 3;

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

  void make_stages() {
    stages_.resize(static_cast<std::size_t>(chain_.level_count));
    for (std::size_t i = 0; i < stages_.size(); ++i) {
      const MipLevel& level = chain_.levels[i];
      stages_[i].row_stride = plane_stride(static_cast<std::size_t>(level.width));
      stages_[i].rows.resize(kRows * planes() * stages_[i].row_stride, 0);
      if (i + 1 == stages_.size()) continue;
      stages_[i].across = axis_means(level.width, chain_.levels[i + 1].width);
      stages_[i].down = axis_means(level.height, chain_.levels[i + 1].height);
    }
  }

  [[nodiscard]] std::size_t planes() const { return has_alpha_ ? 4 : 3; }

  float* row_of(std::size_t level, int y) {
    Stage& stage = stages_[level];
    return stage.rows.data() + static_cast<std::size_t>(y % kRows) * planes() * stage.row_stride;
  }

  // Stores the row, and makes the next level's row where this was the last one it needs.
  void add_row(std::size_t level, int y, const float* row) {
    store(chain_.levels[level], y, row);
    Stage& stage = stages_[level];
    if (stage.down.count == 0 || y != 2 * stage.next_row + stage.down.count - 1) return;
    const int to_y = stage.next_row++;
    float* to = row_of(level + 1, to_y);
    ShrinkTask task = {static_cast<int>(planes()),
                       {},
                       {},
                       stage.down.count,
                       stage.row_stride,
                       &stage.across,
                       to,
                       static_cast<std::size_t>(chain_.levels[level + 1].width)};
    for (int j = 0; j < stage.down.count; ++j) {
      const auto k = static_cast<std::size_t>(j);
      task.rows[k] = row_of(level, 2 * to_y + j);
      task.row_weights[k] = stage.down.weights[k][static_cast<std::size_t>(to_y)];
    }
    shrink_row_(task);
    add_row(level + 1, to_y, to);
  }

  void store(const MipLevel& level, int y, const float* row) {
    const auto width = static_cast<std::size_t>(level.width);
    const std::size_t first = level.first + static_cast<std::size_t>(y) * width;
    const bool is_full_size = level.first == 0;
    if (chain_.format == TexelFormat::wide) {
      for (std::size_t c = 0; c < 3; ++c)
        std::copy_n(row + c * plane_stride(width), width,
                    chain_.wide.data() + chain_.texel_count * c + first);
    } else if (is_full_size) {
      store_codes(y, chain_.texels.data() + first);
    } else {
      (chain_.format == TexelFormat::colour ? encode_colour_ : encode_data_)(row, width, texels_.data());
      std::copy_n(texels_.data(), width, chain_.texels.data() + first);
    }
    if (chain_.alpha.empty()) return;
    encode_alpha_(row + 3 * plane_stride(width), width, alpha_.data());
    std::copy_n(alpha_.data(), width, chain_.alpha.data() + first);
  }

  // At full size 8-bit codes need no floats in between.
  void store_codes(int y, std::uint32_t* to) const {
    const bool is_data = chain_.format == TexelFormat::data;
    const CodeTexels& texels = is_data ? data_texels() : colour_texels();
    const ChannelOffsets offsets(picture_);
    const auto width = static_cast<std::size_t>(picture_.width());
    const auto* code = reinterpret_cast<const std::uint8_t*>(row_bytes(picture_, y).data());
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint8_t* at = code + x * offsets.step;
      to[x] = texels[0][at[0]] | texels[1][at[offsets.green]] | texels[2][at[offsets.blue]];
    }
    if (!is_data) return;
    const std::uint8_t* alpha = code + offsets.step - 1;
    for (std::size_t x = 0; x < width; ++x)
      to[x] |= texels[3][picture_.has_alpha() ? alpha[x * offsets.step] : 255];
  }

  const Image& picture_;
  MipUse use_;
  ShrinkRow shrink_row_;
  EncodeTexels encode_colour_, encode_data_;
  EncodeAlpha encode_alpha_;
  MipChain chain_;
  bool has_alpha_ = false;
  std::vector<Stage> stages_;
  AlignedVector<std::uint32_t> texels_;  // a row, whole vectors
  AlignedVector<std::uint8_t> alpha_;
};

}  // namespace

MipChain make_mip_chain(const Image& picture, MipUse use, InstructionSet set) {
  return Builder(picture, use, set).build();
}

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
  return {square(static_cast<float>(t >> 21U) / kLargestRedGreen),
          square(static_cast<float>(t >> 10U & 2047U) / kLargestRedGreen),
          square(static_cast<float>(t & 1023U) / kLargestBlue), alpha};
}

}  // namespace laterna::image
