#include "progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>

namespace laterna::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPatience{700};
constexpr std::chrono::milliseconds kInterval{100};

// What is left is told from the work of the last minute or so: what a run before has finished is passed over in no time.
constexpr std::chrono::seconds kWindow{30};

class Line {
 public:
  explicit Line(std::function<std::string()> what) : what_(std::move(what)) {}
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  ~Line() {
    if (is_shown_) fmt::print(stderr, "\r\033[K");
  }

  void show(double fraction) {
    const Clock::time_point now = Clock::now();
    if (now - start_ < kPatience) from_ = next_ = {now, fraction};
    if (now - start_ < kPatience || now - last_ < kInterval) return;
    last_ = now;
    is_shown_ = true;
    if (now - next_.time > kWindow) {
      from_ = next_;
      next_ = {now, fraction};
    }
    const double seconds = std::chrono::duration<double>(now - from_.time).count();
    const double done = fraction - from_.fraction;
    const double left = done > 0 ? seconds * (1 - fraction) / done : 0;
    fmt::print(stderr, "\r{} {:3.0f} %, {}\033[K", what_(), fraction * 100, time_left(left));
    std::fflush(stderr);
  }

 private:
  struct Mark {
    Clock::time_point time;
    double fraction = 0;
  };

  static std::string time_left(double seconds) {
    constexpr double kLong = 180;  // seconds
    return seconds < kLong ? fmt::format("{:.0f} s left", seconds)
                           : fmt::format("{:.0f} min left", seconds / 60);
  }

  std::function<std::string()> what_;
  Clock::time_point start_ = Clock::now(), last_;
  Mark from_{start_}, next_{start_};
  bool is_shown_ = false;
};

}  // namespace

Progress progress_line(std::string what) {
  return progress_line([what = std::move(what)] { return what; });
}

Progress progress_line(std::function<std::string()> what) {
  if (isatty(STDERR_FILENO) == 0) return {};
  auto line = std::make_shared<Line>(std::move(what));
  return [line](double fraction) {
    line->show(fraction);
    return true;
  };
}

}  // namespace laterna::app
