// What the library and the video plug-in (plugins/ffmpeg_video.cc) know of each other: plain types only, for the two are
// compiled and found apart. Change kVideoInterface with every change here.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

/// How luma and chroma make R, G and B.
enum LaternaVideoMatrix { kVideoRgb, kVideoBt601, kVideoBt709, kVideoBt2020, kVideoSmpte240m };

/// Sample (x, y) of a component lies at data + y · stride + x · step: one byte, or two where depth + shift > 8; `depth`
/// bits, 1 to 16, from bit `shift` on. Components of one picture other than R, G, B have the same depth.
struct LaternaVideoComponent {
  const std::uint8_t* data;
  std::ptrdiff_t stride;
  int step, shift, depth;
};

/// A decoded frame, until the next call about its film. Rows from the top.
struct LaternaVideoPicture {
  int width, height;
  int component_count;  ///< 1 grey, 2 grey and alpha, 3 Y Cb Cr or R G B, 4 with alpha
  LaternaVideoComponent components[4];
  int is_big_endian;
  int chroma_shift_x, chroma_shift_y;  ///< chroma is stored for 2^shift pixels together
  LaternaVideoMatrix matrix;
  int is_full_range;  ///< else luma is 16…235 and chroma 16…240, times 2^(depth − 8)
};

struct LaternaVideoFilm;  // the plug-in's own

/// What a file holds. Memory is the film's.
struct LaternaVideoInfo {
  const char* container;  ///< "QuickTime / MOV"
  const char* codec;      ///< "h264"
  int width, height;
  std::int64_t tick_numerator, tick_denominator;  ///< seconds of a tick
  const std::int64_t* begins;  ///< ticks from the first frame's time to each frame's, rising
  std::size_t frame_count;     ///< at least 1
  std::int64_t end;            ///< ticks, of the last frame
  std::size_t missing_frames;  ///< that the file promises and does not hold
};

/// How frames are handed to an encoder.
enum LaternaVideoPixels {
  kVideoYuv420,  ///< planes Y, Cb, Cr of 8 bits, chroma for 2 x 2 pixels together: BT.709, limited range
  kVideoRgb24,   ///< one plane of bytes R G B R G B …: sRGB
};

/// A film to be written.
struct LaternaVideoSettings {
  const char* container;          ///< FFmpeg's short name of the muxer: "mp4"
  const char* encoder;            ///< FFmpeg's name: "libx264"
  const char* options;            ///< of the encoder: lines "key=value"
  const char* container_options;  ///< the same of the muxer
  int width, height;
  LaternaVideoPixels pixels;
  int rate_numerator, rate_denominator;  ///< frames per second
  int frames_between_keys;               ///< at most
};

/// Where the file's bytes go: `offset` from its beginning. Returns 0 or an errno.
struct LaternaVideoSink {
  void* to;
  int (*write)(void* to, std::int64_t offset, const std::uint8_t* bytes, std::size_t size);
};

struct LaternaVideoPlanes {
  const std::uint8_t* data[3];
  std::ptrdiff_t stride[3];
};

struct LaternaVideoOutput;  // the plug-in's own

/// Messages end with NUL and are cut where they do not fit.
struct LaternaVideoPlugin {
  int interface_number;
  const char* versions;  ///< of the libraries
  /// Null: `message` says why.
  LaternaVideoFilm* (*open)(const char* file, std::size_t most_frames, std::int64_t most_pixels,
                            LaternaVideoInfo* info, char* message, std::size_t message_size);
  /// 0: `message` says why. One call at a time for each film.
  int (*read)(LaternaVideoFilm* film, std::size_t frame, LaternaVideoPicture* picture, char* message,
              std::size_t message_size);
  void (*close)(LaternaVideoFilm* film);

  /// Whether FFmpeg here has an encoder of that name, and a container that holds what it makes.
  int (*can_write)(const char* container, const char* encoder);
  /// Null: `message` says why. The sink is used until discard().
  LaternaVideoOutput* (*create)(const LaternaVideoSettings* settings, const LaternaVideoSink* sink,
                                char* message, std::size_t message_size);
  /// The next frame, copied; and the end of the film. 0: `message` says why.
  int (*write)(LaternaVideoOutput* output, const LaternaVideoPlanes* planes, char* message,
               std::size_t message_size);
  int (*finish)(LaternaVideoOutput* output, char* message, std::size_t message_size);
  /// Writes nothing any more.
  void (*discard)(LaternaVideoOutput* output);
  /// The same film, its frames as they were encoded, in another arrangement: `container` with `container_options`. `file` holds
  /// it. 0: `message` says why.
  int (*rearrange)(const char* file, const char* container, const char* container_options,
                   const LaternaVideoSink* sink, char* message, std::size_t message_size);
};

inline constexpr int kVideoInterface = 3;

/// The plug-in's one symbol.
using LaternaVideoEntry = const LaternaVideoPlugin* (*)();
#define LATERNA_VIDEO_ENTRY "laterna_video_plugin"
}
