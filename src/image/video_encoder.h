// Video files by the plug-in's encoders.
#pragma once

#include <memory>
#include <string>

#include "base/output_file.h"
#include "image/film_encoder.h"
#include "image/video_interface.h"

namespace laterna::image {

struct VideoEncoding {
  std::string container, encoder, options, container_options;  ///< as LaternaVideoSettings has them
  LaternaVideoPixels pixels = kVideoYuv420;
  int width = 0, height = 0, rate_numerator = 0, rate_denominator = 0, frames_between_keys = 0;
};

/// `output` outlives it. `name` is the file, for messages. Errors: bad_usage, cannot_write.
Result<std::unique_ptr<FilmEncoder>> make_video_encoder(const LaternaVideoPlugin& plugin, OutputFile& output,
                                                        const VideoEncoding& encoding,
                                                        const std::string& name);

/// Writes the film in `file` to `output` once more, its frames as they were encoded, as one piece with `container_options`.
/// `name` as above. Error: cannot_write.
Result<void> rearrange_video(const LaternaVideoPlugin& plugin, const std::filesystem::path& file,
                             OutputFile& output, const std::string& container,
                             const std::string& container_options, const std::string& name);

}  // namespace laterna::image
