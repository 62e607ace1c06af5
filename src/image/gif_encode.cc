#include "image/gif_encode.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "image/palette.h"

namespace laterna::image {
namespace {

using Bytes = std::vector<std::byte>;

void append(Bytes& bytes, std::string_view text) {
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
}
void append_u8(Bytes& bytes, unsigned value) { bytes.push_back(static_cast<std::byte>(value)); }
void append_u16(Bytes& bytes, unsigned value) {
  append_u8(bytes, value & 255U);
  append_u8(bytes, value >> 8U);
}

// Codes of growing width, packed from the lowest bit on, in blocks of at most 255 bytes.
class CodeBlocks {
 public:
  explicit CodeBlocks(Bytes& bytes) : bytes_(bytes) {}

  void put(unsigned code, unsigned width) {
    held_ |= static_cast<std::uint64_t>(code) << held_bits_;
    held_bits_ += width;
    while (held_bits_ >= 8) put_byte();
  }
  void end() {
    if (held_bits_ > 0) put_byte();
    flush();
    append_u8(bytes_, 0);
  }

 private:
  void put_byte() {
    block_.push_back(static_cast<std::byte>(held_ & 255U));
    held_ >>= 8U;
    held_bits_ -= std::min(held_bits_, 8U);
    if (block_.size() == 255) flush();
  }
  void flush() {
    if (block_.empty()) return;
    append_u8(bytes_, static_cast<unsigned>(block_.size()));
    bytes_.insert(bytes_.end(), block_.begin(), block_.end());
    block_.clear();
  }

  Bytes& bytes_;
  Bytes block_;
  std::uint64_t held_ = 0;
  unsigned held_bits_ = 0;
};

// GIF's variant of Lempel, Ziv and Welch's compression: GIF89a specification, appendix F.
class Compressor {
 public:
  Compressor() : longer_(kCodes * 256) {}

  // `bits` of each pixel, 2…8.
  void append(std::span<const std::uint8_t> pixels, unsigned bits, Bytes& bytes) {
    append_u8(bytes, bits);
    CodeBlocks out(bytes);
    const unsigned clear = 1U << bits, end = clear + 1;
    unsigned width = bits + 1, next = end + 1;
    std::fill(longer_.begin(), longer_.end(), kNone);
    out.put(clear, width);
    unsigned prefix = pixels.front();
    for (const std::uint8_t pixel : pixels.subspan(1)) {
      std::uint16_t& longer = longer_[std::size_t{prefix} * 256 + pixel];
      if (longer != kNone) {
        prefix = longer;
        continue;
      }
      out.put(prefix, width);
      prefix = pixel;
      if (next == kCodes) {
        out.put(clear, width);
        std::fill(longer_.begin(), longer_.end(), kNone);
        width = bits + 1;
        next = end + 1;
        continue;
      }
      // A reader knows a code one code later than we do.
      if (next == 1U << width) ++width;
      longer = static_cast<std::uint16_t>(next++);
    }
    out.put(prefix, width);
    if (next == 1U << width && width < 12) ++width;
    out.put(end, width);
    out.end();
  }

 private:
  static constexpr unsigned kCodes = 4096;
  static constexpr std::uint16_t kNone = 0;  // no code of a string of two

  std::vector<std::uint16_t> longer_;  // of a code's string, continued by a pixel
};

struct Region {
  int left, top, width, height;
};

// Where two frames differ; one pixel, where they do not.
Region difference(const Image& before, const Image& now) {
  const std::uint8_t *a = before.values<std::uint8_t>().data(), *b = now.values<std::uint8_t>().data();
  const int width = now.width();
  int left = width, right = -1, top = now.height(), bottom = -1;
  for (int y = 0; y < now.height(); ++y) {
    for (int x = 0; x < width; ++x, a += 3, b += 3) {
      if (std::equal(a, a + 3, b)) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = y;
    }
  }
  if (right < 0) return {0, 0, 1, 1};
  return {left, top, right - left + 1, bottom - top + 1};
}

Image part_of(const Image& frame, const Region& region) {
  Image part(region.width, region.height, 3, PixelType::u8, frame.transfer());
  const auto size = static_cast<std::ptrdiff_t>(region.width) * 3;
  for (int y = 0; y < region.height; ++y) {
    const auto from = (static_cast<std::ptrdiff_t>(y + region.top) * frame.width() + region.left) * 3;
    std::copy_n(frame.values<std::uint8_t>().begin() + from, size,
                part.values<std::uint8_t>().begin() + y * size);
  }
  return part;
}

class GifEncoder final : public FilmEncoder {
 public:
  GifEncoder(OutputFile& output, int width, int height, const VideoRate& rate)
      : output_(output), width_(width), height_(height), rate_(rate) {}

  Result<void> write(const Image& frame) override {
    Bytes bytes;
    if (frames_ == 0) append_header(bytes);
    const Region region = frames_ == 0 ? Region{0, 0, width_, height_} : difference(before_, frame);
    const PalettePicture picture = reduce_colours(part_of(frame, region));
    append_frame(region, picture, bytes);
    before_ = frame;
    ++frames_;
    return output_.write(bytes);
  }

  Result<void> finish() override {
    Bytes trailer;
    append(trailer, ";");
    return output_.write(trailer);
  }

 private:
  void append_header(Bytes& bytes) const {
    append(bytes, "GIF89a");
    append_u16(bytes, static_cast<unsigned>(width_));
    append_u16(bytes, static_cast<unsigned>(height_));
    append(bytes, std::string_view("\x70\0\0", 3));  // 8 bits of each colour, no table for all frames
    append(bytes, std::string_view("!\xFF\x0BNETSCAPE2.0\x03\x01\0\0\0", 19));  // again and again
  }

  // When frame k begins, in hundredths of a second.
  [[nodiscard]] std::int64_t begin_of(std::int64_t k) const {
    return (k * 200 * rate_.denominator + rate_.numerator) / (std::int64_t{2} * rate_.numerator);
  }

  void append_frame(const Region& region, const PalettePicture& picture, Bytes& bytes) {
    unsigned bits = 2;
    while (picture.colours.size() > std::size_t{1} << bits) ++bits;
    append(bytes, std::string_view("!\xF9\x04\x04", 4));  // the frame stays under the next one
    append_u16(bytes, static_cast<unsigned>(
                          std::min<std::int64_t>(begin_of(frames_ + 1) - begin_of(frames_), 65535)));
    append(bytes, std::string_view("\0\0,", 3));
    for (const int value : {region.left, region.top, region.width, region.height})
      append_u16(bytes, static_cast<unsigned>(value));
    append_u8(bytes, 0x80U | (bits - 1));  // a table of 2^bits colours of its own
    for (std::size_t i = 0; i < std::size_t{1} << bits; ++i) {
      for (const std::uint8_t value : i < picture.colours.size() ? picture.colours[i] : Rgb{})
        append_u8(bytes, value);
    }
    compressor_.append(picture.pixels, bits, bytes);
  }

  OutputFile& output_;
  int width_, height_;
  VideoRate rate_;
  Image before_;
  std::int64_t frames_ = 0;
  Compressor compressor_;
};

}  // namespace

std::unique_ptr<FilmEncoder> make_gif_encoder(OutputFile& output, int width, int height,
                                              const VideoRate& rate) {
  return std::make_unique<GifEncoder>(output, width, height, rate);
}

}  // namespace laterna::image
