// PCX, the skins of Quake II's models: what is read, what is said about the rest, and every length of a file.
#include <gtest/gtest.h>

#include "unit/image_bytes.h"

namespace laterna {
namespace {

using namespace laterna::testing;

// 128 bytes of header, lines, and a palette where there is one plane.
Bytes pcx(int width, int height, int planes, int bytes_per_line, const Bytes& lines,
          const Bytes& palette = {}, int bits = 8, int encoding = 1) {
  const auto u16 = [](int value) { return u16_le(static_cast<unsigned>(value)); };
  Bytes file = bytes({0x0A, 5, encoding, bits}) + u16(0) + u16(0) + u16(width - 1) + u16(height - 1) +
               u16(72) + u16(72);
  file.resize(65);
  file = file + bytes({planes}) + u16(bytes_per_line) + u16(1);
  file.resize(128);
  return file + lines + palette;
}

Bytes palette() {
  Bytes colours = bytes({0x0C});
  for (int i = 0; i < 256; ++i) colours = std::move(colours) + bytes({i, 255 - i, i / 2});
  return colours;
}

std::vector<int> values_of(const Result<Image>& image) {
  std::vector<int> values;
  if (!image) return values;
  for (const std::uint8_t value : image->values<std::uint8_t>()) values.push_back(value);
  return values;
}

std::string error_of(const Bytes& file) {
  const Result<Image> image = decode_image(file, "a.pcx");
  return image ? "no error" : to_string(image.error());
}

TEST(Pcx, PalettesRunsAndPlanes) {
  // Two lines of three pixels and one byte of padding: 7 7 7, then 0 and 200, which must be a run of one.
  const Bytes indexed = pcx(3, 2, 1, 4, bytes({0xC3, 7, 0, 0xC2, 0, 0xC1, 200, 0}), palette());
  EXPECT_EQ(values_of(decode_image(indexed, "a.pcx")),
            (std::vector<int>{7, 248, 3, 7, 248, 3, 7, 248, 3, 0, 255, 0, 0, 255, 0, 200, 55, 100}));
  // Red, green and blue of one line; a run goes on from one plane into the next.
  const Bytes planes = pcx(2, 1, 3, 2, bytes({1, 0xC2, 2, 3, 4, 5}));
  EXPECT_EQ(values_of(decode_image(planes, "A.PCX")), (std::vector<int>{1, 2, 4, 2, 3, 5}));
  const Bytes plain = pcx(2, 1, 3, 2, bytes({255, 254, 253, 252, 251, 250}), {}, 8, 0);
  EXPECT_EQ(values_of(decode_image(plain, "a.pcx")), (std::vector<int>{255, 253, 251, 254, 252, 250}));
}

TEST(Pcx, WhatIsWrongIsSaid) {
  const Bytes lines = bytes({1, 2, 3, 4});
  EXPECT_EQ(error_of(pcx(2, 2, 1, 2, lines, {}, 1)),
            "a.pcx: byte 1: expected 1 or 3 planes of 8 bits, found 1 of 1");
  EXPECT_EQ(error_of(pcx(2, 2, 4, 2, lines)),
            "a.pcx: byte 1: expected 1 or 3 planes of 8 bits, found 4 of 8");
  EXPECT_EQ(error_of(pcx(3, 2, 1, 2, lines)), "a.pcx: byte 1: a line of 2 bytes cannot hold 3 pixels");
  EXPECT_EQ(error_of(pcx(2, 2, 1, 2, lines, {}, 8, 9)), "a.pcx: byte 1: expected encoding 0 or 1, found 9");
  EXPECT_EQ(error_of(pcx(2, 2, 1, 2, lines)), "a.pcx: the file does not end with a palette of 256 colours");
  Bytes turned = pcx(2, 2, 1, 2, lines);
  turned[4] = std::byte{9};  // its left side is to the right of its right side
  EXPECT_EQ(error_of(turned), "a.pcx: the picture has no pixels: its size is -7 x 2");
  EXPECT_EQ(error_of(pcx(2, 2, 3, 60000, lines)), "a.pcx: byte 132: the file ends here, inside the pixels")
      << "no memory is taken for lines that the file cannot hold";
}

TEST(Pcx, EveryCutIsRefused) {
  for (const Bytes& whole : {pcx(3, 2, 1, 4, bytes({0xC3, 7, 0, 0xC2, 0, 0xC1, 200, 0}), palette()),
                             pcx(2, 1, 3, 2, bytes({1, 0xC2, 2, 3, 4, 5}))}) {
    EXPECT_EQ(error_of(whole), "no error");
    for (std::size_t length = 0; length < whole.size(); ++length)
      EXPECT_NE(error_of(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length))),
                "no error")
          << length;
  }
}

}  // namespace
}  // namespace laterna
