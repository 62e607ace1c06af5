#include "fuzz_picture.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return laterna::image::fuzz_decoder(laterna::image::kPcxDecoder, data, size);
}
