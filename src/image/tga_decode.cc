// Truevision TGA: grey, colour and palette, plain or run-length encoded, 8 to 32 bits.
#include <algorithm>
#include <array>
#include <vector>

#include "image/byte_reader.h"
#include "image/decoder.h"
#include "image/file_ending.h"
#include "image/image_rows.h"

namespace laterna::image {
namespace {

// A run of 128 pixels takes two bytes.
constexpr std::int64_t kMostPixelsPerByte = 64;

enum class Kind { palette = 1, colour = 2, grey = 3 };

struct TgaHeader {
  std::size_t id_bytes = 0;
  Kind kind = Kind::colour;
  bool is_run_length = false;
  unsigned palette_first = 0, palette_size = 0;
  int palette_bits = 0;
  int width = 0, height = 0;
  int bits = 0;
  bool right_to_left = false, top_down = false;
};

// What a pixel of so many bits becomes; 0 where there is no such pixel.
int channels_of(Kind kind, int bits) {
  if (kind == Kind::grey) return bits == 8 ? 1 : bits == 16 ? 2 : 0;
  switch (bits) {
    case 15:
    case 16:
    case 24:
      return 3;
    case 32:
      return 4;
    default:
      return 0;
  }
}

int channels_of(const TgaHeader& header) {
  if (header.kind == Kind::palette) return channels_of(Kind::colour, header.palette_bits);
  return channels_of(header.kind, header.bits);
}

Result<TgaHeader> parse_header(const EncodedPicture& encoded) {
  ByteReader in(encoded.bytes);
  TgaHeader header;
  header.id_bytes = in.u8();
  const int palette_type = in.u8();
  const int type = in.u8();
  header.palette_first = in.u16_le();
  header.palette_size = in.u16_le();
  header.palette_bits = in.u8();
  in.skip(4);  // where on a screen it was
  header.width = in.u16_le();
  header.height = in.u16_le();
  header.bits = in.u8();
  const unsigned descriptor = in.u8();
  if (in.ran_out()) return ends_early(encoded, "the header");
  constexpr std::array kTypes = {1, 2, 3, 9, 10, 11};
  if (std::find(kTypes.begin(), kTypes.end(), type) == kTypes.end()) {
    return unreadable(encoded, "byte 2",
                      "expected TGA image type 1, 2, 3, 9, 10 or 11, found " + std::to_string(type));
  }
  header.kind = static_cast<Kind>(type & 7);
  header.is_run_length = type >= 8;
  header.right_to_left = (descriptor & 0x10) != 0;
  header.top_down = (descriptor & 0x20) != 0;
  if ((descriptor & 0xC0) != 0) return unreadable(encoded, "byte 17", "interleaved rows are not read");
  const bool has_palette = header.kind == Kind::palette;
  if (has_palette &&
      (palette_type != 1 || header.palette_size == 0 || (header.bits != 8 && header.bits != 16))) {
    return unreadable(encoded, "byte 1", "a palette picture needs a palette and 8 or 16 bits per pixel");
  }
  if (channels_of(header) == 0) {
    return unreadable(encoded, has_palette ? "byte 7" : "byte 16",
                      "a TGA of type " + std::to_string(type) + " with " +
                          std::to_string(has_palette ? header.palette_bits : header.bits) +
                          " bits per colour is not read");
  }
  // A colour picture may carry a palette that it does not use: it is skipped like the identification.
  if (!has_palette && palette_type == 1) {
    header.id_bytes += header.palette_size * ((static_cast<std::size_t>(header.palette_bits) + 7) / 8);
  }
  return header;
}

using Pixel = std::array<std::uint8_t, 4>;

std::uint8_t from_5_bits(unsigned value) { return static_cast<std::uint8_t>(((value & 31) * 255 + 15) / 31); }

// One grey or colour value as the file holds it: blue, green, red.
Pixel read_pixel(ByteReader& in, Kind kind, int bits) {
  Pixel pixel = {};
  if (kind == Kind::grey) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(bits) / 8; ++c) pixel[c] = in.u8();
  } else if (bits <= 16) {
    const unsigned packed = in.u16_le();
    pixel = {from_5_bits(packed >> 10), from_5_bits(packed >> 5), from_5_bits(packed), 0};
  } else {
    for (std::size_t c = 3; c-- > 0;) pixel[c] = in.u8();
    if (bits == 32) pixel[3] = in.u8();
  }
  return pixel;
}

class TgaReader {
 public:
  TgaReader(const EncodedPicture& encoded, const TgaHeader& header)
      : encoded_(encoded), header_(header), in_(encoded.bytes) {
    in_.skip(18 + header.id_bytes);
    if (header.kind == Kind::palette) palette_.resize(header.palette_size);
    for (Pixel& colour : palette_) colour = read_pixel(in_, Kind::colour, header.palette_bits);
  }

  Result<Image> read() {
    Image image(header_.width, header_.height, channels_of(header_), PixelType::u8, Transfer::srgb);
    const auto channels = static_cast<std::size_t>(image.channels());
    const std::span<std::uint8_t> values = image.values<std::uint8_t>();
    for (std::size_t at = 0; at < values.size();) {
      const std::size_t left = (values.size() - at) / channels;
      // An unencoded picture is one long packet of different pixels.
      const unsigned packet = header_.is_run_length ? in_.u8() : 0;
      const std::size_t count =
          header_.is_run_length ? std::min<std::size_t>((packet & 127) + 1, left) : left;
      const bool repeats = (packet & 128) != 0;
      Pixel pixel = {};
      for (std::size_t i = 0; i < count; ++i, at += channels) {
        if (i == 0 || !repeats) pixel = next_pixel();
        if (in_.ran_out()) return ends_early(encoded_, "the pixels");
        std::copy_n(pixel.begin(), channels, values.begin() + static_cast<std::ptrdiff_t>(at));
      }
    }
    if (largest_index_ >= palette_.size() && !palette_.empty()) return bad_index();
    return image;
  }

 private:
  Pixel next_pixel() {
    if (header_.kind != Kind::palette) return read_pixel(in_, header_.kind, header_.bits);
    const unsigned index = header_.bits == 8 ? in_.u8() : in_.u16_le();
    const unsigned entry = index - header_.palette_first;  // wraps to a large number below the first
    largest_index_ = std::max<std::size_t>(largest_index_, entry);
    return entry < palette_.size() ? palette_[entry] : Pixel{};
  }

  [[nodiscard]] tl::unexpected<Error> bad_index() const {
    return unreadable(encoded_, {},
                      "a pixel has a colour outside the palette, which holds colours " +
                          std::to_string(header_.palette_first) + " to " +
                          std::to_string(header_.palette_first + header_.palette_size - 1));
  }

  const EncodedPicture& encoded_;
  const TgaHeader& header_;
  ByteReader in_;
  std::vector<Pixel> palette_;
  std::size_t largest_index_ = 0;
};

// Many programs write 32 bits with a fourth byte that is always 0 and means nothing.
void make_opaque_if_invisible(Image& image) {
  if (image.channels() != 4) return;
  const std::span<std::uint8_t> values = image.values<std::uint8_t>();
  for (std::size_t i = 3; i < values.size(); i += 4) {
    if (values[i] != 0) return;
  }
  for (std::size_t i = 3; i < values.size(); i += 4) values[i] = 255;
}

// The format has no signature at its beginning; files of its second version have one at their end.
bool recognises(const EncodedPicture& encoded) {
  constexpr std::string_view kFooter("TRUEVISION-XFILE.\0", 18);
  const std::size_t size = encoded.bytes.size();
  if (size > kFooter.size() && begins_with(encoded.bytes.last(kFooter.size()), kFooter)) return true;
  constexpr std::array<std::string_view, 4> kEndings = {".tga", ".vda", ".icb", ".vst"};
  return std::any_of(kEndings.begin(), kEndings.end(),
                     [&](std::string_view ending) { return has_ending(encoded.name, ending); });
}

Result<ImageHeader> read_header(const EncodedPicture& encoded) {
  const Result<TgaHeader> header = parse_header(encoded);
  if (!header) return tl::unexpected(header.error());
  return ImageHeader{.format = {},
                     .width = header->width,
                     .height = header->height,
                     .channels = channels_of(*header),
                     .type = PixelType::u8};
}

Result<Image> decode(const EncodedPicture& encoded, const ImageHeader&) {
  const Result<TgaHeader> header = parse_header(encoded);
  if (!header) return tl::unexpected(header.error());
  Result<Image> image = TgaReader(encoded, *header).read();
  if (!image) return image;
  make_opaque_if_invisible(*image);
  if (header->right_to_left) mirror_rows(*image);
  if (!header->top_down) flip_rows(*image);
  return image;
}

}  // namespace

const Decoder kTgaDecoder = {"TGA", kMostPixelsPerByte, recognises, read_header, decode};

}  // namespace laterna::image
