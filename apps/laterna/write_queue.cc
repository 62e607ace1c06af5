#include "write_queue.h"

#include <chrono>
#include <utility>

namespace laterna::app {

WriteQueue::WriteQueue(std::function<Result<void>(FinishedPicture)> write)
    : write_(std::move(write)), thread_([this] { work(); }) {}

WriteQueue::~WriteQueue() {
  if (thread_.joinable()) static_cast<void>(finish());
}

void WriteQueue::add(FinishedPicture picture) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return (!next_ && !is_writing_) || error_; });
  if (error_) return;
  next_ = std::move(picture);
  changed_.notify_all();
}

bool WriteQueue::has_failed() const {
  const std::lock_guard lock(mutex_);
  return error_.has_value();
}

Result<void> WriteQueue::finish() {
  {
    const std::lock_guard lock(mutex_);
    is_closing_ = true;
    changed_.notify_all();
  }
  thread_.join();
  return error_ ? Result<void>(tl::unexpected(*error_)) : Result<void>();
}

void WriteQueue::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [&] { return next_ || is_closing_; });
    if (!next_) return;
    FinishedPicture picture = std::move(*next_);
    next_.reset();
    is_writing_ = true;
    lock.unlock();
    const auto start = std::chrono::steady_clock::now();
    double* const write_ms = picture.write_ms;
    Result<void> written = write_(std::move(picture));
    if (write_ms != nullptr) {
      *write_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }
    lock.lock();
    is_writing_ = false;
    if (!written) error_ = std::move(written.error());
    changed_.notify_all();
    if (error_) return;
  }
}

}  // namespace laterna::app
