// Files that are either complete or not there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "base/file_io.h"
#include "base/output_file_registry.h"
#include "laterna/result.h"

namespace laterna {

/// Writes to a temporary file beside its target, in the same directory, and renames it when told that it is
/// complete. Until then the target keeps what it held. "-" is stdout; devices and pipes are written as they
/// are. A target that is a symbolic link keeps being one: the file it points at is replaced. All errors are
/// Failure::cannot_write.
class OutputFile {
 public:
  static Result<OutputFile> create(const std::filesystem::path& target);
  OutputFile(OutputFile&&) noexcept = default;
  OutputFile& operator=(OutputFile&&) = delete;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  /// Without a commit(), removes the temporary file.
  ~OutputFile() = default;

  Result<void> write(std::span<const std::byte> bytes);
  /// At an offset from the file's beginning, wherever write() is: not for stdout and pipes.
  Result<void> write_at(std::uint64_t offset, std::span<const std::byte> bytes);
  /// Where the bytes are until commit(): not for stdout.
  [[nodiscard]] std::filesystem::path path() const {
    return temporary_.is_registered() ? std::filesystem::path(temporary_.path()) : destination_;
  }
  /// Bytes so far, and what is behind so many given up: not for stdout and pipes.
  [[nodiscard]] Result<std::uint64_t> size() const;
  Result<void> truncate(std::uint64_t size);
  /// Puts the file in its place. Nothing may be written after it.
  Result<void> commit();
  /// The same under another name; the target keeps what it held. Not for what is written in place.
  Result<void> commit_as(const std::filesystem::path& other);

 private:
  explicit OutputFile(std::filesystem::path target) : target_(std::move(target)) {}
  [[nodiscard]] int open_stdout();
  [[nodiscard]] int open_in_place();
  [[nodiscard]] int open_beside(bool target_exists, unsigned target_mode);

  std::filesystem::path target_;       // as the caller named it
  std::filesystem::path destination_;  // the same with symbolic links resolved
  PendingOutput temporary_;            // removed from disk unless committed; none where written in place
  FileDescriptor descriptor_;
};

/// create(), write() and commit().
Result<void> write_file(const std::filesystem::path& file, std::span<const std::byte> bytes);

}  // namespace laterna
