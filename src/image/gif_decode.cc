// GIF87a and GIF89a: the first frame on the whole canvas, as RGBA. What the frame leaves free is transparent.
#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "image/byte_reader.h"
#include "image/decoder.h"

namespace laterna::image {
namespace {

// A code of 12 bits stands for at most 4096 pixels.
constexpr std::int64_t kMostPixelsPerByte = 4096;

using Colour = std::array<std::uint8_t, 3>;
using Palette = std::vector<Colour>;

struct Frame {
  std::size_t left = 0, top = 0, width = 0, height = 0;
  bool is_interlaced = false;
  std::optional<unsigned> transparent;
  Palette palette;
};

// The flags of a palette: bit 7 tells that there is one, the lowest three bits its size.
Palette read_palette(ByteReader& in, unsigned flags) {
  if ((flags & 0x80) == 0) return {};
  Palette palette(std::size_t{2} << (flags & 7));
  for (Colour& colour : palette) {
    for (std::uint8_t& value : colour) value = in.u8();
  }
  return palette;
}

void skip_sub_blocks(ByteReader& in) {
  while (const std::size_t size = in.u8()) in.skip(size);
}

std::optional<unsigned> read_graphic_control(ByteReader& in) {
  const std::size_t size = in.u8();
  if (size != 4) {
    in.skip(size);
    return std::nullopt;
  }
  const unsigned flags = in.u8();
  in.skip(2);  // delay
  const unsigned transparent = in.u8();
  return (flags & 1) != 0 ? std::optional(transparent) : std::nullopt;
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

struct Canvas {
  std::size_t width, height;
  Palette palette;
};

Canvas read_canvas(ByteReader& in) {
  in.skip(6);  // signature
  Canvas canvas{in.u16_le(), in.u16_le(), {}};
  const unsigned flags = in.u8();
  in.skip(2);  // background colour, aspect of a pixel
  canvas.palette = read_palette(in, flags);
  return canvas;
}

Result<Frame> read_frame(const EncodedPicture& encoded, const Canvas& canvas, ByteReader& in) {
  constexpr unsigned kExtension = 0x21, kGraphicControl = 0xF9, kImage = 0x2C;
  Frame frame;
  for (;;) {
    const std::size_t position = in.position();
    const unsigned block = in.u8();
    if (in.ran_out()) return ends_early(encoded, "the blocks before the first frame");
    if (block == kImage) break;
    if (block != kExtension) {
      return unreadable(encoded, at_byte(position), "expected a frame, found block " + std::to_string(block));
    }
    if (in.u8() == kGraphicControl) frame.transparent = read_graphic_control(in);
    skip_sub_blocks(in);
  }
  frame.left = in.u16_le();
  frame.top = in.u16_le();
  frame.width = in.u16_le();
  frame.height = in.u16_le();
  const unsigned flags = in.u8();
  frame.is_interlaced = (flags & 0x40) != 0;
  frame.palette = read_palette(in, flags);
  if (in.ran_out()) return ends_early(encoded, "the first frame");
  if (frame.palette.empty()) frame.palette = canvas.palette;
  if (frame.palette.empty())
    return unreadable(encoded, at_byte(in.position()), "the first frame has no palette");
  if (frame.left + frame.width > canvas.width || frame.top + frame.height > canvas.height) {
    return unreadable(encoded, at_byte(in.position()), "the first frame is not inside the picture");
  }
  return frame;
}

Result<std::vector<std::uint8_t>> read_indices(const EncodedPicture& encoded, const Frame& frame,
                                               ByteReader& in) {
  const std::size_t position = in.position();
  const unsigned root_bits = in.u8();
  if (in.ran_out()) return ends_early(encoded, "the first frame");
  if (root_bits < 1 || root_bits > 8) {
    return unreadable(encoded, at_byte(position),
                      "expected 1 to 8 bits per value, found " + std::to_string(root_bits));
  }
  std::vector<std::uint8_t> indices(frame.width * frame.height);
  std::size_t count = 0;
  const bool is_valid = LzwDecoder(in, root_bits).read(indices, count);
  if (in.ran_out()) return ends_early(encoded, "the first frame");
  if (!is_valid) return unreadable(encoded, at_byte(in.position()), "the compressed pixels are damaged");
  if (count < indices.size()) {
    return unreadable(encoded, at_byte(in.position()),
                      "the first frame ends after " + std::to_string(count) + " of " +
                          std::to_string(indices.size()) + " pixels");
  }
  return indices;
}

// Interlaced frames hold every eighth row, then those between in three finer passes.
std::vector<std::size_t> row_order(const Frame& frame) {
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

bool recognises(const EncodedPicture& encoded) {
  return begins_with(encoded.bytes, "GIF87a") || begins_with(encoded.bytes, "GIF89a");
}

Result<ImageHeader> read_header(const EncodedPicture& encoded) {
  ByteReader in(encoded.bytes);
  const Canvas canvas = read_canvas(in);
  if (in.ran_out()) return ends_early(encoded, "the header");
  return ImageHeader{.format = {},
                     .width = static_cast<int>(canvas.width),
                     .height = static_cast<int>(canvas.height),
                     .channels = 4,
                     .type = PixelType::u8};
}

Result<Image> decode(const EncodedPicture& encoded, const ImageHeader& header) {
  ByteReader in(encoded.bytes);
  const Canvas canvas = read_canvas(in);
  const Result<Frame> frame = read_frame(encoded, canvas, in);
  if (!frame) return tl::unexpected(frame.error());
  const Result<std::vector<std::uint8_t>> indices = read_indices(encoded, *frame, in);
  if (!indices) return tl::unexpected(indices.error());

  Image image(header.width, header.height, header.channels, header.type, Transfer::srgb);
  const std::span<std::uint8_t> values = image.values<std::uint8_t>();
  auto index = indices->begin();
  for (const std::size_t y : row_order(*frame)) {
    std::size_t at = ((frame->top + y) * canvas.width + frame->left) * 4;
    for (std::size_t x = 0; x < frame->width; ++x, ++index, at += 4) {
      if (*index == frame->transparent) continue;
      if (*index >= frame->palette.size()) {
        return unreadable(encoded, {},
                          "a pixel has colour " + std::to_string(*index) + " of a palette of " +
                              std::to_string(frame->palette.size()));
      }
      const Colour& colour = frame->palette[*index];
      std::copy(colour.begin(), colour.end(), values.begin() + static_cast<std::ptrdiff_t>(at));
      values[at + 3] = 255;
    }
  }
  return image;
}

}  // namespace

const Decoder kGifDecoder = {"GIF", kMostPixelsPerByte, recognises, read_header, decode};

}  // namespace laterna::image
