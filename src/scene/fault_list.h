// Gathers what is wrong with one file, so that a user sees every fault at once and not one per attempt.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "laterna/result.h"

namespace laterna {

class FaultList {
 public:
  /// Errors kept in full; a file with more is broken in one way that repeats.
  static constexpr std::size_t kMaxErrors = 100;

  explicit FaultList(std::string file) : file_(std::move(file)) {}

  void error(std::string place, std::string message);
  void warning(std::string place, std::string message);

  [[nodiscard]] const std::string& file() const { return file_; }
  /// Whether further errors are only counted: their place and message need not be made.
  [[nodiscard]] bool is_full() const { return errors_.size() >= kMaxErrors; }
  [[nodiscard]] bool has_errors() const { return error_count_ > 0; }
  [[nodiscard]] std::size_t error_count() const { return error_count_; }

  /// The errors in the order found; where there were too many, the last entry counts the rest.
  [[nodiscard]] std::vector<Diagnostic> errors() const;
  [[nodiscard]] const std::vector<Diagnostic>& warnings() const { return warnings_; }

 private:
  std::string file_;
  std::vector<Diagnostic> errors_;
  std::vector<Diagnostic> warnings_;
  std::size_t error_count_ = 0;
};

}  // namespace laterna
