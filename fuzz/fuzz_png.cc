#include <libdeflate.h>

#include "fuzz_picture.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return laterna::image::fuzz_decoder(laterna::image::kPngDecoder, data, size);
}

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t largest_size);

// Mutates as usual and then puts every chunk's checksum right, without which nothing but the checks would be
// tested.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t largest_size,
                                               unsigned /*seed*/) {
  size = LLVMFuzzerMutate(data, size, largest_size);
  constexpr std::size_t kSignature = 8, kAroundData = 12;
  const auto u32 = [&](std::size_t at) {
    return std::uint32_t{data[at]} << 24 | std::uint32_t{data[at + 1]} << 16 |
           std::uint32_t{data[at + 2]} << 8 | data[at + 3];
  };
  for (std::size_t at = kSignature; at + kAroundData <= size;) {
    const std::size_t length = u32(at);
    if (length > size - at - kAroundData) break;
    const std::uint32_t checksum = libdeflate_crc32(0, data + at + 4, length + 4);
    for (std::size_t i = 0; i < 4; ++i)
      data[at + 8 + length + i] = static_cast<std::uint8_t>(checksum >> (24 - 8 * i));
    at += length + kAroundData;
  }
  return size;
}
