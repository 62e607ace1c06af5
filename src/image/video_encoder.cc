#include "image/video_encoder.h"

#include <algorithm>
#include <array>
#include <optional>

#include "image/video_planes.h"

namespace laterna::image {
namespace {

constexpr std::size_t kMessageSize = 512;

// What FFmpeg writes, on its way to the file.
class Sink {
 public:
  explicit Sink(OutputFile& file) : file_(file) {}
  [[nodiscard]] LaternaVideoSink calls() { return {this, &Sink::receive}; }
  [[nodiscard]] const std::optional<Error>& fault() const { return fault_; }

 private:
  // To FFmpeg a full disk seems endless, so that it still fills in what containers leave open at their beginning: sizes, an
  // index. What lies beyond the end is lost, and fault() tells.
  static int receive(void* to, std::int64_t offset, const std::uint8_t* bytes, std::size_t size) {
    auto& self = *static_cast<Sink*>(to);
    const auto begin = static_cast<std::uint64_t>(offset);
    if (self.fault_ && begin + size > self.end_) return 0;
    Result<void> written = self.file_.write_at(begin, std::as_bytes(std::span(bytes, size)));
    if (written) {
      self.end_ = std::max(self.end_, begin + size);
    } else if (!self.fault_) {
      self.fault_ = std::move(written.error());
    }
    return 0;
  }

  OutputFile& file_;
  std::optional<Error> fault_;
  std::uint64_t end_ = 0;
};

class VideoEncoder final : public FilmEncoder {
 public:
  VideoEncoder(const LaternaVideoPlugin& plugin, OutputFile& output, const VideoEncoding& encoding,
               std::string name)
      : plugin_(plugin),
        sink_(output),
        pixels_(encoding.pixels),
        name_(std::move(name)),
        planes_(encoding.width, encoding.height),
        output_(nullptr, plugin.discard) {}

  Result<void> open(const VideoEncoding& encoding) {
    LaternaVideoSettings settings = {};
    settings.container = encoding.container.c_str();
    settings.encoder = encoding.encoder.c_str();
    settings.options = encoding.options.c_str();
    settings.container_options = encoding.container_options.c_str();
    settings.width = encoding.width;
    settings.height = encoding.height;
    settings.pixels = encoding.pixels;
    settings.rate_numerator = encoding.rate_numerator;
    settings.rate_denominator = encoding.rate_denominator;
    settings.frames_between_keys = encoding.frames_between_keys;
    const LaternaVideoSink sink = sink_.calls();
    output_.reset(plugin_.create(&settings, &sink, message_.data(), message_.size()));
    return output_ != nullptr ? Result<void>() : fault(Failure::bad_usage);
  }

  Result<void> write(const Image& frame) override {
    LaternaVideoPlanes planes = {};
    if (pixels_ == kVideoRgb24) {
      planes.data[0] = frame.values<std::uint8_t>().data();
      planes.stride[0] = static_cast<std::ptrdiff_t>(frame.width()) * 3;
    } else {
      planes_.convert(frame);
      std::size_t i = 0;
      for (const VideoPlanes::Plane* plane : {&planes_.y(), &planes_.cb(), &planes_.cr()}) {
        planes.data[i] = plane->values.data();
        planes.stride[i++] = plane->width;
      }
    }
    return outcome(plugin_.write(output_.get(), &planes, message_.data(), message_.size()));
  }

  Result<void> finish() override {
    return outcome(plugin_.finish(output_.get(), message_.data(), message_.size()));
  }

 private:
  [[nodiscard]] Result<void> outcome(int has_worked) const {
    return has_worked != 0 && !sink_.fault() ? Result<void>() : fault(Failure::cannot_write);
  }

  // What the file said says more than what FFmpeg made of it.
  [[nodiscard]] tl::unexpected<Error> fault(Failure failure) const {
    if (sink_.fault()) return tl::unexpected(*sink_.fault());
    return tl::unexpected(Error(failure, Diagnostic{name_, {}, message_.data()}));
  }

  const LaternaVideoPlugin& plugin_;
  Sink sink_;
  LaternaVideoPixels pixels_;
  std::string name_;
  VideoPlanes planes_;
  std::array<char, kMessageSize> message_{};
  std::unique_ptr<LaternaVideoOutput, void (*)(LaternaVideoOutput*)> output_;
};

}  // namespace

Result<std::unique_ptr<FilmEncoder>> make_video_encoder(const LaternaVideoPlugin& plugin, OutputFile& output,
                                                        const VideoEncoding& encoding,
                                                        const std::string& name) {
  auto encoder = std::make_unique<VideoEncoder>(plugin, output, encoding, name);
  if (Result<void> opened = encoder->open(encoding); !opened)
    return tl::unexpected(std::move(opened.error()));
  return encoder;
}

Result<void> rearrange_video(const LaternaVideoPlugin& plugin, const std::filesystem::path& file,
                             OutputFile& output, const std::string& container,
                             const std::string& container_options, const std::string& name) {
  Sink sink(output);
  const LaternaVideoSink calls = sink.calls();
  std::array<char, kMessageSize> message{};
  const bool has_worked = plugin.rearrange(file.c_str(), container.c_str(), container_options.c_str(), &calls,
                                           message.data(), message.size()) != 0;
  if (sink.fault()) return tl::unexpected(*sink.fault());
  if (has_worked) return {};
  return tl::unexpected(Error(Failure::cannot_write, Diagnostic{name, {}, message.data()}));
}

}  // namespace laterna::image
