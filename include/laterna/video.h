// Films out: pictures, one after the other, into a video file or an animated GIF. docs/sequences.md
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "laterna/image.h"
#include "laterna/result.h"

namespace laterna {

/// Frames per second, as a ratio: those of television are 30000/1001.
struct VideoRate {
  int numerator = 24, denominator = 1;  ///< at least 1 each; together at most kMaxFramesPerSecond
};

/// Of one film: over a year at 60 a second.
inline constexpr std::int64_t kMaxVideoFrames = std::int64_t{1} << 31;

struct VideoOptions {
  /// A name of list_video_codecs(); empty: the first that the file's ending may hold.
  std::string codec = {};
  /// 0 (smallest file) … 100 (best picture), for codecs that lose something; a step of 2 is about one of x264's CRF.
  double quality = 66;
  VideoRate rate = {};
  /// No more frames than these will be written; 0: not known.
  std::int64_t most_frames = 0;
};

struct VideoCodec {
  std::string_view name;     ///< "h264"
  std::string_view endings;  ///< of files that may hold it: ".mp4 .mkv"
  std::string_view meaning;
  std::string_view encoder;  ///< FFmpeg's, such as "libx264"; empty: our own
  bool is_there = false;     ///< whether it can be used here
};
/// All that laterna writes; loads FFmpeg to find out what is there.
std::vector<VideoCodec> list_video_codecs();

/// Whether a file's ending is that of a film to be written: .mp4, .mkv, .webm or .gif.
[[nodiscard]] bool is_video_output(const std::filesystem::path& file);

/// Writes a film, frame by frame. The file is written beside its target and renamed into place by finish(); without that,
/// nothing is left. Each frame is encoded and in the file when write() returns: of a process that is killed, a hidden file ".film.mp4.….part"
/// is left, which can be played up to there. One call at a time.
///
/// Frames are 8-bit sRGB: exactly the pixels of a PNG of the same picture. FFV1 and GIFs of at most 256 colours keep them; the
/// other codecs take limited-range Y'CbCr of BT.709, 4:2:0, each chroma sample the mean of its block of 2 × 2 pixels, rounded
/// once, in integers: what the encoder gets is the same on every machine. The file says so: matrix and primaries BT.709,
/// transfer IEC 61966-2-1, limited range, chroma in the middle of its pixels.
class VideoWriter {
 public:
  /// Errors: bad_usage where the ending, codec, size, rate or quality makes no sense, or FFmpeg lacks the encoder;
  /// cannot_write.
  static Result<VideoWriter> create(const std::filesystem::path& file, int width, int height,
                                    const VideoOptions& options = {});
  ~VideoWriter();
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) noexcept;
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  /// The next frame: 8-bit sRGB with three channels, of the film's size. After an error, only keep_incomplete() makes sense.
  Result<void> write(const Image& frame);
  /// The same of a picture in linear light, as write_image() makes a PNG of its R, G and B: over black, where there is an A.
  /// `threads`: 0: all.
  Result<void> write(const LayeredImage& picture, float exposure = 1, int threads = 0);
  [[nodiscard]] std::int64_t frames() const;  ///< written so far

  /// Completes the film and puts it in its place: an MP4 file as one piece with its index at its beginning, so that it plays while
  /// it is being loaded, and as it grew, in fragments, where the disk has no room for both. Nothing may be called after it. Error: no frame, or cannot_write.
  Result<void> finish();
  /// Completes what there is of a film that was broken off, and puts it beside its target, "film.mp4" as
  /// "film.incomplete.mp4": a target is never half a film. On a full disk, it ends where the disk did. Returns the file's name.
  /// Error: there is nothing to keep.
  Result<std::filesystem::path> keep_incomplete();

 private:
  struct Implementation;
  explicit VideoWriter(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

/// What VideoWriter::create() would say, without leaving anything behind: to ask before a long render.
Result<void> check_video_output(const std::filesystem::path& file, int width, int height,
                                const VideoOptions& options = {});

}  // namespace laterna
