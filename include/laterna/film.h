// Films: slides that change with time. Numbered pictures, animated GIFs, and video files by FFmpeg's libraries, which are
// loaded when the first video is opened and not before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "laterna/result.h"

namespace laterna {

/// What a film shows when it is over.
enum class AtEnd : std::uint8_t {
  loop,       ///< 0 1 2 3 0 1 2 3 …
  hold,       ///< 0 1 2 3 3 3 …
  black,      ///< 0 1 2 3, then nothing
  ping_pong,  ///< 0 1 2 3 2 1 0 1 …
};

/// When a film shows what. A frame stays until the next one begins; it counts as begun kSameInstant before its time, so that
/// rounded times cannot miss it.
struct FilmTiming {
  double frames_per_second = 24;  ///< of a numbered sequence; GIFs and videos have times of their own
  /// Scene time in seconds at which the first frame begins. Earlier, that frame stands still (AtEnd::black: it is dark).
  /// Negative: the film is under way at time 0.
  double start = 0;
  double rate = 1;  ///< seconds of film per second of scene: greater than 0, at most kMaxFilmRate
  AtEnd at_end = AtEnd::hold;

  bool operator==(const FilmTiming&) const = default;
};

/// Seconds of scene time that are no difference.
inline constexpr double kSameInstant = 1e-9;
/// Scene times, of frames and of `start`, lie within so many seconds of 0: there, doubles tell 2 · 10⁻¹⁰ s apart.
inline constexpr double kMaxSceneTime = 1e6;
inline constexpr double kMaxFilmRate = 1000;
inline constexpr double kMaxFramesPerSecond = 1e6;
/// Frames that one film may have.
inline constexpr std::size_t kMaxFilmFrames = std::size_t{1} << 24U;
/// A film holds the frame that is shown and at most so many that come next, made ready on a thread of its own…
inline constexpr std::size_t kMaxFramesAhead = 8;
/// … and fewer where all of them would take more bytes than this, down to none.
inline constexpr std::size_t kMaxFilmMemory = std::size_t{256} << 20U;

struct FilmHeader {
  std::string format;  ///< "GIF", "numbered PNG", "QuickTime / MOV, h264", …
  int width = 0, height = 0;
  std::size_t frames = 0;
  double duration = 0;  ///< seconds, the last frame's included
};

/// What a film file holds; no frame is decoded. `file`: a GIF, a video, a picture (a film of one frame), or a pattern of
/// numbered pictures: "frame.####.png" (as many digits as #, or more) or "frame_%04d.png". Numbers start anywhere and leave
/// none out. Errors name the file.
Result<FilmHeader> read_film_header(const std::filesystem::path& file,
                                    double frames_per_second = FilmTiming{}.frames_per_second);

/// Number of the frame that a film shows at a scene time; nothing: it is dark. Errors name the file.
Result<std::optional<std::size_t>> find_film_frame(const std::filesystem::path& file,
                                                   const FilmTiming& timing, double scene_time);

/// Whether a film's name is a pattern of numbered pictures: it has # or %d in it, and no file is called so itself.
bool is_numbered(const std::filesystem::path& file);

/// Whether video files can be opened here; loads FFmpeg to find out.
struct VideoSupport {
  bool is_there = false;
  std::string description;  ///< the libraries' versions, or what is missing and how to get it
};
VideoSupport video_support();

}  // namespace laterna
