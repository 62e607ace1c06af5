#include "image/video_codecs.h"

#include <array>

#include "image/file_ending.h"

namespace laterna::image {
namespace {

// A key frame every so many frames: players jump there, and what is lost of a broken file is no more.
constexpr int kUsualKeys = 60;

// Each frame is encoded before the next is taken, so that a film that is broken off lacks no frame that was drawn: without
// looking ahead, H.264 is about a fifth larger (measured: docs/sequences.md).
// The best H.264 is not its CRF of 0: that is another, lossless profile, which few players know.
constexpr std::array<CodecEntry, 5> kCodecs = {{
    {"h264", ".mp4 .mkv", "H.264, 4:2:0: plays everywhere", "libx264", "preset=medium\ntune=zerolatency",
     kVideoYuv420, 51, 1, kUsualKeys},
    {"vp9", ".webm .mkv", "VP9, 4:2:0: free, for browsers", "libvpx-vp9",
     "b=0\ndeadline=good\ncpu-used=4\nrow-mt=0\nlag-in-frames=0", kVideoYuv420, 63, 0, kUsualKeys},
    {"h265", ".mp4 .mkv", "H.265, 4:2:0: smaller files, slower", "libx265",
     "preset=medium\ntune=zerolatency\nx265-params=log-level=none:frame-threads=1", kVideoYuv420, 51, 1,
     kUsualKeys},
    {"ffv1", ".mkv", "FFV1: every bit of R, G and B as in a PNG, large files", "ffv1",
     "level=3\ncoder=range_def\nslices=4\nslicecrc=1", kVideoRgb24, 0, 0, 1},
    {"gif", ".gif", "256 colours, dithered; our own: needs no FFmpeg", "", "", kVideoRgb24, 0, 0, 0},
}};

struct Ending {
  std::string_view ending, container;
};
constexpr std::array<Ending, 4> kEndings = {
    {{".mp4", "mp4"}, {".mkv", "matroska"}, {".webm", "webm"}, {".gif", "gif"}}};

tl::unexpected<Error> fault(std::string_view file, std::string message) {
  return tl::unexpected(Error(Failure::bad_usage, Diagnostic{std::string(file), {}, std::move(message)}));
}

bool holds(const CodecEntry& codec, std::string_view ending) {
  return (std::string(codec.endings) + " ").find(std::string(ending) + " ") != std::string::npos;
}

}  // namespace

std::span<const CodecEntry> codec_entries() { return kCodecs; }

std::string_view container_for(std::string_view file) {
  for (const Ending& entry : kEndings) {
    if (has_ending(file, entry.ending)) return entry.container;
  }
  return {};
}

Result<const CodecEntry*> find_codec(std::string_view file, std::string_view name) {
  std::string_view ending;
  for (const Ending& entry : kEndings) {
    if (has_ending(file, entry.ending)) ending = entry.ending;
  }
  if (ending.empty()) return fault(file, "the name of a film must end in .mp4, .mkv, .webm or .gif");
  std::string fitting, all;
  for (const CodecEntry& codec : kCodecs) {
    const bool fits = holds(codec, ending);
    if (fits && (name.empty() || name == codec.name)) return &codec;
    if (fits) fitting += (fitting.empty() ? "" : ", ") + std::string(codec.name);
    all += (all.empty() ? "" : ", ") + std::string(codec.name);
    if (name == codec.name) {
      return fault(file, "a " + std::string(ending) + " file does not hold " + std::string(name) +
                             "; give a file that ends in " + std::string(codec.endings));
    }
  }
  return fault(file, "there is no codec \"" + std::string(name) + "\"; there are " + all + ", and a " +
                         std::string(ending) + " file holds " + fitting);
}

}  // namespace laterna::image
