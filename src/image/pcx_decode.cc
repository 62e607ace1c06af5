// ZSoft PCX, the skins of Quake II's models: 8 bits with a palette, and 24 bits in three planes; run-length encoded or plain
// (ZSoft, Technical reference manual, revision 5).
#include <array>
#include <vector>

#include "image/byte_reader.h"
#include "image/decoder.h"
#include "image/file_ending.h"
#include "image/image_rows.h"

namespace laterna::image {
namespace {

constexpr std::size_t kHeaderBytes = 128, kPaletteBytes = 768;
// A run of 63 bytes takes two. Of a line, some may be no pixels.
constexpr std::int64_t kMostPixelsPerByte = 32;

struct PcxHeader {
  bool is_encoded = false;
  int width = 0, height = 0, planes = 0;
  std::size_t bytes_per_line = 0;  // of one plane
};

std::string find_fault(const PcxHeader& header, unsigned version, unsigned encoding, unsigned bits) {
  if (version > 5 || version == 1)
    return "expected version 0, 2, 3, 4 or 5, found " + std::to_string(version);
  if (encoding > 1) return "expected encoding 0 or 1, found " + std::to_string(encoding);
  if (bits != 8 || (header.planes != 1 && header.planes != 3)) {
    return "expected 1 or 3 planes of 8 bits, found " + std::to_string(header.planes) + " of " +
           std::to_string(bits);
  }
  if (header.width > 0 && header.bytes_per_line < static_cast<std::size_t>(header.width)) {
    return "a line of " + std::to_string(header.bytes_per_line) + " bytes cannot hold " +
           std::to_string(header.width) + " pixels";
  }
  return {};
}

Result<PcxHeader> parse_header(const EncodedPicture& encoded) {
  ByteReader in(encoded.bytes);
  if (in.u8() != 0x0A) return unreadable(encoded, "byte 0", "a PCX file begins with 0x0A");
  PcxHeader header;
  const unsigned version = in.u8(), encoding = in.u8(), bits = in.u8();
  const int left = in.u16_le(), top = in.u16_le(), right = in.u16_le(), bottom = in.u16_le();
  header.is_encoded = encoding == 1;
  header.width = right - left + 1;
  header.height = bottom - top + 1;
  in.seek(65);
  header.planes = in.u8();
  header.bytes_per_line = in.u16_le();
  in.seek(kHeaderBytes);
  if (in.ran_out()) return ends_early(encoded, "the header");
  if (std::string fault = find_fault(header, version, encoding, bits); !fault.empty())
    return unreadable(encoded, "byte 1", std::move(fault));
  return header;
}

// All planes of all lines, one after the other; empty where the file ends early. Runs may go on into the next line.
std::vector<std::uint8_t> read_lines(ByteReader& in, const PcxHeader& header) {
  std::vector<std::uint8_t> bytes(header.bytes_per_line * static_cast<std::size_t>(header.planes) *
                                  static_cast<std::size_t>(header.height));
  for (std::size_t at = 0; at < bytes.size();) {
    std::uint8_t value = in.u8();
    unsigned count = 1;
    if (header.is_encoded && value >= 0xC0) {
      count = value & 0x3FU;
      value = in.u8();
    }
    if (in.ran_out()) return {};
    for (; count > 0 && at < bytes.size(); --count) bytes[at++] = value;
  }
  return bytes;
}

// The last 769 bytes: a mark and 256 colours.
std::span<const std::byte> find_palette(const EncodedPicture& encoded) {
  const std::size_t size = encoded.bytes.size();
  if (size < kHeaderBytes + kPaletteBytes + 1) return {};
  const std::span<const std::byte> end = encoded.bytes.last(kPaletteBytes + 1);
  return end[0] == std::byte{0x0C} ? end.subspan(1) : std::span<const std::byte>{};
}

// The format's signature is a single byte, so its name must say it too.
bool recognises(const EncodedPicture& encoded) {
  return has_ending(encoded.name, ".pcx") && begins_with(encoded.bytes, "\x0A");
}

Result<ImageHeader> read_header(const EncodedPicture& encoded) {
  const Result<PcxHeader> header = parse_header(encoded);
  if (!header) return tl::unexpected(header.error());
  return ImageHeader{
      .format = {}, .width = header->width, .height = header->height, .channels = 3, .type = PixelType::u8};
}

Result<Image> decode(const EncodedPicture& encoded, const ImageHeader&) {
  const Result<PcxHeader> header = parse_header(encoded);
  if (!header) return tl::unexpected(header.error());
  const std::span<const std::byte> palette =
      header->planes == 1 ? find_palette(encoded) : std::span<const std::byte>{};
  if (header->planes == 1 && palette.empty())
    return unreadable(encoded, {}, "the file does not end with a palette of 256 colours");
  // The palette is no part of the lines.
  ByteReader in(encoded.bytes.first(encoded.bytes.size() - (palette.empty() ? 0 : kPaletteBytes + 1)));
  in.seek(kHeaderBytes);
  const auto line_bytes = static_cast<std::int64_t>(header->bytes_per_line) * header->planes;
  const bool is_possible =
      line_bytes * header->height / kMostPixelsPerByte <= static_cast<std::int64_t>(in.remaining());
  const std::vector<std::uint8_t> lines = is_possible ? read_lines(in, *header) : std::vector<std::uint8_t>();
  if (lines.empty()) return ends_early(encoded, "the pixels");
  Image image(header->width, header->height, 3, PixelType::u8, Transfer::srgb);
  for (int y = 0; y < header->height; ++y) {
    const std::span<std::byte> row = row_bytes(image, y);
    const std::uint8_t* line = lines.data() + static_cast<std::size_t>(y) * header->bytes_per_line *
                                                  static_cast<std::size_t>(header->planes);
    for (std::size_t x = 0; x < static_cast<std::size_t>(header->width); ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        row[3 * x + c] = header->planes == 1 ? palette[3 * std::size_t{line[x]} + c]
                                             : static_cast<std::byte>(line[c * header->bytes_per_line + x]);
      }
    }
  }
  return image;
}

}  // namespace

const Decoder kPcxDecoder = {"PCX", kMostPixelsPerByte, recognises, read_header, decode};

}  // namespace laterna::image
