// Animated GIFs: every frame on the whole canvas, as browsers show them.
#include <algorithm>
#include <utility>

#include "image/frame_reader.h"
#include "image/gif_stream.h"

namespace laterna::image {
namespace {

// Browsers take delays of 0 and 1 for mistakes, and wait this long; files are made with that in mind.
constexpr unsigned kLeastDelay = 2, kUsualDelay = 10;

class GifReader final : public FrameReader {
 public:
  GifReader(std::vector<std::byte> encoded, std::string name)
      : bytes_(std::move(encoded)), name_(std::move(name)) {}

  // The frames are found, and none is decoded.
  Result<void> open() {
    const Result<ImageHeader> header = read_checked_header(kGifDecoder, picture());
    if (!header) return tl::unexpected(header.error());
    ByteReader in(bytes_);
    canvas_ = read_gif_canvas(in);
    if (Result<void> found = find_frames(in); !found) return found;
    std::uint64_t hundredths = 0;
    for (const Place& frame : frames_) {
      times_.begins.push_back(seconds_from_ticks(static_cast<std::int64_t>(hundredths), 1, 100));
      hundredths += frame.delay < kLeastDelay ? kUsualDelay : frame.delay;
    }
    times_.duration = seconds_from_ticks(static_cast<std::int64_t>(hundredths), 1, 100);
    header_ = {"GIF", header->width, header->height, frames_.size(), times_.duration};
    return {};
  }

  Result<Image> read(std::size_t number) override {
    if (next_ == 0 || number + 1 < next_) start_over();
    while (next_ <= number) {
      if (Result<void> drawn = draw_next(); !drawn) {
        next_ = 0;
        return tl::unexpected(std::move(drawn.error()));
      }
    }
    return canvas_picture_;
  }

 private:
  struct Place {
    std::size_t begins_at;  // byte
    unsigned delay;
  };
  [[nodiscard]] EncodedPicture picture() const { return {bytes_, name_}; }

  // A file that ends early, or goes on with something else, is a film up to there.
  Result<void> find_frames(ByteReader& in) {
    while (frames_.size() < kMaxFilmFrames) {
      const std::size_t begins_at = in.position();
      Result<std::optional<GifFrame>> frame = read_gif_frame(picture(), canvas_, frames_.size(), in);
      if (frame && !*frame) return {};
      Error fault;
      if (frame) {
        skip_gif_pixels(in);
        if (!in.ran_out()) {
          frames_.push_back({begins_at, (*frame)->delay});
          continue;
        }
        fault = ends_early(picture(), (*frame)->name).value();
      } else {
        fault = std::move(frame.error());
      }
      if (frames_.empty()) return tl::unexpected(std::move(fault));
      Diagnostic warning = std::move(fault.diagnostics.front());
      warning.message += ": the film has " + std::to_string(frames_.size()) +
                         (frames_.size() == 1 ? " whole frame" : " whole frames");
      warnings_.push_back(std::move(warning));
      return {};
    }
    return unreadable(
        picture(), {},
        "there are more than " + std::to_string(kMaxFilmFrames) + " frames, the most that a film may have");
  }

  void start_over() {
    canvas_picture_ = Image(header_.width, header_.height, 4, PixelType::u8, Transfer::srgb);
    next_ = 0;
  }

  // What the last frame leaves, and the next one over it.
  Result<void> draw_next() {
    if (next_ > 0) dispose(last_drawn_);
    ByteReader in(bytes_);
    in.skip(frames_[next_].begins_at);
    Result<std::optional<GifFrame>> frame = read_gif_frame(picture(), canvas_, next_, in);
    if (!frame) return tl::unexpected(std::move(frame.error()));
    last_drawn_ = std::move(**frame);
    if (last_drawn_.disposal == GifDisposal::restore) before_ = canvas_picture_;
    ++next_;
    return draw_gif_frame(picture(), canvas_, last_drawn_, in, canvas_picture_.values<std::uint8_t>());
  }

  void dispose(const GifFrame& frame) {
    if (frame.disposal == GifDisposal::keep) return;
    if (frame.disposal == GifDisposal::restore) {
      canvas_picture_ = std::move(before_);
      return;
    }
    // To transparent, not to the background colour that the file names: nobody does that.
    const std::span<std::uint8_t> rgba = canvas_picture_.values<std::uint8_t>();
    for (std::size_t y = 0; y < frame.height; ++y) {
      const std::size_t at = ((frame.top + y) * canvas_.width + frame.left) * 4;
      std::fill_n(rgba.begin() + static_cast<std::ptrdiff_t>(at), frame.width * 4, std::uint8_t{0});
    }
  }

  std::vector<std::byte> bytes_;
  std::string name_;
  GifCanvas canvas_;
  std::vector<Place> frames_;
  Image canvas_picture_;  // with frames 0 … next_ − 1 drawn
  GifFrame last_drawn_;   // frame next_ − 1
  Image before_;          // what it is drawn over, where that is to be restored
  std::size_t next_ = 0;
};

}  // namespace

OpenedFilm open_gif(std::vector<std::byte> encoded, std::string name) {
  auto reader = std::make_unique<GifReader>(std::move(encoded), std::move(name));
  if (Result<void> opened = reader->open(); !opened) return tl::unexpected(std::move(opened.error()));
  return reader;
}

}  // namespace laterna::image
