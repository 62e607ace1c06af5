// GIF87a and GIF89a: the first frame on the whole canvas, as RGBA. What the frame leaves free is transparent.
#include "image/gif_stream.h"

namespace laterna::image {
namespace {

// A code of 12 bits stands for at most 4096 pixels.
constexpr std::int64_t kMostPixelsPerByte = 4096;

bool recognises(const EncodedPicture& encoded) {
  return begins_with(encoded.bytes, "GIF87a") || begins_with(encoded.bytes, "GIF89a");
}

Result<ImageHeader> read_header(const EncodedPicture& encoded) {
  ByteReader in(encoded.bytes);
  const GifCanvas canvas = read_gif_canvas(in);
  if (in.ran_out()) return ends_early(encoded, "the header");
  return ImageHeader{.format = {},
                     .width = static_cast<int>(canvas.width),
                     .height = static_cast<int>(canvas.height),
                     .channels = 4,
                     .type = PixelType::u8};
}

Result<Image> decode(const EncodedPicture& encoded, const ImageHeader& header) {
  ByteReader in(encoded.bytes);
  const GifCanvas canvas = read_gif_canvas(in);
  const Result<std::optional<GifFrame>> frame = read_gif_frame(encoded, canvas, 0, in);
  if (!frame) return tl::unexpected(frame.error());
  Image image(header.width, header.height, header.channels, header.type, Transfer::srgb);
  const Result<void> drawn = draw_gif_frame(encoded, canvas, **frame, in, image.values<std::uint8_t>());
  if (!drawn) return tl::unexpected(drawn.error());
  return image;
}

}  // namespace

const Decoder kGifDecoder = {"GIF", kMostPixelsPerByte, recognises, read_header, decode};

}  // namespace laterna::image
