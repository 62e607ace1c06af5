// Milliseconds from lap to lap.
#pragma once

#include <chrono>

namespace laterna {

class Stopwatch {
 public:
  void start() { last_ = Clock::now(); }
  /// Since the last lap, or start().
  double lap_ms() {
    const Clock::time_point now = Clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - last_).count();
    last_ = now;
    return ms;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_;
};

}  // namespace laterna
