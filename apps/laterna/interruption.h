// Ctrl-C in the middle of a series: what is finished is kept.
#pragma once

#include <array>

namespace laterna::app {

/// While it lives, a first SIGINT, SIGTERM or SIGHUP is only noted; a second of the kind ends the program at once, as without.
/// One at a time.
class Interruption {
 public:
  /// Does nothing unless `is_wanted`.
  explicit Interruption(bool is_wanted);
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// The signal that came, or 0.
  [[nodiscard]] int signal() const;

 private:
  bool is_wanted_;
};

/// Ends the program as the signal would have.
[[noreturn]] void end_by_signal(int signal);

}  // namespace laterna::app
