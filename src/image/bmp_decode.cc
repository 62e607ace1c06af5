// Windows and OS/2 bitmaps: 1, 4, 8 bits with a palette, plain or run-length encoded, and 16, 24, 32 bits.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <vector>

#include "image/byte_reader.h"
#include "image/decoder.h"
#include "image/image_rows.h"

namespace laterna::image {
namespace {

constexpr std::size_t kFileHeaderSize = 14;

// A run of 255 pixels takes two bytes. Ends of rows and jumps skip more; a picture 8192 pixels wide whose rows are all
// empty is still read.
constexpr std::int64_t kMostPixelsPerByte = 4096;

enum Compression : std::uint32_t { kNone = 0, kRle8 = 1, kRle4 = 2, kBitFields = 3, kAlphaBitFields = 6 };

// One channel of a 16- or 32-bit pixel.
struct Field {
  std::uint32_t mask = 0;

  [[nodiscard]] bool is_contiguous() const { return ((mask >> shift()) & ((mask >> shift()) + 1)) == 0; }
  [[nodiscard]] std::uint8_t to_8_bits(std::uint32_t pixel) const {
    const std::uint64_t largest = mask >> shift();
    const std::uint64_t value = (pixel & mask) >> shift();
    return static_cast<std::uint8_t>((value * 510 + largest) / (2 * largest));
  }

 private:
  [[nodiscard]] int shift() const { return mask == 0 ? 0 : std::countr_zero(mask); }
};

struct BmpHeader {
  std::int64_t width = 0, height = 0;
  bool top_down = false;
  int bits = 0;
  std::uint32_t compression = kNone;
  std::uint32_t palette_size = 0, palette_entry_bytes = 4;
  std::size_t palette_position = 0, pixels_position = 0;
  std::array<Field, 4> fields = {};  // red, green, blue, alpha

  [[nodiscard]] bool has_palette() const { return bits <= 8; }
  [[nodiscard]] int channels() const { return fields[3].mask != 0 ? 4 : 3; }
  [[nodiscard]] std::size_t packed_row_bytes() const {
    return (static_cast<std::size_t>(width) * static_cast<std::size_t>(bits) + 7) / 8;
  }
  [[nodiscard]] std::size_t padded_row_bytes() const { return (packed_row_bytes() + 3) / 4 * 4; }
};

std::string describe(std::uint32_t compression) {
  constexpr std::array<std::string_view, 7> kNames = {"none", "RLE8", "RLE4",      "bit fields",
                                                      "JPEG", "PNG",  "bit fields"};
  const std::string number = std::to_string(compression);
  return compression < kNames.size() ? number + " (" + std::string(kNames[compression]) + ")" : number;
}

// Which compressions each depth may have.
bool is_allowed(int bits, std::uint32_t compression) {
  switch (compression) {
    case kNone:
      return true;
    case kRle8:
      return bits == 8;
    case kRle4:
      return bits == 4;
    case kBitFields:
    case kAlphaBitFields:
      return bits == 16 || bits == 32;
    default:
      return false;
  }
}

void read_core_header(ByteReader& in, BmpHeader& header) {
  header.width = in.u16_le();
  header.height = in.u16_le();
  in.skip(2);  // planes
  header.bits = in.u16_le();
  header.palette_entry_bytes = 3;
}

void read_info_header(ByteReader& in, std::uint32_t header_size, BmpHeader& header) {
  header.width = in.i32_le();
  header.height = in.i32_le();
  header.top_down = header.height < 0;
  header.height = std::abs(header.height);
  in.skip(2);  // planes
  header.bits = in.u16_le();
  header.compression = in.u32_le();
  in.skip(12);  // size of the pixels, pixels per metre
  header.palette_size = in.u32_le();
  in.skip(4);  // important colours
  // The masks are part of the longer headers and follow the short one.
  const bool has_masks = header.compression == kBitFields || header.compression == kAlphaBitFields;
  if (!has_masks) return;
  const bool has_alpha_mask = header_size >= 56 || header.compression == kAlphaBitFields;
  for (std::size_t i = 0; i < (has_alpha_mask ? 4U : 3U); ++i) header.fields[i].mask = in.u32_le();
}

void set_default_fields(BmpHeader& header) {
  if (header.compression != kNone) return;
  // The fourth byte of a 32-bit pixel is reserved unless a mask says that it is alpha.
  if (header.bits == 16) header.fields = {Field{0x7C00}, Field{0x03E0}, Field{0x001F}, Field{}};
  if (header.bits == 32) header.fields = {Field{0xFF0000}, Field{0x00FF00}, Field{0x0000FF}, Field{}};
}

std::string find_fault(const BmpHeader& header) {
  constexpr std::array kDepths = {1, 4, 8, 16, 24, 32};
  if (std::find(kDepths.begin(), kDepths.end(), header.bits) == kDepths.end()) {
    return "expected 1, 4, 8, 16, 24 or 32 bits per pixel, found " + std::to_string(header.bits);
  }
  if (!is_allowed(header.bits, header.compression)) {
    return "compression " + describe(header.compression) + " is not read at " + std::to_string(header.bits) +
           " bits per pixel";
  }
  if (header.bits != 16 && header.bits != 32) return {};
  for (const Field& field : header.fields) {
    if (!field.is_contiguous()) return "a colour mask has gaps";
  }
  if (header.fields[0].mask == 0 || header.fields[1].mask == 0 || header.fields[2].mask == 0) {
    return "a colour mask is empty";
  }
  return {};
}

Result<BmpHeader> parse_header(const EncodedPicture& encoded) {
  ByteReader in(encoded.bytes);
  in.skip(10);  // signature, size of the file, reserved
  BmpHeader header;
  header.pixels_position = in.u32_le();
  const std::uint32_t header_size = in.u32_le();
  constexpr std::array<std::uint32_t, 7> kSizes = {12, 40, 52, 56, 64, 108, 124};
  if (!in.ran_out() && std::find(kSizes.begin(), kSizes.end(), header_size) == kSizes.end()) {
    return unreadable(
        encoded, at_byte(kFileHeaderSize),
        "expected a header of 12, 40, 52, 56, 64, 108 or 124 bytes, found " + std::to_string(header_size));
  }
  if (header_size == 12) {
    read_core_header(in, header);
  } else {
    read_info_header(in, header_size, header);
  }
  if (in.ran_out()) return ends_early(encoded, "the header");
  set_default_fields(header);
  if (std::string fault = find_fault(header); !fault.empty()) {
    return unreadable(encoded, at_byte(kFileHeaderSize), std::move(fault));
  }
  header.palette_position = std::max(in.position(), kFileHeaderSize + header_size);
  if (header.has_palette()) {
    const std::uint32_t all = 1U << header.bits;
    header.palette_size = header.palette_size == 0 ? all : std::min(header.palette_size, all);
  }
  if (header.pixels_position < header.palette_position) {
    return unreadable(
        encoded, "byte 10",
        "the pixels begin at byte " + std::to_string(header.pixels_position) + ", inside the header");
  }
  return header;
}

using Colour = std::array<std::uint8_t, 3>;

std::vector<Colour> read_palette(const EncodedPicture& encoded, const BmpHeader& header) {
  ByteReader in(encoded.bytes);
  in.seek(header.palette_position);
  // A palette may be shorter than the depth allows: then the pixels begin where it ends.
  const std::size_t room = (header.pixels_position - header.palette_position) / header.palette_entry_bytes;
  std::vector<Colour> palette(std::min<std::size_t>(header.palette_size, room));
  for (Colour& colour : palette) {
    for (std::size_t i = 3; i-- > 0;) colour[i] = in.u8();  // blue, green, red
    in.skip(header.palette_entry_bytes - 3);
  }
  return palette;
}

std::uint8_t index_at(std::span<const std::byte> row, std::size_t x, int bits) {
  const std::size_t bit = x * static_cast<std::size_t>(bits);
  const auto byte = std::to_integer<unsigned>(row[bit / 8]);
  return static_cast<std::uint8_t>((byte >> (8 - static_cast<std::size_t>(bits) - bit % 8)) &
                                   ((1U << bits) - 1));
}

// Palette indices, in the file's order of rows; none where the file ends early.
using Indices = std::vector<std::uint8_t>;

// The next row of pixels. The padding of the last row may be missing.
std::span<const std::byte> take_row(ByteReader& in, const BmpHeader& header) {
  const std::span<const std::byte> row = in.take(header.packed_row_bytes());
  in.skip(std::min(header.padded_row_bytes() - header.packed_row_bytes(), in.remaining()));
  return row;
}

Indices read_packed_indices(ByteReader& in, const BmpHeader& header) {
  const auto width = static_cast<std::size_t>(header.width), height = static_cast<std::size_t>(header.height);
  if (in.remaining() / header.packed_row_bytes() < height) return {};
  Indices indices(width * height);
  for (std::size_t y = 0; y < height; ++y) {
    const std::span<const std::byte> row = take_row(in, header);
    if (in.ran_out()) return {};
    for (std::size_t x = 0; x < width; ++x) indices[y * width + x] = index_at(row, x, header.bits);
  }
  return indices;
}

// Run-length encoding: pairs of (count, value), and (0, escape). Pixels that are skipped have index 0; pixels
// beyond the end of a row, which some encoders write to fill a pair, are dropped.
class RunLengthReader {
 public:
  RunLengthReader(ByteReader& in, const BmpHeader& header)
      : in_(in),
        bits_(header.bits),
        width_(static_cast<std::size_t>(header.width)),
        height_(static_cast<std::size_t>(header.height)),
        indices_(width_ * height_) {}

  Indices read() && {
    while (y_ < height_ && !is_done_) {
      const unsigned count = in_.u8();
      const unsigned value = in_.u8();
      if (count > 0) {
        for (unsigned i = 0; i < count; ++i) put(index_in(value, i));
      } else {
        escape(value);
      }
      if (in_.ran_out()) return {};
    }
    return std::move(indices_);
  }

 private:
  void escape(unsigned code) {
    if (code == 0) {  // end of the row
      x_ = 0;
      ++y_;
    } else if (code == 1) {
      is_done_ = true;
    } else if (code == 2) {  // jump
      x_ += in_.u8();
      y_ += in_.u8();
    } else {
      literal(code);
    }
  }

  // `count` pixels as they are, padded to whole 16-bit words.
  void literal(unsigned count) {
    const std::size_t bytes = (count * static_cast<unsigned>(bits_) + 7) / 8;
    const std::span<const std::byte> packed = in_.take(bytes);
    if (packed.empty()) return;
    for (unsigned i = 0; i < count; ++i) put(index_at(packed, i, bits_));
    in_.skip(bytes % 2);
  }

  // A run of 4-bit indices alternates between the two halves of its value.
  [[nodiscard]] std::uint8_t index_in(unsigned value, unsigned i) const {
    if (bits_ == 8) return static_cast<std::uint8_t>(value);
    return static_cast<std::uint8_t>(i % 2 == 0 ? value >> 4 : value & 15);
  }

  void put(std::uint8_t index) {
    if (x_ < width_ && y_ < height_) indices_[y_ * width_ + x_] = index;
    ++x_;
  }

  ByteReader& in_;
  int bits_;
  std::size_t width_, height_;
  std::size_t x_ = 0, y_ = 0;
  bool is_done_ = false;
  Indices indices_;
};

Result<Image> decode_indexed(const EncodedPicture& encoded, const BmpHeader& header, ByteReader& in) {
  const std::vector<Colour> palette = read_palette(encoded, header);
  const Indices indices =
      header.compression == kNone ? read_packed_indices(in, header) : RunLengthReader(in, header).read();
  if (indices.empty()) return ends_early(encoded, "the pixels");
  Image image(static_cast<int>(header.width), static_cast<int>(header.height), 3, PixelType::u8,
              Transfer::srgb);
  std::uint8_t* to = image.values<std::uint8_t>().data();
  for (const std::uint8_t index : indices) {
    if (index >= palette.size()) {
      return unreadable(encoded, {},
                        "a pixel has colour " + std::to_string(index) + " of a palette of " +
                            std::to_string(palette.size()));
    }
    to = std::copy(palette[index].begin(), palette[index].end(), to);
  }
  return image;
}

void convert_row(std::span<const std::byte> from, const BmpHeader& header, std::span<std::byte> to) {
  ByteReader in(from);
  for (std::size_t i = 0; i < to.size(); i += static_cast<std::size_t>(header.channels())) {
    if (header.bits == 24) {
      for (std::size_t c = 3; c-- > 0;) to[i + c] = std::byte{in.u8()};  // blue, green, red
      continue;
    }
    const std::uint32_t pixel = header.bits == 16 ? in.u16_le() : in.u32_le();
    for (std::size_t c = 0; c < static_cast<std::size_t>(header.channels()); ++c) {
      to[i + c] = std::byte{header.fields[c].to_8_bits(pixel)};
    }
  }
}

Result<Image> decode_direct(const EncodedPicture& encoded, const BmpHeader& header, ByteReader& in) {
  if (in.remaining() / header.packed_row_bytes() < static_cast<std::size_t>(header.height)) {
    return ends_early(encoded, "the pixels");
  }
  Image image(static_cast<int>(header.width), static_cast<int>(header.height), header.channels(),
              PixelType::u8, Transfer::srgb);
  for (int y = 0; y < image.height(); ++y) {
    const std::span<const std::byte> row = take_row(in, header);
    if (in.ran_out()) return ends_early(encoded, "the pixels");
    convert_row(row, header, row_bytes(image, y));
  }
  return image;
}

bool recognises(const EncodedPicture& encoded) { return begins_with(encoded.bytes, "BM"); }

Result<ImageHeader> read_header(const EncodedPicture& encoded) {
  const Result<BmpHeader> header = parse_header(encoded);
  if (!header) return tl::unexpected(header.error());
  // Sizes beyond int are beyond the limit too: any number above it will do.
  const auto clamp = [](std::int64_t side) {
    return static_cast<int>(std::min<std::int64_t>(side, INT32_MAX));
  };
  return ImageHeader{.format = {},
                     .width = clamp(header->width),
                     .height = clamp(header->height),
                     .channels = header->channels(),
                     .type = PixelType::u8};
}

Result<Image> decode(const EncodedPicture& encoded, const ImageHeader&) {
  const Result<BmpHeader> header = parse_header(encoded);
  if (!header) return tl::unexpected(header.error());
  ByteReader in(encoded.bytes);
  in.seek(header->pixels_position);
  Result<Image> image =
      header->has_palette() ? decode_indexed(encoded, *header, in) : decode_direct(encoded, *header, in);
  if (image && !header->top_down) flip_rows(*image);
  return image;
}

}  // namespace

const Decoder kBmpDecoder = {"BMP", kMostPixelsPerByte, recognises, read_header, decode};

}  // namespace laterna::image
