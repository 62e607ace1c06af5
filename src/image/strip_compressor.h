// A zlib stream (RFC 1950) made of strips that are compressed independently of one another, so that threads can share
// the work: header, strips in order, checksum.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace laterna::image {

class StripCompressor {
 public:
  /// May throw std::bad_alloc.
  StripCompressor();
  ~StripCompressor();
  StripCompressor(const StripCompressor&) = delete;
  StripCompressor& operator=(const StripCompressor&) = delete;

  /// Appends the strip's data, which ends on a whole byte. The bytes depend on `strip` and `is_last` alone.
  void append(std::span<const std::byte> strip, bool is_last, std::vector<std::byte>& to);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The two bytes that say: deflate, a window of 32 KB, fastest.
inline constexpr std::byte kZlibHeader[] = {std::byte{0x78}, std::byte{0x01}};

/// Adler-32 of a strip, and of two neighbours from theirs; `second_size` is the second's number of bytes.
std::uint32_t adler32(std::span<const std::byte> strip);
std::uint32_t adler32_of_both(std::uint32_t first, std::uint32_t second, std::size_t second_size);

}  // namespace laterna::image
