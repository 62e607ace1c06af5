// A zlib stream in strips, against libdeflate's decoder and the checksum's definition.
#include "image/strip_compressor.h"

#include <gtest/gtest.h>
#include <libdeflate.h>

#include <random>

#include "unit/image_bytes.h"

namespace laterna::image {
namespace {

using namespace laterna::testing;

// Long runs, repetitions and noise, which no compressor makes smaller.
Bytes mixed_data(std::size_t size) {
  std::mt19937 random(1);
  Bytes data(size);
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t kind = i / 1000 % 3;
    const auto value = kind == 0 ? 7 : kind == 1 ? i % 50 : random();
    data[i] = static_cast<std::byte>(value);
  }
  return data;
}

// RFC 1950, 8.2.
std::uint32_t defined_adler32(const Bytes& data) {
  std::uint32_t a = 1, b = 0;
  for (const std::byte value : data) {
    a = (a + std::to_integer<std::uint32_t>(value)) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

Bytes compressed(const Bytes& data, std::size_t strip_size) {
  Bytes stream(std::begin(kZlibHeader), std::end(kZlibHeader));
  std::uint32_t checksum = adler32({});
  StripCompressor compressor;
  for (std::size_t at = 0; at < data.size(); at += strip_size) {
    const std::span<const std::byte> strip =
        std::span(data).subspan(at, std::min(strip_size, data.size() - at));
    compressor.append(strip, at + strip.size() == data.size(), stream);
    checksum = adler32_of_both(checksum, adler32(strip), strip.size());
  }
  return stream + u32_be(checksum);
}

TEST(StripCompressor, StripsMakeOneStream) {
  const Bytes data = mixed_data(300000);
  libdeflate_decompressor* const decompressor = libdeflate_alloc_decompressor();
  for (const std::size_t strip_size :
       {std::size_t{1000}, std::size_t{65536}, std::size_t{299999}, data.size()}) {
    const Bytes stream = compressed(data, strip_size);
    EXPECT_LT(stream.size(), data.size());
    Bytes back(data.size());
    // It looks at the checksum, too.
    EXPECT_EQ(libdeflate_zlib_decompress(decompressor, stream.data(), stream.size(), back.data(), back.size(),
                                         nullptr),
              LIBDEFLATE_SUCCESS)
        << strip_size;
    EXPECT_EQ(back, data) << strip_size;
  }
  libdeflate_free_decompressor(decompressor);
}

TEST(StripCompressor, AStripDoesNotDependOnThoseBefore) {
  const Bytes data = mixed_data(100000);
  StripCompressor used, fresh;
  Bytes ignored, a, b;
  used.append(std::span(data).first(70000), false, ignored);
  used.append(std::span(data).last(30000), true, a);
  fresh.append(std::span(data).last(30000), true, b);
  EXPECT_EQ(a, b);
}

TEST(StripCompressor, ChecksumsOfStripsComeToThatOfAll) {
  const Bytes data = mixed_data(200000);
  const std::span<const std::byte> all(data);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, std::size_t{65521}, std::size_t{131072}, data.size()}) {
    const std::uint32_t first = adler32(all.first(size)), second = adler32(all.subspan(size));
    EXPECT_EQ(adler32_of_both(first, second, data.size() - size), defined_adler32(data)) << size;
  }
}

}  // namespace
}  // namespace laterna::image
