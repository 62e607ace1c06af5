// Which format is this, and is its size one that we read?
#include <algorithm>
#include <array>
#include <utility>

#include "base/file_io.h"
#include "base/without_exceptions.h"
#include "image/decoder.h"
#include "image/exr_decode.h"
#include "image/layers.h"

namespace laterna::image {
namespace {

// PCX and TGA come last: they have no signature to speak of, and their decoders go by the name.
constexpr std::array kDecoders = {&kPngDecoder, &kJpegDecoder,   &kExrDecoder, &kRadianceDecoder,
                                  &kPfmDecoder, &kNetpbmDecoder, &kGifDecoder, &kBmpDecoder,
                                  &kPcxDecoder, &kTgaDecoder};

// Formats that people are likely to try, so that the message can name what they have.
struct KnownSignature {
  std::size_t offset;
  std::string_view signature;
  std::string_view format;
};
constexpr std::array kNotRead = {
    KnownSignature{8, "WEBP", "WebP"},
    KnownSignature{1, "KTX ", "KTX"},
    KnownSignature{0, "DDS ", "DDS"},
    KnownSignature{0, "8BPS", "Photoshop"},
    KnownSignature{0, std::string_view("II*\0", 4), "TIFF"},
    KnownSignature{0, std::string_view("MM\0*", 4), "TIFF"},
    KnownSignature{4, "ftypavif", "AVIF"},
    KnownSignature{4, "ftypheic", "HEIC"},
    KnownSignature{4, "ftyp", "an MP4 or QuickTime film: a rig's \"film\" takes it, not its \"slide\""},
    KnownSignature{0, "\x1a\x45\xdf\xa3",
                   "a Matroska or WebM film: a rig's \"film\" takes it, not its \"slide\""},
    KnownSignature{8, "AVI ", "an AVI film: a rig's \"film\" takes it, not its \"slide\""},
    KnownSignature{0, "<svg", "SVG"},
    KnownSignature{0, "P7\n", "PAM"},
};

std::string describe_content(std::span<const std::byte> bytes) {
  for (const KnownSignature& known : kNotRead) {
    if (bytes.size() > known.offset && begins_with(bytes.subspan(known.offset), known.signature)) {
      return std::string(known.format);
    }
  }
  return "none of these";
}

Result<const Decoder*> find_decoder(const EncodedPicture& encoded) {
  if (encoded.bytes.empty()) return unreadable(encoded, {}, "the file is empty");
  const auto found = std::find_if(kDecoders.begin(), kDecoders.end(),
                                  [&](const Decoder* decoder) { return decoder->recognises(encoded); });
  if (found != kDecoders.end()) return *found;
  return unreadable(
      encoded, {},
      "expected a PNG, JPEG, GIF, BMP, TGA, PCX, PNM, PFM, Radiance HDR or OpenEXR picture, found " +
          describe_content(encoded.bytes));
}

std::string size_text(const ImageHeader& header) {
  return std::to_string(header.width) + " x " + std::to_string(header.height);
}

}  // namespace

Result<ImageHeader> read_checked_header(const Decoder& decoder, const EncodedPicture& encoded) {
  Result<ImageHeader> header = decoder.read_header(encoded);
  if (!header) return header;
  header->format = decoder.format;
  if (header->width < 1 || header->height < 1) {
    return unreadable(encoded, {}, "the picture has no pixels: its size is " + size_text(*header));
  }
  const std::int64_t pixels = std::int64_t{header->width} * header->height;
  if (header->width > kMaxImageSide || header->height > kMaxImageSide || pixels > kMaxImagePixels) {
    return unreadable(encoded, {},
                      "the picture is " + size_text(*header) + " pixels; at most " +
                          std::to_string(kMaxImageSide) + " per side and " + std::to_string(kMaxImagePixels) +
                          " in all are read");
  }
  if (decoder.most_pixels_per_byte > 0 &&
      pixels / decoder.most_pixels_per_byte > static_cast<std::int64_t>(encoded.bytes.size())) {
    return claims_too_much(encoded, decoder.format, *header);
  }
  return header;
}

Result<Image> decode_with(const Decoder& decoder, const EncodedPicture& encoded) {
  const Result<ImageHeader> header = read_checked_header(decoder, encoded);
  if (!header) return tl::unexpected(header.error());
  return without_exceptions(
      unreadable(encoded, {}, "not enough memory for " + size_text(*header) + " pixels").value(),
      [&] { return decoder.decode(encoded, *header); });
}

bool is_picture(const EncodedPicture& encoded) { return find_decoder(encoded).has_value(); }

bool begins_with(std::span<const std::byte> bytes, std::string_view signature) {
  return bytes.size() >= signature.size() &&
         std::equal(signature.begin(), signature.end(), bytes.begin(),
                    [](char c, std::byte b) { return static_cast<std::byte>(c) == b; });
}

tl::unexpected<Error> unreadable(const EncodedPicture& encoded, std::string place, std::string message) {
  return tl::unexpected(
      Error(Failure::bad_input, Diagnostic{std::string(encoded.name), std::move(place), std::move(message)}));
}

tl::unexpected<Error> claims_too_much(const EncodedPicture& encoded, std::string_view format,
                                      const ImageHeader& header) {
  return unreadable(encoded, {},
                    "the header claims " + size_text(header) + " pixels, more than a " + std::string(format) +
                        " file of " + std::to_string(encoded.bytes.size()) + " bytes can hold");
}

std::string at_byte(std::size_t position) { return "byte " + std::to_string(position); }

tl::unexpected<Error> ends_early(const EncodedPicture& encoded, std::string_view missing) {
  return unreadable(encoded, at_byte(encoded.bytes.size()),
                    "the file ends here, inside " + std::string(missing));
}

}  // namespace laterna::image

namespace laterna {

Result<Image> decode_image(std::span<const std::byte> encoded, std::string_view name) {
  const image::EncodedPicture picture{encoded, name};
  const Result<const image::Decoder*> decoder = image::find_decoder(picture);
  if (!decoder) return tl::unexpected(decoder.error());
  return image::decode_with(**decoder, picture);
}

Result<ImageHeader> read_image_header(std::span<const std::byte> encoded, std::string_view name) {
  const image::EncodedPicture picture{encoded, name};
  const Result<const image::Decoder*> decoder = image::find_decoder(picture);
  if (!decoder) return tl::unexpected(decoder.error());
  return image::read_checked_header(**decoder, picture);
}

Result<ImageHeader> read_image_header(const std::filesystem::path& file) {
  const Result<std::vector<std::byte>> bytes = read_file(file);
  if (!bytes) return tl::unexpected(bytes.error());
  return read_image_header(*bytes, file.string());
}

Result<Image> read_image(const std::filesystem::path& file) {
  const Result<std::vector<std::byte>> bytes = read_file(file);
  if (!bytes) return tl::unexpected(bytes.error());
  return decode_image(*bytes, file.string());
}

Result<LayeredImage> read_layered_image(const std::filesystem::path& file, ChannelValues values) {
  const Result<std::vector<std::byte>> bytes = read_file(file);
  if (!bytes) return tl::unexpected(bytes.error());
  const std::string name = file.string();
  const image::EncodedPicture encoded{*bytes, name};
  if (image::kExrDecoder.recognises(encoded)) return image::decode_exr_layers(encoded);
  const Result<Image> picture = decode_image(*bytes, name);
  if (!picture) return tl::unexpected(picture.error());
  return without_exceptions(
      image::unreadable(encoded, {}, "not enough memory for the picture's channels").value(),
      [&]() -> Result<LayeredImage> { return image::layers_from_image(*picture, values); });
}

}  // namespace laterna
