#include <algorithm>

#include "fuzz_picture.h"
#include "image/frame_reader.h"

namespace {

/// A GIF is a still and a film.
void read_film(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kMostFrames = 16;
  const auto* bytes = reinterpret_cast<const std::byte*>(data);
  const auto film = laterna::image::open_gif({bytes, bytes + size}, "fuzz");
  if (!film) return;
  const laterna::FilmHeader& header = (*film)->header();
  if (std::int64_t{header.width} * header.height > laterna::image::kMostFuzzedPixels) return;
  const std::size_t count = std::min(header.frames, kMostFrames);
  for (std::size_t k = 0; k < count; ++k) (void)(*film)->read(k);
  for (std::size_t k = count; k-- > 0;) (void)(*film)->read(k);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  read_film(data, size);
  return laterna::image::fuzz_decoder(laterna::image::kGifDecoder, data, size);
}
