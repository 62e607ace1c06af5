#include "image/gif_stream.h"

#include <algorithm>

namespace laterna::image {
namespace {

// The flags of a palette: bit 7 tells that there is one, the lowest three bits its size.
GifPalette read_palette(ByteReader& in, unsigned flags) {
  if ((flags & 0x80) == 0) return {};
  GifPalette palette(std::size_t{2} << (flags & 7));
  for (GifColour& colour : palette) {
    for (std::uint8_t& value : colour) value = in.u8();
  }
  return palette;
}

void skip_sub_blocks(ByteReader& in) {
  while (const std::size_t size = in.u8()) in.skip(size);
}

void read_graphic_control(ByteReader& in, GifFrame& frame) {
  const std::size_t size = in.u8();
  if (size != 4) {
    in.skip(size);
    return;
  }
  const unsigned flags = in.u8();
  frame.delay = in.u16_le();
  const unsigned transparent = in.u8();
  frame.transparent = (flags & 1) != 0 ? std::optional(transparent) : std::nullopt;
  const unsigned disposal = flags >> 2 & 7;
  frame.disposal = disposal == 2   ? GifDisposal::clear
                   : disposal == 3 ? GifDisposal::restore
                                   : GifDisposal::keep;
}

// The bits of the compressed pixels, which come in blocks of at most 255 bytes.
class CodeReader {
 public:
  explicit CodeReader(ByteReader& in) : in_(in) {}

  // −1 at the end of the blocks or of the file.
  int read(unsigned bits) {
    while (bit_count_ < bits) {
      if (left_in_block_ == 0) left_in_block_ = in_.u8();
      if (left_in_block_ == 0) return -1;
      --left_in_block_;
      bits_ |= static_cast<std::uint32_t>(in_.u8()) << bit_count_;
      bit_count_ += 8;
    }
    if (in_.ran_out()) return -1;
    const std::uint32_t code = bits_ & ((1U << bits) - 1);
    bits_ >>= bits;
    bit_count_ -= bits;
    return static_cast<int>(code);
  }

 private:
  ByteReader& in_;
  unsigned left_in_block_ = 0;
  std::uint32_t bits_ = 0;
  unsigned bit_count_ = 0;
};

// Lempel-Ziv-Welch. Every code stands for the string of an earlier code and one more value.
class LzwDecoder {
 public:
  LzwDecoder(ByteReader& in, unsigned root_bits) : in_(in), root_bits_(root_bits), clear_(1U << root_bits) {
    for (unsigned i = 0; i < clear_; ++i)
      strings_[i] = {.prefix = 0, .length = 1, .first = value(i), .last = value(i)};
    clear();
  }

  // Fills `values`, or as much of it as the codes give. False: a code that no encoder writes.
  bool read(std::span<std::uint8_t> values, std::size_t& count) {
    for (count = 0; count < values.size();) {
      const int read = in_.read(code_bits_);
      if (read < 0 || read == static_cast<int>(clear_) + 1) return true;  // the end
      const auto code = static_cast<unsigned>(read);
      if (code == clear_) {
        clear();
        continue;
      }
      if (code > next_ || (code == next_ && !previous_)) return false;
      if (previous_) add(code);
      count += write(code, values.subspan(count));
      previous_ = code;
    }
    return true;
  }

 private:
  static constexpr unsigned kLongestCode = 12;
  struct String {
    std::uint16_t prefix, length;
    std::uint8_t first, last;
  };

  static std::uint8_t value(unsigned i) { return static_cast<std::uint8_t>(i); }

  void clear() {
    code_bits_ = root_bits_ + 1;
    next_ = clear_ + 2;
    previous_.reset();
  }

  // The previous string and the first value of this one. A code not yet in the table is that very string.
  void add(unsigned code) {
    if (next_ == strings_.size()) return;  // full: used as it is until the encoder clears it
    const String& previous = strings_[*previous_];
    strings_[next_] = {.prefix = static_cast<std::uint16_t>(*previous_),
                       .length = static_cast<std::uint16_t>(previous.length + 1),
                       .first = previous.first,
                       .last = code == next_ ? previous.first : strings_[code].first};
    ++next_;
    if (next_ == (1U << code_bits_) && code_bits_ < kLongestCode) ++code_bits_;
  }

  std::size_t write(unsigned code, std::span<std::uint8_t> to) {
    const std::size_t length = strings_[code].length;
    for (std::size_t i = length; i-- > 0; code = strings_[code].prefix) {
      if (i < to.size()) to[i] = strings_[code].last;
    }
    return std::min(length, to.size());
  }

  CodeReader in_;
  unsigned root_bits_, clear_;
  unsigned code_bits_ = 0, next_ = 0;
  std::optional<unsigned> previous_;
  std::array<String, 1U << kLongestCode> strings_ = {};
};

Result<std::vector<std::uint8_t>> read_indices(const EncodedPicture& encoded, const GifFrame& frame,
                                               ByteReader& in) {
  const std::size_t position = in.position();
  const unsigned root_bits = in.u8();
  if (in.ran_out()) return ends_early(encoded, frame.name);
  if (root_bits < 1 || root_bits > 8) {
    return unreadable(encoded, at_byte(position),
                      "expected 1 to 8 bits per value, found " + std::to_string(root_bits));
  }
  std::vector<std::uint8_t> indices(frame.width * frame.height);
  std::size_t count = 0;
  const bool is_valid = LzwDecoder(in, root_bits).read(indices, count);
  if (in.ran_out()) return ends_early(encoded, frame.name);
  if (!is_valid) return unreadable(encoded, at_byte(in.position()), "the compressed pixels are damaged");
  if (count < indices.size()) {
    return unreadable(encoded, at_byte(in.position()),
                      frame.name + " ends after " + std::to_string(count) + " of " +
                          std::to_string(indices.size()) + " pixels");
  }
  return indices;
}

// Interlaced frames hold every eighth row, then those between in three finer passes.
std::vector<std::size_t> row_order(const GifFrame& frame) {
  struct Pass {
    std::size_t first, step;
  };
  static constexpr std::array<Pass, 4> kInterlaced = {Pass{0, 8}, Pass{4, 8}, Pass{2, 4}, Pass{1, 2}};
  static constexpr std::array<Pass, 1> kSequential = {Pass{0, 1}};
  const std::span<const Pass> passes =
      frame.is_interlaced ? std::span<const Pass>(kInterlaced) : std::span<const Pass>(kSequential);
  std::vector<std::size_t> order;
  for (const Pass& pass : passes) {
    for (std::size_t y = pass.first; y < frame.height; y += pass.step) order.push_back(y);
  }
  return order;
}

}  // namespace

GifCanvas read_gif_canvas(ByteReader& in) {
  in.skip(6);  // signature
  GifCanvas canvas{in.u16_le(), in.u16_le(), {}};
  const unsigned flags = in.u8();
  in.skip(2);  // background colour, aspect of a pixel
  canvas.palette = read_palette(in, flags);
  return canvas;
}

Result<std::optional<GifFrame>> read_gif_frame(const EncodedPicture& encoded, const GifCanvas& canvas,
                                               std::size_t number, ByteReader& in) {
  constexpr unsigned kExtension = 0x21, kGraphicControl = 0xF9, kImage = 0x2C, kTrailer = 0x3B;
  GifFrame frame;
  frame.name = number == 0 ? "the first frame" : "frame " + std::to_string(number);
  for (;;) {
    const std::size_t position = in.position();
    const unsigned block = in.u8();
    if (in.ran_out()) return ends_early(encoded, "the blocks before " + frame.name);
    if (block == kImage) break;
    if (block == kTrailer && number > 0) return std::nullopt;
    if (block != kExtension) {
      return unreadable(encoded, at_byte(position), "expected a frame, found block " + std::to_string(block));
    }
    if (in.u8() == kGraphicControl) read_graphic_control(in, frame);
    skip_sub_blocks(in);
  }
  frame.left = in.u16_le();
  frame.top = in.u16_le();
  frame.width = in.u16_le();
  frame.height = in.u16_le();
  const unsigned flags = in.u8();
  frame.is_interlaced = (flags & 0x40) != 0;
  frame.palette = read_palette(in, flags);
  if (in.ran_out()) return ends_early(encoded, frame.name);
  if (frame.palette.empty()) frame.palette = canvas.palette;
  if (frame.palette.empty())
    return unreadable(encoded, at_byte(in.position()), frame.name + " has no palette");
  if (frame.left + frame.width > canvas.width || frame.top + frame.height > canvas.height) {
    return unreadable(encoded, at_byte(in.position()), frame.name + " is not inside the picture");
  }
  return frame;
}

void skip_gif_pixels(ByteReader& in) {
  in.skip(1);  // bits per value
  skip_sub_blocks(in);
}

Result<void> draw_gif_frame(const EncodedPicture& encoded, const GifCanvas& canvas, const GifFrame& frame,
                            ByteReader& in, std::span<std::uint8_t> rgba) {
  const Result<std::vector<std::uint8_t>> indices = read_indices(encoded, frame, in);
  if (!indices) return tl::unexpected(indices.error());
  auto index = indices->begin();
  for (const std::size_t y : row_order(frame)) {
    std::size_t at = ((frame.top + y) * canvas.width + frame.left) * 4;
    for (std::size_t x = 0; x < frame.width; ++x, ++index, at += 4) {
      if (*index == frame.transparent) continue;
      if (*index >= frame.palette.size()) {
        return unreadable(encoded, {},
                          "a pixel has colour " + std::to_string(*index) + " of a palette of " +
                              std::to_string(frame.palette.size()));
      }
      const GifColour& colour = frame.palette[*index];
      std::copy(colour.begin(), colour.end(), rgba.begin() + static_cast<std::ptrdiff_t>(at));
      rgba[at + 3] = 255;
    }
  }
  return {};
}

}  // namespace laterna::image
