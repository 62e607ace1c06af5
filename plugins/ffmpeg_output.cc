#include "ffmpeg_output.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "ffmpeg_calls.h"

extern "C" {
#include <libavutil/dict.h>
#include <libavutil/pixdesc.h>
}

namespace laterna_ffmpeg {
namespace {

constexpr int kBufferSize = 1 << 16;
// Not one for each processor: some encoders' files depend on the number.
constexpr int kEncoderThreads = 4;

struct FreeOutput {
  void operator()(AVFormatContext* p) const {
    if (p->pb != nullptr) {
      av_freep(&p->pb->buffer);
      avio_context_free(&p->pb);
    }
    avformat_free_context(p);
  }
};

// Lines "key=value". What is left in it has not been understood.
struct Options {
  AVDictionary* all = nullptr;

  explicit Options(const char* lines) {
    require(av_dict_parse_string(&all, lines, "=", "\n", 0), "options that cannot be read");
  }
  Options(const Options&) = delete;
  Options& operator=(const Options&) = delete;
  ~Options() { av_dict_free(&all); }

  void require_read() const {
    const AVDictionaryEntry* const unread = av_dict_get(all, "", nullptr, AV_DICT_IGNORE_SUFFIX);
    if (unread != nullptr) throw Fault(std::string("FFmpeg here does not know the option ") + unread->key);
  }
};

// A file of one stream, as the muxer writes it.
class Container {
 public:
  Container(const char* name, const LaternaVideoSink& sink) : sink_(sink) {
    AVFormatContext* format = nullptr;
    require(avformat_alloc_output_context2(&format, nullptr, name, nullptr),
            "FFmpeg here does not write such files");
    format_.reset(format);
    format->flags |= AVFMT_FLAG_CUSTOM_IO | AVFMT_FLAG_BITEXACT;
    open_sink();
    require(avformat_new_stream(format, nullptr));
  }
  Container(const Container&) = delete;
  Container& operator=(const Container&) = delete;

  [[nodiscard]] AVStream& stream() const { return *format_->streams[0]; }
  [[nodiscard]] bool wants_global_header() const {
    return (format_->oformat->flags & AVFMT_GLOBALHEADER) != 0;
  }

  void begin(const char* options_lines) {
    Options options(options_lines);
    require(avformat_write_header(format_.get(), &options.all), "the file's beginning cannot be written");
    options.require_read();
  }

  // Its times in `time_base`.
  void write(AVPacket& packet, AVRational time_base) {
    packet.stream_index = 0;
    packet.pos = -1;
    av_packet_rescale_ts(&packet, time_base, stream().time_base);
    require(av_interleaved_write_frame(format_.get(), &packet), "a frame cannot be written");
  }

  // What was written can be read, whatever happens now: Matroska ends its cluster, MP4 its fragment.
  void end_part() {
    require(av_write_frame(format_.get(), nullptr), "a frame cannot be written");
    flush("a frame cannot be written");
  }

  void finish() {
    require(av_write_trailer(format_.get()), "the file's end cannot be written");
    flush("the file's end cannot be written");
  }

 private:
  void open_sink() {
    auto* const buffer = static_cast<unsigned char*>(av_malloc(kBufferSize));
    if (buffer == nullptr) throw std::bad_alloc();
    format_->pb =
        avio_alloc_context(buffer, kBufferSize, 1, this, nullptr, &Container::write_bytes, &Container::seek);
    if (format_->pb == nullptr) {
      av_free(buffer);
      throw std::bad_alloc();
    }
  }

  static int write_bytes(void* self, std::uint8_t* bytes, int size) {
    Container& container = *static_cast<Container*>(self);
    const int fault =
        container.sink_.write(container.sink_.to, container.position_, bytes, static_cast<std::size_t>(size));
    if (fault != 0) return AVERROR(fault);
    container.position_ += size;
    container.end_ = std::max(container.end_, container.position_);
    return size;
  }

  static std::int64_t seek(void* self, std::int64_t offset, int whence) {
    Container& container = *static_cast<Container*>(self);
    if (whence == AVSEEK_SIZE) return container.end_;
    if (whence == SEEK_CUR) offset += container.position_;
    if (whence == SEEK_END) offset += container.end_;
    if (offset < 0) return AVERROR(EINVAL);
    container.position_ = offset;
    return offset;
  }

  // A full disk may show only in what is buffered.
  void flush(const char* doing) {
    avio_flush(format_->pb);
    require(format_->pb->error, doing);
  }

  LaternaVideoSink sink_;
  std::unique_ptr<AVFormatContext, FreeOutput> format_;
  std::int64_t position_ = 0, end_ = 0;
};

class Output {
 public:
  Output(const LaternaVideoSettings& settings, const LaternaVideoSink& sink)
      : settings_(settings), container_(settings.container, sink) {
    frame_.reset(require(av_frame_alloc()));
    packet_.reset(require(av_packet_alloc()));
    open_encoder();
    open_stream();
    container_.begin(settings.container_options);
  }

  void write(const LaternaVideoPlanes& planes) {
    frame_->format = codec_->pix_fmt;
    frame_->width = codec_->width;
    frame_->height = codec_->height;
    require(av_frame_get_buffer(frame_.get(), 0), "no memory for a frame");
    fill(planes);
    frame_->pts = frames_++;
    frame_->color_range = codec_->color_range;
    frame_->colorspace = codec_->colorspace;
    frame_->color_primaries = codec_->color_primaries;
    frame_->color_trc = codec_->color_trc;
    frame_->chroma_location = codec_->chroma_sample_location;
    const int sent = avcodec_send_frame(codec_.get(), frame_.get());
    av_frame_unref(frame_.get());
    require(sent, "the encoder refuses a frame");
    write_packets();
  }

  void finish() {
    require(avcodec_send_frame(codec_.get(), nullptr), "the encoder cannot end the film");
    write_packets();
    container_.finish();
  }

 private:
  void open_encoder() {
    const AVCodec* const encoder = avcodec_find_encoder_by_name(settings_.encoder);
    if (encoder == nullptr) throw Fault(std::string("FFmpeg here has no encoder ") + settings_.encoder);
    codec_.reset(require(avcodec_alloc_context3(encoder)));
    AVCodecContext& codec = *codec_;
    const bool is_rgb = settings_.pixels == kVideoRgb24;
    codec.width = settings_.width;
    codec.height = settings_.height;
    codec.pix_fmt = is_rgb ? AV_PIX_FMT_BGR0 : AV_PIX_FMT_YUV420P;
    codec.time_base = {settings_.rate_denominator, settings_.rate_numerator};
    codec.framerate = {settings_.rate_numerator, settings_.rate_denominator};
    codec.sample_aspect_ratio = {1, 1};
    codec.color_range = is_rgb ? AVCOL_RANGE_JPEG : AVCOL_RANGE_MPEG;
    codec.colorspace = is_rgb ? AVCOL_SPC_RGB : AVCOL_SPC_BT709;
    codec.color_primaries = AVCOL_PRI_BT709;
    codec.color_trc = AVCOL_TRC_IEC61966_2_1;
    codec.chroma_sample_location = is_rgb ? AVCHROMA_LOC_UNSPECIFIED : AVCHROMA_LOC_CENTER;
    codec.gop_size = settings_.frames_between_keys;
    codec.thread_count = kEncoderThreads;
    codec.flags |= AV_CODEC_FLAG_BITEXACT;
    if (container_.wants_global_header()) codec.flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    Options options(settings_.options);
    require(avcodec_open2(codec_.get(), encoder, &options.all), "the encoder cannot be used");
    options.require_read();
  }

  void open_stream() {
    AVStream& stream = container_.stream();
    stream.time_base = codec_->time_base;
    stream.avg_frame_rate = codec_->framerate;
    require(avcodec_parameters_from_context(stream.codecpar, codec_.get()), "the film's properties");
  }

  void fill(const LaternaVideoPlanes& planes) {
    if (settings_.pixels == kVideoRgb24) return fill_rgb(planes);
    for (int plane = 0; plane < 3; ++plane) {
      const int rows = plane == 0 ? settings_.height : settings_.height / 2;
      const auto size = static_cast<std::size_t>(plane == 0 ? settings_.width : settings_.width / 2);
      for (int y = 0; y < rows; ++y) {
        std::memcpy(frame_->data[plane] + static_cast<std::ptrdiff_t>(y) * frame_->linesize[plane],
                    planes.data[plane] + y * planes.stride[plane], size);
      }
    }
  }

  void fill_rgb(const LaternaVideoPlanes& planes) {
    for (int y = 0; y < settings_.height; ++y) {
      const std::uint8_t* from = planes.data[0] + y * planes.stride[0];
      std::uint8_t* to = frame_->data[0] + static_cast<std::ptrdiff_t>(y) * frame_->linesize[0];
      for (int x = 0; x < settings_.width; ++x, from += 3, to += 4) {
        to[0] = from[2];
        to[1] = from[1];
        to[2] = from[0];
        to[3] = 0;
      }
    }
  }

  void write_packets() {
    for (;;) {
      const int received = avcodec_receive_packet(codec_.get(), packet_.get());
      if (received == AVERROR(EAGAIN) || received == AVERROR_EOF) break;
      require(received, "the encoder fails");
      packet_->duration = 1;
      container_.write(*packet_, codec_->time_base);
      container_.end_part();
    }
  }

  LaternaVideoSettings settings_;
  Container container_;
  Owned<AVCodecContext> codec_;
  Owned<AVFrame> frame_;
  Owned<AVPacket> packet_;
  std::int64_t frames_ = 0;
};

// From one container to another: nothing is decoded.
void rearrange_film(const char* file, const char* container_name, const char* container_options,
                    const LaternaVideoSink& sink) {
  AVFormatContext* opened = nullptr;
  require(avformat_open_input(&opened, file, nullptr, nullptr), "the film's frames cannot be read");
  const Owned<AVFormatContext> from(opened);
  require(avformat_find_stream_info(from.get(), nullptr), "the film's frames cannot be read");
  if (from->nb_streams != 1) throw Fault("the film's frames cannot be read: expected one stream");
  const AVStream& read = *from->streams[0];
  Container to(container_name, sink);
  AVStream& written = to.stream();
  require(avcodec_parameters_copy(written.codecpar, read.codecpar), "the film's properties");
  written.time_base = read.time_base;
  written.avg_frame_rate = read.avg_frame_rate;
  to.begin(container_options);
  const Owned<AVPacket> packet(require(av_packet_alloc()));
  for (;;) {
    const int status = av_read_frame(from.get(), packet.get());
    if (status == AVERROR_EOF) break;
    require(status, "the film's frames cannot be read");
    to.write(*packet, read.time_base);
  }
  to.finish();
}

int can_write(const char* container, const char* encoder) {
  const AVCodec* const codec = avcodec_find_encoder_by_name(encoder);
  const AVOutputFormat* const format = av_guess_format(container, nullptr, nullptr);
  if (codec == nullptr || format == nullptr) return 0;
  return avformat_query_codec(format, codec->id, FF_COMPLIANCE_NORMAL) == 1 ? 1 : 0;
}

LaternaVideoOutput* create(const LaternaVideoSettings* settings, const LaternaVideoSink* sink, char* message,
                           std::size_t message_size) {
  Output* output = nullptr;
  caught([&] { output = new Output(*settings, *sink); }, message, message_size);
  return reinterpret_cast<LaternaVideoOutput*>(output);
}

int write(LaternaVideoOutput* output, const LaternaVideoPlanes* planes, char* message,
          std::size_t message_size) {
  return caught([&] { reinterpret_cast<Output*>(output)->write(*planes); }, message, message_size) ? 1 : 0;
}

int finish(LaternaVideoOutput* output, char* message, std::size_t message_size) {
  return caught([&] { reinterpret_cast<Output*>(output)->finish(); }, message, message_size) ? 1 : 0;
}

void discard(LaternaVideoOutput* output) { delete reinterpret_cast<Output*>(output); }

int rearrange(const char* file, const char* container, const char* container_options,
              const LaternaVideoSink* sink, char* message, std::size_t message_size) {
  return caught([&] { rearrange_film(file, container, container_options, *sink); }, message, message_size)
             ? 1
             : 0;
}

}  // namespace

void add_output(LaternaVideoPlugin& plugin) {
  plugin.can_write = can_write;
  plugin.create = create;
  plugin.write = write;
  plugin.finish = finish;
  plugin.discard = discard;
  plugin.rearrange = rearrange;
}

}  // namespace laterna_ffmpeg
