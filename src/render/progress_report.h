// How far a render is, told to its caller, who may stop it.
#pragma once

#include <atomic>
#include <mutex>

#include "laterna/render.h"

namespace laterna::render {

class ProgressReport {
 public:
  /// `steps`: tiles to be drawn.
  ProgressReport(const Progress& progress, std::size_t steps) : progress_(progress), steps_(steps) {}

  [[nodiscard]] bool is_cancelled() const { return cancelled_.load(std::memory_order_relaxed); }

  /// Asks the caller, between two steps.
  bool asks_to_stop() {
    advance(0);
    return is_cancelled();
  }

  void advance(std::size_t steps = 1) {
    done_.fetch_add(steps);
    if (!progress_) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    // Once told to stop, the caller is not asked again.
    if (!lock.owns_lock() || is_cancelled()) return;
    // Read under the lock, so that what is reported never goes back.
    if (!progress_(static_cast<double>(done_.load()) / static_cast<double>(steps_))) cancelled_ = true;
  }

 private:
  const Progress& progress_;
  std::size_t steps_;
  std::atomic<std::size_t> done_ = 0;
  std::atomic<bool> cancelled_ = false;
  std::mutex mutex_;
};

}  // namespace laterna::render
