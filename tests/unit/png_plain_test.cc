// Ordinary PNG files, read without libpng: the same pixels, or none.
#include "image/png_plain.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "unit/image_bytes.h"

namespace laterna::image {
namespace {

using namespace laterna::testing;

constexpr int kWidth = 13, kHeight = 15;
constexpr int kColourTypes[] = {0, 4, 2, 6};  // with 1, 2, 3 and 4 channels

Image noise(int channels) {
  std::mt19937 random(static_cast<unsigned>(channels));
  Image image(kWidth, kHeight, channels, PixelType::u8, Transfer::srgb);
  for (std::uint8_t& value : image.values<std::uint8_t>()) value = static_cast<std::uint8_t>(random());
  return image;
}

// PNG specification, 9.2: what is subtracted from a byte whose neighbours are a (left), b (above), c (above left).
int prediction(int filter, int a, int b, int c) {
  switch (filter) {
    case 1:
      return a;
    case 2:
      return b;
    case 3:
      return (a + b) / 2;
    case 4: {
      const int p = a + b - c, pa = std::abs(p - a), pb = std::abs(p - b), pc = std::abs(p - c);
      if (pa <= pb && pa <= pc) return a;
      return pb <= pc ? b : c;
    }
    default:
      return 0;
  }
}

// All filters in turn, so that each follows each other one or the picture's edge.
Bytes filtered(const Image& image) {
  constexpr int kFilters[kHeight] = {4, 0, 1, 1, 2, 3, 4, 4, 3, 2, 1, 4, 2, 0, 3};
  const int channels = image.channels();
  const auto values = image.values<std::uint8_t>();
  const auto at = [&](int x, int y, int c) -> int {
    return x < 0 || y < 0 ? 0 : values[static_cast<std::size_t>((y * kWidth + x) * channels + c)];
  };
  Bytes rows;
  for (int y = 0; y < kHeight; ++y) {
    rows = rows + bytes({kFilters[y]});
    for (int x = 0; x < kWidth; ++x) {
      for (int c = 0; c < channels; ++c) {
        const int predicted = prediction(kFilters[y], at(x - 1, y, c), at(x, y - 1, c), at(x - 1, y - 1, c));
        rows = rows + bytes({(at(x, y, c) - predicted) & 255});
      }
    }
  }
  return rows;
}

TEST(PngPlain, EveryFilterIsUndoneForEveryNumberOfChannels) {
  for (int channels = 1; channels <= 4; ++channels) {
    const Image expected = noise(channels);
    const Bytes file = png(kWidth, kHeight, 8, kColourTypes[channels - 1], filtered(expected));
    Image image(kWidth, kHeight, channels, PixelType::u8, Transfer::srgb);
    ASSERT_TRUE(read_plain_png(file, image));
    EXPECT_EQ(values_u8(image), values_u8(expected)) << channels;
    EXPECT_EQ(values_u8(decoded(file)), values_u8(expected)) << channels;
  }
}

TEST(PngPlain, DataMayBeSpreadOverChunksAndOthersBeLeftOut) {
  const Image expected = noise(3);
  const Bytes data = zlib_stored(filtered(expected));
  const Bytes end(data.begin() + 100, data.end());
  const Bytes file = png_header(kWidth, kHeight, 8, 2) + png_chunk("tEXt", bytes("a")) +
                     png_chunk("IDAT", first(data, 100)) + png_chunk("IDAT", end) + png_chunk("tIME", {}) +
                     png_chunk("IEND", {});
  Image image(kWidth, kHeight, 3, PixelType::u8, Transfer::srgb);
  ASSERT_TRUE(read_plain_png(file, image));
  EXPECT_EQ(values_u8(image), values_u8(expected));
}

TEST(PngPlain, WhatIsNotPlainIsLeftToLibpng) {
  Image pixel(1, 1, 3, PixelType::u8, Transfer::srgb);
  const Bytes row = bytes({0, 1, 2, 3});
  EXPECT_TRUE(read_plain_png(png(1, 1, 8, 2, row), pixel));
  EXPECT_FALSE(read_plain_png(png(1, 1, 8, 2, row, {}, 1), pixel)) << "interlaced";
  EXPECT_FALSE(read_plain_png(png(1, 1, 8, 2, row, png_chunk("tRNS", bytes({0, 1, 0, 2, 0, 3}))), pixel));
  EXPECT_FALSE(read_plain_png(png(1, 1, 8, 3, bytes({0, 0}), png_chunk("PLTE", row)), pixel));
  EXPECT_FALSE(read_plain_png(png(1, 1, 8, 2, row, png_chunk("NEED", {})), pixel));
  Image deep(1, 1, 3, PixelType::u16, Transfer::srgb);
  EXPECT_FALSE(read_plain_png(png(1, 1, 16, 2, bytes({0, 1, 1, 2, 2, 3, 3})), deep));
}

TEST(PngPlain, DamageIsLeftToLibpng) {
  const Bytes good = small_png();
  Image image(2, 2, 3, PixelType::u8, Transfer::srgb);
  ASSERT_TRUE(read_plain_png(good, image));
  for (std::size_t size = kPngSignature.size(); size < good.size(); ++size)
    EXPECT_FALSE(read_plain_png(first(good, size), image)) << size;
  for (std::size_t at = kPngSignature.size(); at < good.size(); ++at) {
    Bytes damaged = good;
    damaged[at] ^= std::byte{1};
    EXPECT_FALSE(read_plain_png(damaged, image)) << at;
  }
  const Bytes black = bytes({0, 0, 0, 0});
  Image pixel(1, 1, 3, PixelType::u8, Transfer::srgb);
  EXPECT_TRUE(read_plain_png(png(1, 1, 8, 2, black), pixel));
  EXPECT_FALSE(read_plain_png(png(1, 1, 8, 2, bytes({5, 0, 0, 0})), pixel)) << "no such filter";
  EXPECT_FALSE(read_plain_png(png(1, 1, 8, 2, first(black, 3)), pixel)) << "too few pixels";
  EXPECT_FALSE(read_plain_png(png(1, 1, 8, 2, black + black), pixel)) << "too many pixels";
  const Bytes data = png_chunk("IDAT", first(zlib_stored(black), 5));
  EXPECT_FALSE(read_plain_png(
      png_header(1, 1, 8, 2) + data + png_chunk("tIME", {}) + data + png_chunk("IEND", {}), pixel));
}

}  // namespace
}  // namespace laterna::image
