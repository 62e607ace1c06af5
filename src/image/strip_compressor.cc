#include "image/strip_compressor.h"

#include <isa-l/igzip_lib.h>
#include <libdeflate.h>

#include <array>

namespace laterna::image {
namespace {

// As small as libdeflate's level 1 within two per cent, and twice as fast.
constexpr std::uint32_t kLevel = 1;

}  // namespace

struct StripCompressor::State {
  isal_zstream stream;
  std::array<std::uint8_t, ISAL_DEF_LVL1_DEFAULT> work;
};

StripCompressor::StripCompressor() : state_(new State) {}
StripCompressor::~StripCompressor() = default;

void StripCompressor::append(std::span<const std::byte> strip, bool is_last, std::vector<std::byte>& to) {
  isal_zstream& stream = state_->stream;
  isal_deflate_init(&stream);
  stream.level = kLevel;
  stream.level_buf = state_->work.data();
  stream.level_buf_size = static_cast<std::uint32_t>(state_->work.size());
  stream.end_of_stream = is_last ? 1 : 0;
  stream.flush = is_last ? NO_FLUSH : FULL_FLUSH;
  stream.next_in =
      const_cast<std::uint8_t*>(reinterpret_cast<const std::uint8_t*>(strip.data()));  // NOLINT: reads it
  stream.avail_in = static_cast<std::uint32_t>(strip.size());
  // It is done when it leaves some of the room that it is given.
  constexpr std::size_t kRoom = std::size_t{64} << 10U;
  do {
    const std::size_t done = to.size();
    to.resize(done + kRoom);
    stream.next_out = reinterpret_cast<std::uint8_t*>(to.data() + done);
    stream.avail_out = kRoom;
    isal_deflate(&stream);
    to.resize(done + (kRoom - stream.avail_out));
  } while (stream.avail_out == 0);
}

std::uint32_t adler32(std::span<const std::byte> strip) {
  return libdeflate_adler32(1, strip.data(), strip.size());
}

// The low half is 1 plus the sum of the bytes, the high half the sum of the low half after each byte: it begins at the
// first strip's low half rather than at 1.
std::uint32_t adler32_of_both(std::uint32_t first, std::uint32_t second, std::size_t second_size) {
  constexpr std::uint64_t kPrime = 65521;
  const std::uint64_t more = (first & 0xFFFFU) + kPrime - 1;
  const std::uint64_t low = (more + (second & 0xFFFFU)) % kPrime;
  const std::uint64_t high =
      ((first >> 16U) + (second >> 16U) + second_size % kPrime * (more % kPrime)) % kPrime;
  return static_cast<std::uint32_t>(high << 16U | low);
}

}  // namespace laterna::image
