// PBM, PGM and PPM, as text (P1, P2, P3) and as bytes (P4, P5, P6). Values are scaled so that the file's own
// maximum is white.
#include <algorithm>

#include "image/byte_reader.h"
#include "image/decoder.h"
#include "image/image_rows.h"
#include "image/netpbm_header.h"

namespace laterna::image {
namespace {

// P4 holds eight pixels in a byte.
constexpr std::int64_t kMostPixelsPerByte = 8;
constexpr int kLargestMaximum = 65535;

struct NetpbmHeader {
  int kind = 0;  // the digit after P
  int width = 0, height = 0;
  int maximum = 1;
  std::size_t pixels_position = 0;

  [[nodiscard]] bool is_text() const { return kind <= 3; }
  [[nodiscard]] bool is_bitmap() const { return kind == 1 || kind == 4; }
  [[nodiscard]] int channels() const { return kind == 3 || kind == 6 ? 3 : 1; }
  [[nodiscard]] bool is_wide() const { return maximum > 255; }
};

Result<NetpbmHeader> parse_header(const EncodedPicture& encoded) {
  ByteReader in(encoded.bytes);
  in.skip(1);
  NetpbmHeader header;
  header.kind = in.u8() - '0';
  for (int* side : {&header.width, &header.height}) {
    const std::size_t position = in.position();
    *side = read_netpbm_number(in);
    if (in.ran_out()) return ends_early(encoded, "the header");
    if (*side < 0) return unreadable(encoded, at_byte(position), "expected a width and a height in pixels");
  }
  const std::size_t position = in.position();
  if (!header.is_bitmap()) header.maximum = read_netpbm_number(in);
  if (in.ran_out()) return ends_early(encoded, "the header");
  if (header.maximum < 1 || header.maximum > kLargestMaximum) {
    return unreadable(encoded, at_byte(position),
                      "expected a maximum value from 1 to " + std::to_string(kLargestMaximum));
  }
  header.pixels_position = in.position();
  return header;
}

// The values of one file, in order. A bitmap's 1 is black.
class ValueReader {
 public:
  ValueReader(const NetpbmHeader& header, std::span<const std::byte> bytes) : header_(header), in_(bytes) {
    in_.seek(header.pixels_position);
  }

  [[nodiscard]] const ByteReader& input() const { return in_; }

  // −1: no number; ran out: beyond the end.
  int next() {
    if (header_.kind == 1) return next_text_bit();
    if (header_.is_text()) return read_netpbm_number(in_);
    if (header_.kind == 4) return next_packed_bit();
    if (!header_.is_wide()) return in_.u8();
    const int high = in_.u8();
    return high << 8 | in_.u8();
  }

  // Bytes hold bits of one row only.
  void end_row() { bit_count_ = 0; }

 private:
  // Bits need no white space between them.
  int next_text_bit() {
    int c = in_.u8();
    while (is_netpbm_space(c) && !in_.ran_out()) c = in_.u8();
    return c == '0' ? 1 : c == '1' ? 0 : -1;
  }

  int next_packed_bit() {
    if (bit_count_ == 0) {
      bits_ = in_.u8();
      bit_count_ = 8;
    }
    --bit_count_;
    return 1 - (bits_ >> bit_count_ & 1);
  }

  const NetpbmHeader& header_;
  ByteReader in_;
  int bits_ = 0, bit_count_ = 0;
};

template <class T>
Result<Image> decode_values(const EncodedPicture& encoded, const NetpbmHeader& header, PixelType type) {
  Image image(header.width, header.height, header.channels(), type, Transfer::srgb);
  constexpr unsigned kWhite = static_cast<T>(-1);
  const auto maximum = static_cast<unsigned>(header.maximum);
  const std::span<T> values = image.values<T>();
  const std::size_t row = values.size() / static_cast<std::size_t>(header.height);
  ValueReader reader(header, encoded.bytes);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % row == 0) reader.end_row();
    const std::size_t position = reader.input().position();
    const int value = reader.next();
    if (reader.input().ran_out()) return ends_early(encoded, "the pixels");
    if (value < 0 || value > header.maximum) {
      return unreadable(encoded, at_byte(position),
                        "expected a value from 0 to " + std::to_string(header.maximum));
    }
    values[i] = static_cast<T>((static_cast<unsigned>(value) * kWhite + maximum / 2) / maximum);
  }
  return image;
}

bool recognises(const EncodedPicture& encoded) {
  ByteReader in(encoded.bytes);
  const int p = in.u8(), digit = in.u8(), after = in.u8();
  return p == 'P' && digit >= '1' && digit <= '6' && (is_netpbm_space(after) || after == '#');
}

Result<ImageHeader> read_header(const EncodedPicture& encoded) {
  const Result<NetpbmHeader> header = parse_header(encoded);
  if (!header) return tl::unexpected(header.error());
  return ImageHeader{.format = {},
                     .width = header->width,
                     .height = header->height,
                     .channels = header->channels(),
                     .type = header->is_wide() ? PixelType::u16 : PixelType::u8};
}

Result<Image> decode(const EncodedPicture& encoded, const ImageHeader& expected) {
  const Result<NetpbmHeader> header = parse_header(encoded);
  if (!header) return tl::unexpected(header.error());
  if (header->is_wide()) return decode_values<std::uint16_t>(encoded, *header, expected.type);
  return decode_values<std::uint8_t>(encoded, *header, expected.type);
}

}  // namespace

const Decoder kNetpbmDecoder = {"PNM", kMostPixelsPerByte, recognises, read_header, decode};

}  // namespace laterna::image
