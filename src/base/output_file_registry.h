// The temporary files of this process that are not yet renamed into place: the one piece of process-wide
// state in the library, because a signal handler can reach nothing else. See laterna/output.h.
#pragma once

#include <string>
#include <utility>

namespace laterna {

/// A path that remove_pending_outputs() will unlink, and so will this object's end, unless released.
class PendingOutput {
 public:
  PendingOutput() = default;
  /// Registers `path`, which should be absolute: a signal may come after the working directory has changed. A
  /// path longer than the system allows is not registered; no file of that name can be made.
  explicit PendingOutput(const std::string& path);
  PendingOutput(PendingOutput&& other) noexcept : slot_(std::exchange(other.slot_, nullptr)) {}
  PendingOutput& operator=(PendingOutput&& other) noexcept {
    std::swap(slot_, other.slot_);
    return *this;
  }
  PendingOutput(const PendingOutput&) = delete;
  PendingOutput& operator=(const PendingOutput&) = delete;
  ~PendingOutput();

  [[nodiscard]] bool is_registered() const { return slot_ != nullptr; }
  [[nodiscard]] const char* path() const;
  /// Forgets the path: the file is not there, or has its final name.
  void release();

 private:
  struct Slot;
  friend void remove_pending_outputs() noexcept;
  static Slot* claim_slot();

  Slot* slot_ = nullptr;
};

}  // namespace laterna
