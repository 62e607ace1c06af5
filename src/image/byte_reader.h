// Reads numbers from bytes and never past their end: a decoder may read on and ask once per row whether it
// ran out.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace laterna::image {

class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  [[nodiscard]] std::size_t position() const { return position_; }
  [[nodiscard]] std::size_t remaining() const { return bytes_.size() - position_; }
  /// True once more was asked for than there is. What was read beyond the end is 0.
  [[nodiscard]] bool ran_out() const { return ran_out_; }

  /// Beyond the end: ran_out().
  void seek(std::size_t position) {
    ran_out_ = ran_out_ || position > bytes_.size();
    position_ = std::min(position, bytes_.size());
  }
  void skip(std::size_t count) { take(count); }

  /// The next `count` bytes; none and ran_out() where fewer remain.
  std::span<const std::byte> take(std::size_t count) {
    if (count > remaining()) {
      ran_out_ = true;
      position_ = bytes_.size();
      return {};
    }
    position_ += count;
    return bytes_.subspan(position_ - count, count);
  }

  std::uint8_t u8() {
    if (position_ == bytes_.size()) {
      ran_out_ = true;
      return 0;
    }
    return std::to_integer<std::uint8_t>(bytes_[position_++]);
  }
  std::uint16_t u16_le() {
    const unsigned low = u8();
    return static_cast<std::uint16_t>(low | static_cast<unsigned>(u8()) << 8);
  }
  std::uint32_t u32_le() {
    const std::uint32_t low = u16_le();
    return low | static_cast<std::uint32_t>(u16_le()) << 16;
  }
  std::int32_t i32_le() { return static_cast<std::int32_t>(u32_le()); }

 private:
  std::span<const std::byte> bytes_;
  std::size_t position_ = 0;
  bool ran_out_ = false;
};

}  // namespace laterna::image
