// Video files: frames by the plug-in, colours by us.
#include <array>
#include <memory>
#include <utility>

#include "image/frame_reader.h"
#include "image/video_colour.h"
#include "image/video_plugin.h"

namespace laterna::image {
namespace {

constexpr std::size_t kMessageSize = 512;

class VideoReader final : public FrameReader {
 public:
  VideoReader(const LaternaVideoPlugin& plugin, std::string name)
      : plugin_(plugin), name_(std::move(name)), film_(nullptr, plugin.close) {}

  Result<void> open() {
    LaternaVideoInfo info = {};
    film_.reset(plugin_.open(name_.c_str(), kMaxFilmFrames, kMaxImagePixels, &info, message_.data(),
                             message_.size()));
    if (film_ == nullptr) return fault({}, message_.data());
    if (info.width > kMaxImageSide || info.height > kMaxImageSide) {
      return fault({}, "its frames are " + std::to_string(info.width) + " x " + std::to_string(info.height) +
                           " pixels; at most " + std::to_string(kMaxImageSide) + " per side are read");
    }
    const auto seconds = [&](std::int64_t ticks) {
      return seconds_from_ticks(ticks, info.tick_numerator, info.tick_denominator);
    };
    for (std::size_t i = 0; i < info.frame_count; ++i) times_.begins.push_back(seconds(info.begins[i]));
    times_.duration = seconds(info.end);
    header_ = {std::string(info.container) + ", " + info.codec, info.width, info.height, info.frame_count,
               times_.duration};
    if (info.missing_frames > 0) {
      warnings_.push_back({name_,
                           {},
                           "the film ends early, after " + std::to_string(info.frame_count) + " of " +
                               std::to_string(info.frame_count + info.missing_frames) + " frames"});
    }
    return {};
  }

  Result<Image> read(std::size_t number) override {
    LaternaVideoPicture picture = {};
    if (plugin_.read(film_.get(), number, &picture, message_.data(), message_.size()) != 0)
      return colour_.convert(picture);
    return fault("at " + seconds_text(times_.begins[number]) + " s", message_.data());
  }

 private:
  [[nodiscard]] tl::unexpected<Error> fault(std::string place, std::string message) const {
    return tl::unexpected(Error(Failure::bad_input, Diagnostic{name_, std::move(place), std::move(message)}));
  }

  static std::string seconds_text(double seconds) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3f", seconds);
    return text.data();
  }

  const LaternaVideoPlugin& plugin_;
  std::string name_;
  std::unique_ptr<LaternaVideoFilm, void (*)(LaternaVideoFilm*)> film_;
  VideoColour colour_;
  std::array<char, kMessageSize> message_{};
};

}  // namespace

OpenedFilm open_video(const std::filesystem::path& file) {
  const LoadedVideoPlugin& loaded = video_plugin();
  if (loaded.plugin == nullptr)
    return tl::unexpected(Error(Failure::bad_input, Diagnostic{file.string(), {}, loaded.fault}));
  auto reader = std::make_unique<VideoReader>(*loaded.plugin, file.string());
  if (Result<void> opened = reader->open(); !opened) return tl::unexpected(std::move(opened.error()));
  return reader;
}

}  // namespace laterna::image
