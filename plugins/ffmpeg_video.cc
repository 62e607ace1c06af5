// The video plug-in: films read by FFmpeg's libraries (writing them: ffmpeg_output.cc). It is a library of its own because loading them costs 36 ms, which who
// shows no video should not pay. It finds every frame's time first, without decoding, so that a frame has a number, and then
// decodes frames by number. Pixels leave as they were decoded; colour is the library's affair (image/video_colour).
#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "ffmpeg_calls.h"
#include "ffmpeg_output.h"
#include "image/video_interface.h"

extern "C" {
#include <libavutil/imgutils.h>
#include <libavutil/log.h>
#include <libavutil/pixdesc.h>
}

namespace {

using namespace laterna_ffmpeg;

// A film further ahead than this is jumped to, where there is a key frame to start from.
constexpr std::size_t kShortWay = 16;

// What a file claims may be no value of the enumeration.
template <class Enumeration>
int code_of(const Enumeration& claimed) {
  static_assert(sizeof(Enumeration) == sizeof(int));
  int code = 0;
  std::memcpy(&code, &claimed, sizeof(code));
  return code;
}

// One packet, which becomes one frame.
struct Entry {
  std::int64_t shown, decoded;  // timestamps
  bool is_key;
};

class Film {
 public:
  Film(const char* file, std::size_t most_frames, std::int64_t most_pixels)
      : file_(file), most_frames_(most_frames), most_pixels_(most_pixels) {
    packet_.reset(require(av_packet_alloc()));
    frame_.reset(require(av_frame_alloc()));
    open();
    index();
    open();
  }

  void fill(LaternaVideoInfo& info) const {
    const AVInputFormat& container = *format_->iformat;
    info.container = container.long_name != nullptr ? container.long_name : container.name;
    info.codec = avcodec_get_name(stream().codecpar->codec_id);
    info.width = width_;
    info.height = height_;
    info.tick_numerator = stream().time_base.num;
    info.tick_denominator = stream().time_base.den;
    info.begins = begins_.data();
    info.frame_count = begins_.size();
    info.end = end_;
    info.missing_frames = missing_;
  }

  // The same pixels however the frame is reached: where a jump leads to a picture that is not whole, because the file's key
  // frames are none, the film is decoded from its beginning.
  void read(std::size_t number, LaternaVideoPicture& picture) {
    go_to(number);
    if (!decode_until(number) && has_jumped_) {
      open();
      decode_until(number);
    }
    if (at_ != number || !is_whole())
      throw Fault("frame " + std::to_string(number) + " is damaged or missing" + last_fault_);
    fill(picture);
  }

 private:
  [[nodiscard]] const AVStream& stream() const { return *format_->streams[stream_]; }

  // Before the first packet of the file, with a fresh decoder.
  void open() {
    AVFormatContext* format = require(avformat_alloc_context());
    format->flags |= AVFMT_FLAG_BITEXACT;
    AVDictionary* options = nullptr;
    // A play list may not lead to the network.
    av_dict_set(&options, "protocol_whitelist", "file", 0);
    const int opened = avformat_open_input(&format, ("file:" + file_).c_str(), nullptr, &options);
    av_dict_free(&options);
    require(opened, "FFmpeg does not read it as a film");
    format_.reset(format);
    require(avformat_find_stream_info(format, nullptr), "its streams are not to be understood");
    stream_ = av_find_best_stream(format, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
    if (stream_ < 0) throw Fault("it holds no moving picture");
    for (unsigned i = 0; i < format->nb_streams; ++i)
      format->streams[i]->discard = static_cast<int>(i) == stream_ ? AVDISCARD_DEFAULT : AVDISCARD_ALL;
    open_decoder();
    at_.reset();
    decoded_ = 0;
    is_drained_ = has_jumped_ = false;
    last_fault_.clear();
  }

  void open_decoder() {
    const AVCodecParameters& parameters = *stream().codecpar;
    const AVCodec* decoder = avcodec_find_decoder(parameters.codec_id);
    if (decoder == nullptr)
      throw Fault(std::string("FFmpeg here has no decoder for ") + avcodec_get_name(parameters.codec_id));
    codec_.reset(require(avcodec_alloc_context3(decoder)));
    require(avcodec_parameters_to_context(codec_.get(), &parameters), "its streams are not to be understood");
    codec_->pkt_timebase = stream().time_base;
    // Every processor decodes the same pixels, and crops them to the same.
    codec_->flags |= AV_CODEC_FLAG_BITEXACT | AV_CODEC_FLAG_UNALIGNED;
    codec_->idct_algo = FF_IDCT_SIMPLE;
    codec_->thread_count = 1;
    // Error concealment stays on: without it, FFmpeg marks whole H.264 frames of several slices as damaged. What it conceals, it
    // marks, and is refused (is_whole()).
    codec_->max_pixels = most_pixels_;
    require(avcodec_open2(codec_.get(), decoder, nullptr), "its decoder cannot be used");
    if (width_ == 0) width_ = codec_->width, height_ = codec_->height;
    if (width_ < 1 || height_ < 1) throw Fault("its picture has no size");
  }

  // The next packet of the film; false at its end.
  bool next_packet() {
    for (;;) {
      av_packet_unref(packet_.get());
      const int status = av_read_frame(format_.get(), packet_.get());
      if (status < 0) return false;
      if (packet_->stream_index != stream_) continue;
      // An edit list may leave frames out.
      if ((packet_->flags & AV_PKT_FLAG_DISCARD) == 0) return true;
      ++left_out_;
    }
  }

  void index() {
    std::int64_t last_duration = 0;
    std::size_t cut_short = 0;
    bool has_times = true;
    while (next_packet()) {
      // The end of a file that was cut off.
      if ((packet_->flags & AV_PKT_FLAG_CORRUPT) != 0) {
        ++cut_short;
        continue;
      }
      if (entries_.size() == most_frames_)
        throw Fault("it has more than " + std::to_string(most_frames_) + " frames");
      has_times &= packet_->dts != AV_NOPTS_VALUE || packet_->pts != AV_NOPTS_VALUE;
      is_timed_ &= packet_->pts != AV_NOPTS_VALUE;
      entries_.push_back({packet_->pts, packet_->dts, (packet_->flags & AV_PKT_FLAG_KEY) != 0});
      last_duration = std::max<std::int64_t>(packet_->duration, 0);
    }
    if (entries_.empty()) throw Fault("it holds no whole frame");
    if (!has_times)
      throw Fault(
          "its frames have no times: put them into a container, as ffmpeg -framerate 25 -i FILE FILE.mkv "
          "does");
    find_begins(last_duration);
    const auto promised = static_cast<std::size_t>(std::max<std::int64_t>(stream().nb_frames, 0));
    const std::size_t found = entries_.size() + left_out_;
    missing_ = std::max(cut_short, promised > found ? promised - found : 0);
  }

  // Frames leave the decoder in the order of the times at which they are shown. Where a container has only the times of
  // decoding, the first frame is shown at the first of them, the second at the second, and so on.
  void find_begins(std::int64_t last_duration) {
    std::vector<std::int64_t> times;
    for (const Entry& entry : entries_) {
      times.push_back(is_timed_                         ? entry.shown
                      : entry.decoded != AV_NOPTS_VALUE ? entry.decoded
                                                        : entry.shown);
    }
    std::sort(times.begin(), times.end());
    const std::int64_t most = most_ticks();
    begins_.reserve(times.size());
    for (const std::int64_t time : times) {
      // A file may claim any two times: their difference need not fit.
      const std::uint64_t since =
          static_cast<std::uint64_t>(time) - static_cast<std::uint64_t>(times.front());
      if (since > static_cast<std::uint64_t>(most))
        throw Fault("its frames lie further apart than its clock can tell");
      begins_.push_back(static_cast<std::int64_t>(since));
    }
    const std::size_t count = begins_.size();
    if (count > 1 && last_duration == 0) last_duration = begins_[count - 1] - begins_[count - 2];
    end_ = begins_.back() + std::min(last_duration, most - begins_.back());
    shown_ = std::move(times);
  }

  // Up to here ticks times the clock's numerator are whole numbers that a double holds.
  [[nodiscard]] std::int64_t most_ticks() const {
    const AVRational clock = stream().time_base;
    if (clock.num < 1 || clock.den < 1) throw Fault("its clock makes no sense");
    return ((std::int64_t{1} << 53) - 1) / clock.num;
  }

  // Number of the frame shown at a timestamp; of several, the first.
  [[nodiscard]] std::optional<std::size_t> number_at(std::int64_t timestamp) const {
    const auto found = std::lower_bound(shown_.begin(), shown_.end(), timestamp);
    if (found == shown_.end() || *found != timestamp) return std::nullopt;
    return static_cast<std::size_t>(found - shown_.begin());
  }

  // The last key frame, in the order of decoding, that is shown no later than a frame.
  [[nodiscard]] std::optional<std::size_t> key_before(std::size_t number) const {
    for (std::size_t i = entries_.size(); i-- > 0;) {
      if (entries_[i].is_key && entries_[i].shown <= shown_[number]) return i;
    }
    return std::nullopt;
  }

  void go_to(std::size_t number) {
    const bool is_behind = at_ ? number < *at_ : is_drained_;
    const bool is_far = number >= (at_ ? *at_ : 0) + kShortWay;
    if (!is_behind && !is_far) return;
    const std::optional<std::size_t> key = is_timed_ ? key_before(number) : std::nullopt;
    const std::size_t key_number = key ? number_at(entries_[*key].shown).value_or(0) : 0;
    if (!is_behind && at_ && key_number <= *at_) return;
    if (key && key_number > 0 && jump_to(entries_[*key])) return;
    if (is_behind) open();
  }

  bool jump_to(const Entry& key) {
    // Containers look for one time or the other: the earlier leads to no later key frame.
    const std::int64_t to = key.decoded == AV_NOPTS_VALUE ? key.shown : std::min(key.shown, key.decoded);
    if (av_seek_frame(format_.get(), stream_, to, AVSEEK_FLAG_BACKWARD) < 0) return false;
    avcodec_flush_buffers(codec_.get());
    at_.reset();
    is_drained_ = false;
    has_jumped_ = true;
    last_fault_.clear();
    return true;
  }

  [[nodiscard]] bool is_whole() const {
    return (frame_->flags & AV_FRAME_FLAG_CORRUPT) == 0 && frame_->decode_error_flags == 0;
  }

  // Whether the frame came out, whole.
  bool decode_until(std::size_t number) {
    while (!at_ || *at_ < number) {
      if (!decode_next()) return false;
    }
    return is_whole() && *at_ == number;
  }

  // The next frame that the index knows.
  bool decode_next() {
    for (;;) {
      const int received = avcodec_receive_frame(codec_.get(), frame_.get());
      if (received == 0) {
        if (take_number()) return true;
        continue;
      }
      if (received != AVERROR(EAGAIN)) {
        if (received != AVERROR_EOF) last_fault_ = ": " + describe(received);
        if (received != AVERROR_EOF && !is_drained_) continue;
        at_.reset();  // frame_ is empty now
        is_drained_ = true;
        return false;
      }
      const bool has_packet = !is_drained_ && next_packet();
      is_drained_ = !has_packet;
      const int sent = avcodec_send_packet(codec_.get(), has_packet ? packet_.get() : nullptr);
      if (sent < 0 && sent != AVERROR_EOF) last_fault_ = ": " + describe(sent);
    }
  }

  bool take_number() {
    if (!is_timed_) {
      if (decoded_ >= shown_.size()) return false;
      at_ = decoded_++;
      return true;
    }
    const std::int64_t time = frame_->pts != AV_NOPTS_VALUE ? frame_->pts : frame_->best_effort_timestamp;
    std::optional<std::size_t> number = number_at(time);
    if (!number) return false;
    // The second of two frames with one time.
    if (at_ && *at_ >= *number && *at_ + 1 < shown_.size() && shown_[*at_ + 1] == time) number = *at_ + 1;
    at_ = number;
    return true;
  }

  void fill(LaternaVideoPicture& picture) {
    const AVFrame& frame = *frame_;
    const auto format = static_cast<AVPixelFormat>(frame.format);
    const AVPixFmtDescriptor& description = *require(av_pix_fmt_desc_get(format));
    if (frame.width != width_ || frame.height != height_) {
      throw Fault("expected " + std::to_string(width_) + " x " + std::to_string(height_) +
                  " pixels as in the film's first frame, found " + std::to_string(frame.width) + " x " +
                  std::to_string(frame.height));
    }
    picture = {};
    picture.width = frame.width;
    picture.height = frame.height;
    picture.is_big_endian = (description.flags & AV_PIX_FMT_FLAG_BE) != 0 ? 1 : 0;
    picture.matrix = matrix(frame, description);
    picture.is_full_range = is_full_range(frame, description) ? 1 : 0;
    if (format == AV_PIX_FMT_PAL8) {
      expand_palette(picture);
    } else {
      list_components(description, picture);
    }
  }

  static Fault not_shown(const std::string& what) { return Fault("its " + what + " cannot be shown"); }

  static std::string name_of_matrix(int code) {
    const bool is_known = code >= 0 && code < AVCOL_SPC_NB;
    const char* const name = is_known ? av_color_space_name(static_cast<AVColorSpace>(code)) : nullptr;
    return name != nullptr ? name : std::to_string(code);
  }

  static LaternaVideoMatrix matrix(const AVFrame& frame, const AVPixFmtDescriptor& description) {
    const int curve = code_of(frame.color_trc);
    if (curve == AVCOL_TRC_SMPTE2084 || curve == AVCOL_TRC_ARIB_STD_B67)
      throw not_shown(std::string("high dynamic range (") + av_color_transfer_name(frame.color_trc) + ")");
    if ((description.flags & (AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_PAL)) != 0) return kVideoRgb;
    switch (code_of(frame.colorspace)) {
      case AVCOL_SPC_BT709:
        return kVideoBt709;
      case AVCOL_SPC_FCC:
      case AVCOL_SPC_BT470BG:
      case AVCOL_SPC_SMPTE170M:
        return kVideoBt601;
      case AVCOL_SPC_SMPTE240M:
        return kVideoSmpte240m;
      case AVCOL_SPC_BT2020_NCL:
        return kVideoBt2020;
      case AVCOL_SPC_UNSPECIFIED:
      case AVCOL_SPC_RGB:
        return frame.height >= 720 || frame.width >= 1280 ? kVideoBt709 : kVideoBt601;
      default:
        throw not_shown("colour matrix " + name_of_matrix(code_of(frame.colorspace)));
    }
  }

  static bool is_full_range(const AVFrame& frame, const AVPixFmtDescriptor& description) {
    if (std::strncmp(description.name, "yuvj", 4) == 0) return true;
    const int range = code_of(frame.color_range);
    if (range != AVCOL_RANGE_UNSPECIFIED) return range == AVCOL_RANGE_JPEG;
    const bool is_grey = description.nb_components < 3;
    return is_grey || (description.flags & (AV_PIX_FMT_FLAG_RGB | AV_PIX_FMT_FLAG_PAL)) != 0;
  }

  void list_components(const AVPixFmtDescriptor& description, LaternaVideoPicture& picture) const {
    constexpr std::uint64_t kOther =
        AV_PIX_FMT_FLAG_BITSTREAM | AV_PIX_FMT_FLAG_HWACCEL | AV_PIX_FMT_FLAG_FLOAT | AV_PIX_FMT_FLAG_BAYER;
    if ((description.flags & kOther) != 0 || std::strncmp(description.name, "xyz", 3) == 0)
      throw not_shown(std::string("pixel format ") + description.name);
    picture.component_count = description.nb_components;
    for (int c = 0; c < picture.component_count; ++c) {
      const AVComponentDescriptor& from = description.comp[c];
      const bool is_byte = from.shift + from.depth <= 8;
      // A byte of a big-endian word is its second.
      const int offset = from.offset + (is_byte && picture.is_big_endian != 0 ? 1 : 0);
      picture.components[c] = {frame_->data[from.plane] + offset, frame_->linesize[from.plane], from.step,
                               from.shift, from.depth};
    }
    const bool has_chroma = picture.matrix != kVideoRgb && picture.component_count > 2;
    picture.chroma_shift_x = has_chroma ? description.log2_chroma_w : 0;
    picture.chroma_shift_y = has_chroma ? description.log2_chroma_h : 0;
  }

  // Codes of a palette of 256 words 0xAARRGGBB become R, G, B and alpha.
  void expand_palette(LaternaVideoPicture& picture) {
    const auto width = static_cast<std::size_t>(width_);
    rgba_.resize(width * static_cast<std::size_t>(height_) * 4);
    std::size_t to = 0;
    for (int y = 0; y < height_; ++y) {
      const std::uint8_t* codes = frame_->data[0] + static_cast<std::ptrdiff_t>(y) * frame_->linesize[0];
      for (std::size_t x = 0; x < width; ++x, to += 4) {
        std::uint32_t word = 0;
        std::memcpy(&word, frame_->data[1] + std::size_t{4} * codes[x], 4);
        for (unsigned c = 0; c < 3; ++c) rgba_[to + c] = static_cast<std::uint8_t>(word >> (16 - 8 * c));
        rgba_[to + 3] = static_cast<std::uint8_t>(word >> 24U);
      }
    }
    picture.component_count = 4;
    for (std::size_t c = 0; c < 4; ++c)
      picture.components[c] = {rgba_.data() + c, static_cast<std::ptrdiff_t>(width * 4), 4, 0, 8};
  }

  std::string file_;
  std::size_t most_frames_;
  std::int64_t most_pixels_;
  Owned<AVFormatContext> format_;
  Owned<AVCodecContext> codec_;
  Owned<AVPacket> packet_;
  Owned<AVFrame> frame_;
  int stream_ = 0;
  int width_ = 0, height_ = 0;

  std::vector<Entry> entries_;        // in the order of decoding
  std::vector<std::int64_t> shown_;   // timestamps of frames, in their order
  std::vector<std::int64_t> begins_;  // the same from the first one on
  std::int64_t end_ = 0;
  std::size_t missing_ = 0, left_out_ = 0;
  bool is_timed_ = true;  // the container knows when frames are shown

  std::optional<std::size_t> at_;  // the frame in frame_
  std::size_t decoded_ = 0;        // frames since the beginning, where they are counted
  bool is_drained_ = false, has_jumped_ = false;
  std::string last_fault_;
  std::vector<std::uint8_t> rgba_;
};

LaternaVideoFilm* open_film(const char* file, std::size_t most_frames, std::int64_t most_pixels,
                            LaternaVideoInfo* info, char* message, std::size_t message_size) {
  Film* film = nullptr;
  caught(
      [&] {
        auto opened = std::make_unique<Film>(file, most_frames, most_pixels);
        opened->fill(*info);
        film = opened.release();
      },
      message, message_size);
  return reinterpret_cast<LaternaVideoFilm*>(film);
}

int read_frame(LaternaVideoFilm* film, std::size_t frame, LaternaVideoPicture* picture, char* message,
               std::size_t message_size) {
  return caught([&] { reinterpret_cast<Film*>(film)->read(frame, *picture); }, message, message_size) ? 1 : 0;
}

void close_film(LaternaVideoFilm* film) { delete reinterpret_cast<Film*>(film); }

std::string versions() {
  const auto text = [](const char* name, unsigned version) {
    return std::string(name) + " " + std::to_string(AV_VERSION_MAJOR(version)) + "." +
           std::to_string(AV_VERSION_MINOR(version)) + "." + std::to_string(AV_VERSION_MICRO(version));
  };
  return text("libavformat", avformat_version()) + ", " + text("libavcodec", avcodec_version()) + ", " +
         text("libavutil", avutil_version());
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const LaternaVideoPlugin* laterna_video_plugin() {
  static const std::string kVersions = versions();
  static const LaternaVideoPlugin kPlugin = [] {
    LaternaVideoPlugin plugin = {};
    plugin.interface_number = kVideoInterface;
    plugin.versions = kVersions.c_str();
    plugin.open = open_film;
    plugin.read = read_frame;
    plugin.close = close_film;
    add_output(plugin);
    return plugin;
  }();
  // What is wrong is said once, by us.
  av_log_set_level(AV_LOG_QUIET);
  return &kPlugin;
}
