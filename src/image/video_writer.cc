// Films out: checks, the choice of an encoder, and files that are whole or absent.
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "base/output_file.h"
#include "base/without_exceptions.h"
#include "image/encoder.h"
#include "image/gif_encode.h"
#include "image/layers.h"
#include "image/video_codecs.h"
#include "image/video_encoder.h"
#include "image/video_plugin.h"
#include "laterna/film.h"
#include "laterna/video.h"

namespace laterna::image {
namespace {

constexpr int kMostGifSide = 65535;

// An MP4 file cannot be read without its index, which is complete when the film is. While it grows it is in fragments, one for each
// frame, with an index each (ISO/IEC 14496-12, 8.8): it can be read whenever it is broken off. Not all players like such files, so
// that a film that is finished is written once more in one piece, with its index at its beginning.
constexpr const char* kMp4InFragments = "movflags=empty_moov+default_base_moof+frag_custom";

// Bytes of an MP4 file's index (ISO/IEC 14496-12, 8.6 and 8.7): of all frames, and of each, which may have an entry in each of
// the tables of times (8 bytes), offsets of composition (8), key frames (4), sizes (4), chunks (12) and their places (8).
constexpr std::int64_t kIndexBase = 8192, kIndexPerFrame = 44;

tl::unexpected<Error> fault(const std::string& name, std::string message,
                            Failure failure = Failure::bad_usage) {
  return tl::unexpected(Error(failure, Diagnostic{name, {}, std::move(message)}));
}

Error memory_exhausted(const std::string& name) {
  return {Failure::cannot_write, Diagnostic{name, {}, "not enough memory to encode the film"}};
}

std::string find_rate_fault(const VideoRate& rate, bool is_gif) {
  const double per_second = static_cast<double>(rate.numerator) / rate.denominator;
  if (rate.numerator < 1 || rate.denominator < 1 || per_second > kMaxFramesPerSecond) {
    return fmt::format("expected frames per second greater than 0, at most {:g}, got {}/{}",
                       kMaxFramesPerSecond, rate.numerator, rate.denominator);
  }
  if (is_gif && per_second > kMostGifFramesPerSecond) {
    return fmt::format("a GIF shows at most {} frames per second, got {:g}", kMostGifFramesPerSecond,
                       per_second);
  }
  return {};
}

std::string find_size_fault(const CodecEntry& codec, int width, int height) {
  const bool is_gif = codec.encoder.empty();
  const int most = is_gif ? kMostGifSide : kMaxImageSide;
  if (width < 1 || height < 1 || width > most || height > most)
    return fmt::format("expected a size from 1 x 1 to {} x {} pixels, got {} x {}", most, most, width,
                       height);
  if (codec.pixels != kVideoYuv420 || (width % 2 == 0 && height % 2 == 0)) return {};
  return fmt::format(
      "{} keeps one colour for 2 x 2 pixels, so that width and height must be even, got {} x {}: take {} x "
      "{}, or "
      "the codec ffv1",
      codec.name, width, height, width + width % 2, height + height % 2);
}

struct Plan {
  const CodecEntry* codec;
  const LaternaVideoPlugin* plugin;  // null: none is needed
};

Result<Plan> plan(const std::string& name, int width, int height, const VideoOptions& options) {
  const Result<const CodecEntry*> codec = find_codec(name, options.codec);
  if (!codec) return tl::unexpected(codec.error());
  const bool is_gif = (*codec)->encoder.empty();
  if (std::string text = find_rate_fault(options.rate, is_gif); !text.empty())
    return fault(name, std::move(text));
  if (std::string text = find_size_fault(**codec, width, height); !text.empty())
    return fault(name, std::move(text));
  if (options.most_frames < 0 || options.most_frames > kMaxVideoFrames) {
    return fault(name, fmt::format("the number of frames must be from 0 to {}, not {}", kMaxVideoFrames,
                                   options.most_frames));
  }
  if (!(options.quality >= 0 && options.quality <= 100))
    return fault(name, fmt::format("expected a quality from 0 to 100, got {:g}", options.quality));
  if (is_gif) return Plan{*codec, nullptr};
  const LoadedVideoPlugin& loaded = video_plugin();
  if (loaded.plugin == nullptr) return fault(name, loaded.fault);
  const std::string encoder((*codec)->encoder);
  if (loaded.plugin->can_write(std::string(container_for(name)).c_str(), encoder.c_str()) == 0) {
    return fault(
        name, fmt::format("FFmpeg here has no encoder {}, which {} needs: laterna render --list-codecs tells "
                          "what there is",
                          encoder, (*codec)->name));
  }
  return Plan{*codec, loaded.plugin};
}

Result<void> check_place(const std::filesystem::path& file) {
  std::error_code ignored;
  const bool is_there = std::filesystem::exists(file, ignored);
  // Containers are filled in from the beginning when they are complete.
  if (is_there && !std::filesystem::is_regular_file(file, ignored) &&
      !std::filesystem::is_directory(file, ignored))
    return fault(file.string(), "a film is written to a regular file, not to a pipe or device");
  return {};
}

VideoEncoding encoding_of(const CodecEntry& codec, const std::string& name, int width, int height,
                          const VideoOptions& options) {
  VideoEncoding encoding;
  encoding.container = container_for(name);
  encoding.encoder = codec.encoder;
  encoding.options = codec.options;
  if (codec.has_quality()) {
    const double factor =
        codec.worst_rate_factor + (codec.best_rate_factor - codec.worst_rate_factor) * options.quality / 100;
    encoding.options += fmt::format("\ncrf={}", std::lround(factor));
  }
  if (encoding.container == "mp4") encoding.container_options = kMp4InFragments;
  encoding.pixels = codec.pixels;
  encoding.width = width;
  encoding.height = height;
  encoding.rate_numerator = options.rate.numerator;
  encoding.rate_denominator = options.rate.denominator;
  encoding.frames_between_keys = codec.frames_between_keys;
  return encoding;
}

std::filesystem::path incomplete_name(const std::filesystem::path& file) {
  return file.parent_path() / (file.stem().string() + ".incomplete" + file.extension().string());
}

}  // namespace
}  // namespace laterna::image

namespace laterna {

struct VideoWriter::Implementation {
  std::filesystem::path file;
  int width, height;
  const LaternaVideoPlugin* plugin;  // null: none is needed
  std::optional<OutputFile> output;
  std::unique_ptr<image::FilmEncoder> encoder;  // goes before what it writes to
  std::int64_t most_frames;                     // 0: not known
  std::int64_t frames = 0;
  std::uint64_t whole_bytes = 0;  // of the file, with all frames that are whole

  // An MP4 file's fragments, joined. False: there is no room for both.
  bool place_as_one_piece() {
    Result<OutputFile> whole = OutputFile::create(file);
    if (!whole) return false;
    const std::string room = fmt::format("moov_size={}", image::kIndexBase + image::kIndexPerFrame * frames);
    const bool is_placed =
        image::rearrange_video(*plugin, output->path(), *whole, "mp4", room, file.string()) &&
        whole->commit();
    if (!is_placed) return false;
    encoder.reset();
    output.reset();
    return true;
  }
};

VideoWriter::VideoWriter(std::unique_ptr<Implementation> implementation)
    : implementation_(std::move(implementation)) {}
VideoWriter::~VideoWriter() = default;
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;

Result<VideoWriter> VideoWriter::create(const std::filesystem::path& file, int width, int height,
                                        const VideoOptions& options) {
  const std::string name = file.string();
  return without_exceptions(image::memory_exhausted(name), [&]() -> Result<VideoWriter> {
    const Result<image::Plan> plan = image::plan(name, width, height, options);
    if (!plan) return tl::unexpected(plan.error());
    if (const Result<void> place = image::check_place(file); !place) return tl::unexpected(place.error());
    Result<OutputFile> output = OutputFile::create(file);
    if (!output) return tl::unexpected(std::move(output.error()));
    auto made = std::make_unique<Implementation>(
        Implementation{file, width, height, plan->plugin, std::move(*output), nullptr, options.most_frames});
    if (plan->plugin == nullptr) {
      made->encoder = image::make_gif_encoder(*made->output, width, height, options.rate);
    } else {
      auto encoder = image::make_video_encoder(
          *plan->plugin, *made->output, image::encoding_of(*plan->codec, name, width, height, options), name);
      if (!encoder) return tl::unexpected(std::move(encoder.error()));
      made->encoder = std::move(*encoder);
    }
    return VideoWriter(std::move(made));
  });
}

Result<void> VideoWriter::write(const Image& frame) {
  Implementation& film = *implementation_;
  const std::string name = film.file.string();
  if (frame.width() != film.width || frame.height() != film.height || frame.channels() != 3 ||
      frame.type() != PixelType::u8) {
    return image::fault(
        name,
        fmt::format(
            "expected frames of {} x {} pixels, R, G and B of 8 bits each, got {} x {} with {} channels",
            film.width, film.height, frame.width(), frame.height(), frame.channels()));
  }
  if (film.most_frames > 0 && film.frames == film.most_frames)
    return image::fault(name, fmt::format("the film was to have at most {} frames", film.most_frames));
  return without_exceptions(image::memory_exhausted(name), [&]() -> Result<void> {
    Result<void> written = film.encoder->write(frame);
    if (!written) return written;
    const Result<std::uint64_t> size = film.output->size();
    if (!size) return tl::unexpected(size.error());
    ++film.frames;
    film.whole_bytes = *size;
    return {};
  });
}

Result<void> VideoWriter::write(const LayeredImage& picture, float exposure, int threads) {
  const std::string name = implementation_->file.string();
  return without_exceptions(image::memory_exhausted(name), [&]() -> Result<void> {
    if (std::string text = image::find_picture_fault(picture); !text.empty())
      return image::fault(name, std::move(text));
    const Result<Image> pixels = image::screen_pixels(picture, exposure, threads, name);
    return pixels ? write(*pixels) : tl::unexpected(pixels.error());
  });
}

std::int64_t VideoWriter::frames() const { return implementation_->frames; }

Result<void> VideoWriter::finish() {
  Implementation& film = *implementation_;
  const std::string name = film.file.string();
  if (film.frames == 0) return image::fault(name, "a film needs at least one frame");
  return without_exceptions(image::memory_exhausted(name), [&]() -> Result<void> {
    Result<void> finished = film.encoder->finish();
    if (!finished) return finished;
    // Fragments are the film, too.
    if (image::container_for(name) == "mp4" && film.place_as_one_piece()) return {};
    return film.output->commit();
  });
}

Result<std::filesystem::path> VideoWriter::keep_incomplete() {
  Implementation& film = *implementation_;
  const std::string name = film.file.string();
  return without_exceptions(image::memory_exhausted(name), [&]() -> Result<std::filesystem::path> {
    if (film.frames == 0) return image::fault(name, "there is no frame to keep", Failure::cannot_write);
    // Where the end cannot be written, players do without it, but not all with half a frame.
    if (!film.encoder->finish()) {
      if (const Result<void> cut = film.output->truncate(film.whole_bytes); !cut)
        return tl::unexpected(cut.error());
    }
    const std::filesystem::path other = image::incomplete_name(film.file);
    if (const Result<void> kept = film.output->commit_as(other); !kept) return tl::unexpected(kept.error());
    return other;
  });
}

Result<void> check_video_output(const std::filesystem::path& file, int width, int height,
                                const VideoOptions& options) {
  const Result<VideoWriter> writer = VideoWriter::create(file, width, height, options);
  if (!writer) return tl::unexpected(writer.error());
  return {};
}

bool is_video_output(const std::filesystem::path& file) {
  return !image::container_for(file.string()).empty();
}

std::vector<VideoCodec> list_video_codecs() {
  std::vector<VideoCodec> codecs;
  const LaternaVideoPlugin* const plugin = image::video_plugin().plugin;
  for (const image::CodecEntry& entry : image::codec_entries()) {
    const std::string container(image::container_for(entry.endings.substr(0, entry.endings.find(' '))));
    const bool is_there =
        entry.encoder.empty() ||
        (plugin != nullptr && plugin->can_write(container.c_str(), std::string(entry.encoder).c_str()) != 0);
    codecs.push_back({entry.name, entry.endings, entry.meaning, entry.encoder, is_there});
  }
  return codecs;
}

}  // namespace laterna
