// Bytes that are read piece by piece: of a file, or of memory. A scene's geometry goes from the file straight
// into its attributes; a buffer for the whole file in between would cost more time (first touch of its pages)
// than reading.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "laterna/result.h"

namespace laterna {

using SharedBytes = std::shared_ptr<const std::vector<std::byte>>;

/// Bytes and what keeps them alive.
struct OwnedSpan {
  SharedBytes owner;
  std::span<const std::byte> bytes;
};

class ByteSource {
 public:
  /// No bytes.
  ByteSource() = default;
  static ByteSource in_memory(SharedBytes bytes);
  /// A regular file, kept open. Error: the reason, without the file's name.
  static tl::expected<ByteSource, std::string> open(const std::filesystem::path& file);

  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// A part; it must lie inside.
  [[nodiscard]] ByteSource slice(std::uint64_t offset, std::uint64_t size) const;
  /// A part's bytes; it must lie inside. Error: reading failed, or the file has been cut since it was opened.
  [[nodiscard]] tl::expected<OwnedSpan, std::string> read(std::uint64_t offset, std::uint64_t size) const;

 private:
  class OpenFile;

  std::shared_ptr<const OpenFile> file_;
  SharedBytes memory_;
  std::uint64_t offset_ = 0, size_ = 0;
};

}  // namespace laterna
