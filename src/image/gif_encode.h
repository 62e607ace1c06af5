// Animated GIFs, written frame by frame.
#pragma once

#include <memory>

#include "base/output_file.h"
#include "image/film_encoder.h"
#include "laterna/video.h"

namespace laterna::image {

/// GIF counts time in hundredths of a second, and what lasts only one of them is shown slowly: see kUsualDelay of the reader.
inline constexpr int kMostGifFramesPerSecond = 50;

/// A GIF of at most 65535 × 65535 pixels that begins anew when it is over. Each frame has colours of its own
/// (image/palette.h) and covers what differs from the frame before. Frame k begins at k / rate seconds, to the nearest
/// hundredth. `output` outlives it.
std::unique_ptr<FilmEncoder> make_gif_encoder(OutputFile& output, int width, int height,
                                              const VideoRate& rate);

}  // namespace laterna::image
