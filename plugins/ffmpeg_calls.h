// What the plug-in's files share: FFmpeg's failures as exceptions, and its objects with owners.
#pragma once

#include <array>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace laterna_ffmpeg {

// Caught where the plug-in's calls end.
struct Fault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline std::string describe(int error) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(error, text.data(), text.size());
  return text.data();
}

inline void require(int status, const char* doing) {
  if (status < 0) throw Fault(std::string(doing) + ": " + describe(status));
}

template <class T>
T* require(T* pointer) {
  if (pointer == nullptr) throw std::bad_alloc();
  return pointer;
}

struct Free {
  void operator()(AVFormatContext* p) const { avformat_close_input(&p); }
  void operator()(AVCodecContext* p) const { avcodec_free_context(&p); }
  void operator()(AVFrame* p) const { av_frame_free(&p); }
  void operator()(AVPacket* p) const { av_packet_free(&p); }
};
template <class T>
using Owned = std::unique_ptr<T, Free>;

// What was thrown, as a message.
template <class Work>
bool caught(Work work, char* message, std::size_t message_size) {
  try {
    work();
    return true;
  } catch (const std::bad_alloc&) {
    std::snprintf(message, message_size, "not enough memory for the film");
  } catch (const std::exception& fault) {
    std::snprintf(message, message_size, "%s", fault.what());
  }
  return false;
}

}  // namespace laterna_ffmpeg
