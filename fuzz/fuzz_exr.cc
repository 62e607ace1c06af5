#include "fuzz_picture.h"
#include "image/exr_decode.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace laterna::image;
  const EncodedPicture encoded{std::as_bytes(std::span(data, size)), "fuzz"};
  const laterna::Result<laterna::ImageHeader> header = read_checked_header(kExrDecoder, encoded);
  if (header && std::int64_t{header->width} * header->height <= kMostFuzzedPixels)
    (void)decode_exr_layers(encoded);
  return fuzz_decoder(kExrDecoder, data, size);
}
