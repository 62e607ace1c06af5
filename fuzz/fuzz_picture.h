// One picture decoder under libFuzzer.
#pragma once

#include <cstddef>
#include <cstdint>

#include "image/decoder.h"

namespace laterna::image {

/// Larger pictures would only cost time and memory; the limits on size have tests of their own.
inline constexpr std::int64_t kMostFuzzedPixels = 1 << 18;

/// Decodes `data` as if it had been recognised, and holds the decoder to the header that it gave.
inline int fuzz_decoder(const Decoder& decoder, const std::uint8_t* data, std::size_t size) {
  const EncodedPicture encoded{std::as_bytes(std::span(data, size)), "fuzz"};
  const Result<ImageHeader> header = read_checked_header(decoder, encoded);
  if (!header || std::int64_t{header->width} * header->height > kMostFuzzedPixels) return 0;
  const Result<Image> image = decode_with(decoder, encoded);
  if (!image) return 0;
  const bool keeps_its_word = image->width() == header->width && image->height() == header->height &&
                              image->channels() == header->channels && image->type() == header->type;
  if (!keeps_its_word) __builtin_trap();
  return 0;
}

}  // namespace laterna::image
