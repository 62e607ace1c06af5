// Linear light to stored codes: 8-bit pixels as tiles are written, texels of mip chains, 16-bit values.
#include <array>
#include <vector>

#include "image/colour.h"
#include "image/encode_pixels.h"
#include "image/mip_rows.h"
#include "kernel_run.h"

namespace laterna {
namespace {

constexpr std::size_t kCount = 4096;

// Values all over [0, 1), in no order.
AlignedVector<float> light(std::size_t count) {
  AlignedVector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = static_cast<float>(i * 37 % kCount) / kCount;
  return values;
}

void encode_pixels(benchmark::State& state, InstructionSet set) {
  const AlignedVector<float> plane = light(kCount);
  const image::LinearPixels linear = {plane.data(), plane.data(), plane.data(), nullptr, 1};
  AlignedVector<std::uint32_t> pixels(kCount);
  const image::EncodePixels kernel = image::encode_pixels_for(set);
  measure(state, "pixels", kCount, [&] { kernel(linear, kCount, pixels.data()); });
}

void encode_texels(benchmark::State& state, InstructionSet set) {
  const AlignedVector<float> planes = light(4 * image::plane_stride(kCount));
  AlignedVector<std::uint32_t> texels(image::plane_stride(kCount));
  const image::EncodeTexels kernel = image::encode_colour_for(set);
  measure(state, "texels", kCount, [&] { kernel(planes.data(), kCount, texels.data()); });
}

void encode_16_bit(benchmark::State& state) {
  const AlignedVector<float> linear = light(kCount);
  std::vector<std::uint16_t> codes(kCount);
  image::encode_srgb(linear, codes);  // builds its tables
  measure(state, "values", kCount, [&] { image::encode_srgb(linear, codes); });
}

const bool kRegistered = [] {
  register_kernel("encode, 8-bit pixels", encode_pixels);
  register_kernel("encode, texels", encode_texels);
  benchmark::RegisterBenchmark("encode, 16-bit values", encode_16_bit)->Unit(benchmark::kMicrosecond);
  return true;
}();

}  // namespace
}  // namespace laterna
