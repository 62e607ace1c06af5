#include "progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>

namespace laterna::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPatience{700};
constexpr std::chrono::milliseconds kInterval{100};

class Line {
 public:
  explicit Line(std::string what) : what_(std::move(what)) {}
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  ~Line() {
    if (is_shown_) fmt::print(stderr, "\r\033[K");
  }

  void show(double fraction) {
    const Clock::time_point now = Clock::now();
    if (now - start_ < kPatience || now - last_ < kInterval) return;
    last_ = now;
    is_shown_ = true;
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const double left = fraction > 0 ? seconds * (1 - fraction) / fraction : 0;
    fmt::print(stderr, "\r{} {:3.0f} %, {:.0f} s left\033[K", what_, fraction * 100, left);
    std::fflush(stderr);
  }

 private:
  std::string what_;
  Clock::time_point start_ = Clock::now(), last_;
  bool is_shown_ = false;
};

}  // namespace

Progress progress_line(std::string what) {
  if (isatty(STDERR_FILENO) == 0) return {};
  auto line = std::make_shared<Line>(std::move(what));
  return [line](double fraction) {
    line->show(fraction);
    return true;
  };
}

}  // namespace laterna::app
