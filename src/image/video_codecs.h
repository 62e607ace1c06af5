// The codecs that films are written with, and what each needs.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "image/video_interface.h"
#include "laterna/result.h"

namespace laterna::image {

struct CodecEntry {
  std::string_view name, endings, meaning;
  std::string_view encoder;  ///< FFmpeg's; empty: our own GIF
  std::string_view options;  ///< of the encoder, lines "key=value"
  LaternaVideoPixels pixels = kVideoYuv420;
  double worst_rate_factor = 0, best_rate_factor = 0;  ///< its CRF at quality 0 and 100; equal: it has none
  int frames_between_keys = 0;

  [[nodiscard]] bool has_quality() const { return worst_rate_factor != best_rate_factor; }
};

/// The first that an ending may hold is its usual one.
std::span<const CodecEntry> codec_entries();

/// FFmpeg's short name of the muxer for a file's name: "mp4", "matroska", "webm", and "gif" of our own; or empty.
std::string_view container_for(std::string_view file);

/// The codec of that name, or the ending's usual one where it is empty.
/// Error (bad_usage): the ending is that of no film, there is no such codec, or such a file cannot hold it.
Result<const CodecEntry*> find_codec(std::string_view file, std::string_view name);

}  // namespace laterna::image
