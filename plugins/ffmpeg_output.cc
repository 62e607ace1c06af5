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

class Output {
 public:
  Output(const LaternaVideoSettings& settings, const LaternaVideoSink& sink)
      : settings_(settings), sink_(sink) {
    frame_.reset(require(av_frame_alloc()));
    packet_.reset(require(av_packet_alloc()));
    AVFormatContext* format = nullptr;
    require(avformat_alloc_output_context2(&format, nullptr, settings.container, nullptr),
            "FFmpeg here does not write such files");
    format_.reset(format);
    format->flags |= AVFMT_FLAG_CUSTOM_IO | AVFMT_FLAG_BITEXACT;
    open_sink();
    open_encoder();
    open_stream();
    Options options(settings.container_options);
    require(avformat_write_header(format, &options.all), "the file's beginning cannot be written");
    options.require_read();
    time_base_ = codec_->time_base;
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
    require(av_write_trailer(format_.get()), "the file's end cannot be written");
    avio_flush(format_->pb);
    require(format_->pb->error, "the file's end cannot be written");
  }

 private:
  void open_sink() {
    auto* const buffer = static_cast<unsigned char*>(av_malloc(kBufferSize));
    if (buffer == nullptr) throw std::bad_alloc();
    format_->pb =
        avio_alloc_context(buffer, kBufferSize, 1, this, nullptr, &Output::write_bytes, &Output::seek);
    if (format_->pb == nullptr) {
      av_free(buffer);
      throw std::bad_alloc();
    }
  }

  static int write_bytes(void* self, std::uint8_t* bytes, int size) {
    Output& output = *static_cast<Output*>(self);
    const int fault =
        output.sink_.write(output.sink_.to, output.position_, bytes, static_cast<std::size_t>(size));
    if (fault != 0) return AVERROR(fault);
    output.position_ += size;
    output.end_ = std::max(output.end_, output.position_);
    return size;
  }

  static std::int64_t seek(void* self, std::int64_t offset, int whence) {
    Output& output = *static_cast<Output*>(self);
    if (whence == AVSEEK_SIZE) return output.end_;
    if (whence == SEEK_CUR) offset += output.position_;
    if (whence == SEEK_END) offset += output.end_;
    if (offset < 0) return AVERROR(EINVAL);
    output.position_ = offset;
    return offset;
  }

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
    if ((format_->oformat->flags & AVFMT_GLOBALHEADER) != 0) codec.flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    Options options(settings_.options);
    require(avcodec_open2(codec_.get(), encoder, &options.all), "the encoder cannot be used");
    options.require_read();
  }

  void open_stream() {
    AVStream* const stream = require(avformat_new_stream(format_.get(), nullptr));
    stream->time_base = codec_->time_base;
    stream->avg_frame_rate = codec_->framerate;
    require(avcodec_parameters_from_context(stream->codecpar, codec_.get()), "the film's properties");
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
      AVStream& stream = *format_->streams[0];
      packet_->stream_index = 0;
      packet_->duration = 1;
      av_packet_rescale_ts(packet_.get(), time_base_, stream.time_base);
      require(av_interleaved_write_frame(format_.get(), packet_.get()), "a frame cannot be written");
    }
    // Reached the file or did not: a full disk may show only in what is buffered.
    avio_flush(format_->pb);
    require(format_->pb->error, "a frame cannot be written");
  }

  LaternaVideoSettings settings_;
  LaternaVideoSink sink_;
  std::unique_ptr<AVFormatContext, FreeOutput> format_;
  Owned<AVCodecContext> codec_;
  Owned<AVFrame> frame_;
  Owned<AVPacket> packet_;
  AVRational time_base_{};
  std::int64_t frames_ = 0, position_ = 0, end_ = 0;
};

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

}  // namespace

void add_output(LaternaVideoPlugin& plugin) {
  plugin.can_write = can_write;
  plugin.create = create;
  plugin.write = write;
  plugin.finish = finish;
  plugin.discard = discard;
}

}  // namespace laterna_ffmpeg
