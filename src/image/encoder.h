// What write.cc knows of the formats that are written. Each function gives the bytes of the whole file, or
// says why the format cannot hold the picture. They expect a picture that has passed write.cc's checks, and
// may throw std::bad_alloc.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "laterna/image.h"
#include "laterna/result.h"

namespace laterna::image {

using EncodedBytes = std::vector<std::byte>;

/// `name` is the file, for messages.
Result<EncodedBytes> encode_png(const LayeredImage& image, const WriteOptions& options,
                                std::string_view name);
Result<EncodedBytes> encode_exr(const LayeredImage& image, const WriteOptions& options,
                                std::string_view name);
Result<EncodedBytes> encode_radiance(const LayeredImage& image, const WriteOptions& options,
                                     std::string_view name);
Result<EncodedBytes> encode_pfm(const LayeredImage& image, const WriteOptions& options,
                                std::string_view name);

/// The pixels of an 8-bit PNG of the picture's R, G, B, or of Y three times. Colours stay multiplied by alpha.
Result<Image> screen_pixels(const LayeredImage& image, float exposure, int threads, std::string_view name);

/// 8- and 16-bit pictures as they are stored.
EncodedBytes encode_png(const Image& image, int threads);

/// The request itself makes no sense.
inline tl::unexpected<Error> cannot_hold(std::string_view name, std::string message) {
  return tl::unexpected(Error(Failure::bad_usage, Diagnostic{std::string(name), {}, std::move(message)}));
}

inline void append(EncodedBytes& bytes, std::string_view text) {
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
}

}  // namespace laterna::image
