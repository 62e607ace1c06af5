// Any bytes as a video, through the plug-in: read or refused, and what was read keeps to the interface. The plug-in is
// linked into this program, so that it is instrumented; FFmpeg's own libraries are not.
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "fuzz_picture.h"
#include "image/video_colour.h"
#include "image/video_interface.h"

extern "C" {
#include <libavutil/mem.h>

const LaternaVideoPlugin* laterna_video_plugin();
}

namespace {

constexpr std::size_t kMostFrames = 4096, kMostRead = 8;
constexpr std::size_t kMostAllocated = std::size_t{64} << 20U;

void expect(bool holds) {
  if (!holds) std::abort();
}

void check(const LaternaVideoInfo& info) {
  constexpr std::int64_t kWhole = std::int64_t{1} << 53;
  expect(info.width > 0 && info.height > 0 && info.tick_numerator > 0 && info.tick_denominator > 0);
  expect(info.frame_count > 0 && info.frame_count <= kMostFrames && info.begins[0] == 0);
  for (std::size_t i = 1; i < info.frame_count; ++i) expect(info.begins[i] >= info.begins[i - 1]);
  expect(info.end >= info.begins[info.frame_count - 1] && info.end < kWhole / info.tick_numerator + 1);
}

void read(const LaternaVideoPlugin& plugin, LaternaVideoFilm* film, std::size_t frame,
          const LaternaVideoInfo& info) {
  std::array<char, 256> message{};
  LaternaVideoPicture picture{};
  if (plugin.read(film, frame, &picture, message.data(), message.size()) == 0) {
    expect(message[0] != 0);  // every refusal says why
    return;
  }
  expect(picture.width == info.width && picture.height == info.height);
  static laterna::image::VideoColour colour;
  expect(!colour.convert(picture).empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const int kFile = memfd_create("fuzz", 0);
  static const LaternaVideoPlugin& plugin = *laterna_video_plugin();
  av_max_alloc(kMostAllocated);
  if (ftruncate(kFile, static_cast<off_t>(size)) != 0 ||
      pwrite(kFile, data, size, 0) != static_cast<ssize_t>(size))
    return 0;
  const std::string name = "/proc/self/fd/" + std::to_string(kFile);
  std::array<char, 256> message{};
  LaternaVideoInfo info{};
  LaternaVideoFilm* film = plugin.open(name.c_str(), kMostFrames, laterna::image::kMostFuzzedPixels, &info,
                                       message.data(), message.size());
  if (film == nullptr) {
    expect(message[0] != 0);
    return 0;
  }
  check(info);
  const std::size_t count = std::min(info.frame_count, kMostRead);
  for (std::size_t k = 0; k < count; ++k) read(plugin, film, k, info);
  for (std::size_t k = count; k-- > 0;) read(plugin, film, k, info);
  read(plugin, film, info.frame_count - 1, info);
  plugin.close(film);
  return 0;
}
