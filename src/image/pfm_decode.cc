// Portable float maps: "PF" RGB or "Pf" grey, rows from the bottom, little-endian where the scale is
// negative. The scale's size is not applied: programs disagree on what it means.
#include <bit>
#include <charconv>
#include <cmath>

#include "image/byte_reader.h"
#include "image/decoder.h"
#include "image/image_rows.h"
#include "image/netpbm_header.h"

namespace laterna::image {
namespace {

constexpr std::int64_t kMostPixelsPerByte = 1;

struct PfmHeader {
  int width = 0, height = 0, channels = 0;
  bool is_little_endian = false;
  std::size_t pixels_position = 0;
};

Result<PfmHeader> parse_header(const EncodedPicture& encoded) {
  ByteReader in(encoded.bytes);
  PfmHeader header;
  header.channels = read_netpbm_word(in) == "PF" ? 3 : 1;
  for (int* side : {&header.width, &header.height}) {
    const std::size_t position = in.position();
    *side = read_netpbm_number(in);
    if (in.ran_out()) return ends_early(encoded, "the header");
    if (*side < 0) return unreadable(encoded, at_byte(position), "expected a width and a height in pixels");
  }
  const std::size_t position = in.position();
  const std::string word = read_netpbm_word(in);
  if (in.ran_out()) return ends_early(encoded, "the header");
  const char* const end = word.data() + word.size();
  float scale = 0;
  const auto [stop, fault] = std::from_chars(word.data(), end, scale);
  if (fault != std::errc() || stop != end || !std::isfinite(scale) || scale == 0) {
    return unreadable(encoded, at_byte(position),
                      "expected a scale, negative for little-endian values, found \"" + word + "\"");
  }
  header.is_little_endian = scale < 0;
  header.pixels_position = in.position();
  return header;
}

bool recognises(const EncodedPicture& encoded) {
  ByteReader in(encoded.bytes);
  const int p = in.u8(), f = in.u8(), after = in.u8();
  return p == 'P' && (f == 'F' || f == 'f') && is_netpbm_space(after);
}

Result<ImageHeader> read_header(const EncodedPicture& encoded) {
  const Result<PfmHeader> header = parse_header(encoded);
  if (!header) return tl::unexpected(header.error());
  return ImageHeader{.format = {},
                     .width = header->width,
                     .height = header->height,
                     .channels = header->channels,
                     .type = PixelType::f32};
}

Result<Image> decode(const EncodedPicture& encoded, const ImageHeader&) {
  const Result<PfmHeader> header = parse_header(encoded);
  if (!header) return tl::unexpected(header.error());
  ByteReader in(encoded.bytes);
  in.seek(header->pixels_position);
  const std::size_t count = static_cast<std::size_t>(header->width) *
                            static_cast<std::size_t>(header->height) *
                            static_cast<std::size_t>(header->channels);
  if (in.remaining() / sizeof(float) < count) return ends_early(encoded, "the pixels");
  Image image(header->width, header->height, header->channels, PixelType::f32, Transfer::linear);
  for (float& value : image.values<float>()) {
    std::uint32_t bits = in.u32_le();
    if (!header->is_little_endian) bits = __builtin_bswap32(bits);
    value = std::bit_cast<float>(bits);
  }
  flip_rows(image);
  return image;
}

}  // namespace

const Decoder kPfmDecoder = {"PFM", kMostPixelsPerByte, recognises, read_header, decode};

}  // namespace laterna::image
