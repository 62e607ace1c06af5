// Pictures are written while the next one is drawn.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "laterna/image.h"

namespace laterna::app {

/// A picture on its way to a file.
struct FinishedPicture {
  LayeredImage image;
  std::string file;
  float exposure = 1;
  double* write_ms = nullptr;  ///< set when it is written; may be null
};

/// A thread that writes pictures in their order. None waits: a series holds two pictures at a time, one that is drawn and one that is
/// written, and no more can be lost when it is killed. After an error nothing more is written.
class WriteQueue {
 public:
  explicit WriteQueue(std::function<Result<void>(FinishedPicture)> write);
  ~WriteQueue();
  WriteQueue(const WriteQueue&) = delete;
  WriteQueue& operator=(const WriteQueue&) = delete;

  /// Waits until the picture before is written. The picture is lost where one before it could not be written: finish() tells.
  void add(FinishedPicture picture);
  [[nodiscard]] bool has_failed() const;
  /// Waits until all are written. Error: the first that occurred.
  Result<void> finish();

 private:
  void work();

  std::function<Result<void>(FinishedPicture)> write_;
  mutable std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  std::optional<FinishedPicture> next_;  // until the thread takes it
  std::optional<Error> error_;
  bool is_writing_ = false, is_closing_ = false;
  std::thread thread_;
};

}  // namespace laterna::app
