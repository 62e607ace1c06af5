// Whole files in, and what reading and writing share. Writing: base/output_file.h.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "laterna/result.h"

namespace laterna {

/// The whole content of a file, which may be empty. Error: it cannot be opened or read, or is a directory.
Result<std::vector<std::byte>> read_file(const std::filesystem::path& file);

/// The system's text for an errno value: "No such file or directory".
std::string describe_errno(int number);

/// Owns a POSIX file descriptor; −1 is none.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
  FileDescriptor(FileDescriptor&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() { close(); }

  [[nodiscard]] int get() const { return descriptor_; }
  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
  /// Returns 0 or the errno: a full disk may show itself only here.
  int close();

 private:
  int descriptor_ = -1;
};

}  // namespace laterna
