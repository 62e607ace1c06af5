// What the dispatcher (decode.cc) knows of a file format, and what the decoders share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "laterna/image.h"
#include "laterna/result.h"

namespace laterna::image {

struct EncodedPicture {
  std::span<const std::byte> bytes;
  std::string_view name;  ///< stands in messages; its ending breaks the tie for TGA
};

/// One file format. read_header() gives what decode() will give, from the first bytes; decode() is called
/// only with a header whose size has passed the limits, and need not check it again.
struct Decoder {
  std::string_view format;
  /// No file of this format holds more pixels per byte: what claims more is refused before memory is taken.
  /// 0: there is no such bound.
  std::int64_t most_pixels_per_byte;
  bool (*recognises)(const EncodedPicture&);
  Result<ImageHeader> (*read_header)(const EncodedPicture&);
  Result<Image> (*decode)(const EncodedPicture&, const ImageHeader&);
};

extern const Decoder kPngDecoder, kJpegDecoder, kGifDecoder, kBmpDecoder, kTgaDecoder, kPcxDecoder,
    kNetpbmDecoder, kPfmDecoder, kRadianceDecoder, kExrDecoder;

/// The header, its size within the limits.
Result<ImageHeader> read_checked_header(const Decoder& decoder, const EncodedPicture& encoded);

/// The picture; nothing is thrown.
Result<Image> decode_with(const Decoder& decoder, const EncodedPicture& encoded);

/// Whether it begins, or is named, as one of the formats that are read.
bool is_picture(const EncodedPicture& encoded);

/// True when the bytes begin with `signature`.
bool begins_with(std::span<const std::byte> bytes, std::string_view signature);

/// An error about the content of a picture file.
tl::unexpected<Error> unreadable(const EncodedPicture& encoded, std::string place, std::string message);

/// "byte 20"
std::string at_byte(std::size_t position);

/// An error about a header that claims more pixels than the whole file can hold.
tl::unexpected<Error> claims_too_much(const EncodedPicture& encoded, std::string_view format,
                                      const ImageHeader& header);

/// An error that says that the file ends too early. `missing` completes "the file ends here, inside …".
tl::unexpected<Error> ends_early(const EncodedPicture& encoded, std::string_view missing);

}  // namespace laterna::image
