// Tiny picture files, built byte by byte from the formats' descriptions, and reading and writing them.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "laterna/image.h"
#include "unit/temporary_folder.h"

namespace laterna::testing {

using Bytes = std::vector<std::byte>;

inline Bytes bytes(std::initializer_list<int> values) {
  Bytes result;
  for (const int value : values) result.push_back(static_cast<std::byte>(value));
  return result;
}

inline Bytes bytes(std::string_view text) {
  Bytes result;
  for (const char c : text) result.push_back(static_cast<std::byte>(c));
  return result;
}

/// "FFD8…"
inline Bytes from_hex(std::string_view digits) {
  const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'A' + 10; };
  Bytes result;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
    result.push_back(static_cast<std::byte>(digit(digits[i]) * 16 + digit(digits[i + 1])));
  }
  return result;
}

inline Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline Bytes u16_le(unsigned value) {
  return bytes({static_cast<int>(value & 255), static_cast<int>(value >> 8 & 255)});
}
inline Bytes u32_le(std::uint32_t value) { return u16_le(value & 0xFFFF) + u16_le(value >> 16); }
inline Bytes u32_be(std::uint32_t value) {
  Bytes result = u32_le(value);
  return {result.rbegin(), result.rend()};
}

/// The first bytes of a file.
inline Bytes first(const Bytes& file, std::size_t count) {
  return {file.begin(), file.begin() + static_cast<std::ptrdiff_t>(count)};
}

// ---------------------------------------------------------------------------------------------- PNG

inline std::uint32_t crc32(const Bytes& data) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const std::byte b : data) {
    crc ^= std::to_integer<std::uint32_t>(b);
    for (int i = 0; i < 8; ++i) crc = (crc & 1) != 0 ? crc >> 1 ^ 0xEDB88320U : crc >> 1;
  }
  return ~crc;
}

inline Bytes png_chunk(std::string_view type, const Bytes& data) {
  const Bytes covered = bytes(type) + data;
  return u32_be(static_cast<std::uint32_t>(data.size())) + covered + u32_be(crc32(covered));
}

/// zlib's format with one block that is stored as it is.
inline Bytes zlib_stored(const Bytes& data) {
  std::uint32_t a = 1, b = 0;
  for (const std::byte value : data) {
    a = (a + std::to_integer<std::uint32_t>(value)) % 65521;
    b = (b + a) % 65521;
  }
  const auto size = static_cast<unsigned>(data.size());
  return bytes({0x78, 0x01, 0x01}) + u16_le(size) + u16_le(~size & 0xFFFF) + data + u32_be(b << 16 | a);
}

inline const Bytes kPngSignature = bytes({0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'});

inline Bytes png_header(int width, int height, int depth, int colour_type, int interlace = 0) {
  return kPngSignature + png_chunk("IHDR", u32_be(static_cast<std::uint32_t>(width)) +
                                               u32_be(static_cast<std::uint32_t>(height)) +
                                               bytes({depth, colour_type, 0, 0, interlace}));
}

/// `rows` holds each row with its filter number before it. `extra` comes before the pixels: PLTE, tRNS.
inline Bytes png(int width, int height, int depth, int colour_type, const Bytes& rows,
                 const Bytes& extra = {}, int interlace = 0) {
  return png_header(width, height, depth, colour_type, interlace) + extra +
         png_chunk("IDAT", zlib_stored(rows)) + png_chunk("IEND", {});
}

/// 2 × 2, RGB: red green / blue white.
inline Bytes small_png() {
  return png(2, 2, 8, 2, bytes({0, 255, 0, 0, 0, 255, 0, 0, 0, 0, 255, 255, 255, 255}));
}

// ---------------------------------------------------------------------------------------------- JPEG

/// 8 × 8, grey, every pixel 77.
inline Bytes small_jpeg() {
  return from_hex(
      "FFD8FFE000104A46494600010100000100010000FFDB0043000201010101010201010102020202020403020202020504"
      "040304060506060605060606070908060709070606080B08090A0A0A0A0A06080B0C0B0A0C090A0A0AFFC0000B080008"
      "000801011100FFC40014000100000000000000000000000000000008FFC4001410010000000000000000000000000000"
      "0000FFDA0008010100003F0019BFFFD9");
}

/// 16 × 8, RGB: (199, 40, 60) on the left, (10, 200, 250) on the right.
inline Bytes small_colour_jpeg() {
  return from_hex(
      "FFD8FFE000104A46494600010100000100010000FFDB0043000101010101010101010101010101010101010101010101"
      "0101010101010101010101010101010101010101010101010101010101010101010101010101010101FFDB0043010101"
      "010101010101010101010101010101010101010101010101010101010101010101010101010101010101010101010101"
      "0101010101010101010101010101FFC00011080008001003011100021101031101FFC400140001000000000000000000"
      "00000000000009FFC40014100100000000000000000000000000000000FFC40016010101010000000000000000000000"
      "00000A080BFFC40014110100000000000000000000000000000000FFDA000C03010002110311003F0033D3B9381D8250"
      "64EEFFD9");
}

/// 8 × 8, CMYK.
inline Bytes small_cmyk_jpeg() {
  return from_hex(
      "FFD8FFEE000E41646F626500640000000000FFDB004300100B0C0E0C0A100E0D0E1211101318281A181616183123251D"
      "283A333D3C3933383740485C4E404457453738506D51575F626768673E4D71797064785C656763FFC000140800080008"
      "044311004D11005911004B1100FFC40014000100000000000000000000000000000006FFC40014100100000000000000"
      "000000000000000000FFDA000E0443004D0059004B00003F00766C6258FFD9");
}

// ---------------------------------------------------------------------------------------------- BMP

/// `header_size` bytes of header follow the file header; `pixels` come after `palette`.
inline Bytes bmp(int width, int height, int bits, unsigned compression, const Bytes& palette,
                 const Bytes& pixels, unsigned colours = 0) {
  const auto offset = static_cast<std::uint32_t>(54 + palette.size());
  return bytes("BM") + u32_le(offset + static_cast<std::uint32_t>(pixels.size())) + u32_le(0) +
         u32_le(offset) + u32_le(40) + u32_le(static_cast<std::uint32_t>(width)) +
         u32_le(static_cast<std::uint32_t>(height)) + u16_le(1) + u16_le(static_cast<unsigned>(bits)) +
         u32_le(compression) + u32_le(0) + u32_le(0) + u32_le(0) + u32_le(colours) + u32_le(0) + palette +
         pixels;
}

/// 2 × 2, 24 bits, bottom row first: red green / blue white.
inline Bytes small_bmp() {
  return bmp(2, 2, 24, 0, {}, bytes({255, 0, 0, 255, 255, 255, 0, 0, 0, 0, 255, 0, 255, 0, 0, 0}));
}

// ---------------------------------------------------------------------------------------------- TGA

inline Bytes tga(int type, int width, int height, int bits, int descriptor, const Bytes& pixels,
                 const Bytes& palette = {}, unsigned palette_first = 0, int palette_bits = 0) {
  const unsigned colours =
      palette.empty() ? 0
                      : static_cast<unsigned>(palette.size()) / (static_cast<unsigned>(palette_bits + 7) / 8);
  return bytes({0, palette.empty() ? 0 : 1, type}) + u16_le(palette_first) + u16_le(colours) +
         bytes({palette_bits}) + u32_le(0) + u16_le(static_cast<unsigned>(width)) +
         u16_le(static_cast<unsigned>(height)) + bytes({bits, descriptor}) + palette + pixels;
}

/// 2 × 2, 24 bits, top row first: red green / blue white.
inline Bytes small_tga() {
  return tga(2, 2, 2, 24, 0x20, bytes({0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255}));
}

// ---------------------------------------------------------------------------------------------- GIF

/// LZW codes of 3 bits, which is enough for values of 2 bits when the table is cleared after every second
/// value.
inline Bytes gif_codes(const std::vector<int>& values) {
  constexpr unsigned kClear = 4, kEnd = 5;
  std::vector<unsigned> codes;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % 2 == 0) codes.push_back(kClear);
    codes.push_back(static_cast<unsigned>(values[i]));
  }
  codes.push_back(kEnd);
  Bytes packed((codes.size() * 3 + 7) / 8);
  for (std::size_t i = 0; i < codes.size() * 3; ++i) {
    if ((codes[i / 3] >> (i % 3) & 1) != 0) packed[i / 8] |= std::byte{1} << (i % 8);
  }
  return bytes({2, static_cast<int>(packed.size())}) + packed + bytes({0});
}

/// A canvas with the palette red, green, blue, white, and one frame on it.
inline Bytes gif(int width, int height, int left, int top, int frame_width, int frame_height, int flags,
                 const Bytes& codes, const Bytes& extension = {}) {
  const auto u16 = [](int value) { return u16_le(static_cast<unsigned>(value)); };
  return bytes("GIF89a") + u16(width) + u16(height) + bytes({0x81, 0, 0}) +
         bytes({255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255}) + extension + bytes({0x2C}) + u16(left) +
         u16(top) + u16(frame_width) + u16(frame_height) + bytes({flags}) + codes + bytes({0x3B});
}

/// 2 × 2: red green / blue white.
inline Bytes small_gif() { return gif(2, 2, 0, 0, 2, 2, 0, gif_codes({0, 1, 2, 3})); }

// ---------------------------------------------------------------------------------------------- floats

/// 2 × 1, little-endian: 1, 2, 3 and 4, 5, 6.
inline Bytes small_pfm() {
  Bytes result = bytes("PF\n2 1\n-1.0\n");
  for (const float value : {1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F}) {
    result = std::move(result) + u32_le(std::bit_cast<std::uint32_t>(value));
  }
  return result;
}

/// 2 × 1: (1, 0.5, 0.25) and (2, 2, 2).
inline Bytes small_hdr() {
  return bytes("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n") +
         bytes({128, 64, 32, 129, 128, 128, 128, 130});
}

// ---------------------------------------------------------------------------------------------- reading and
// writing

inline void store(const std::filesystem::path& file, const Bytes& content) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
}

inline Bytes load(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  return bytes(text);
}

/// Runs `body` in a process of its own and gives what it returns. It must not start threads.
template <class Body>
int exit_code_of_child(const Body& body) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(body());
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// The picture, or a failed test and an empty one.
inline Image decoded(const Bytes& file, std::string_view name = "test") {
  const Result<Image> image = decode_image(file, name);
  if (image) return *image;
  ADD_FAILURE() << to_string(image.error());
  return {};
}

inline std::vector<int> values_u8(const Image& image) {
  const auto values = image.values<std::uint8_t>();
  return {values.begin(), values.end()};
}
inline std::vector<int> values_u16(const Image& image) {
  const auto values = image.values<std::uint16_t>();
  return {values.begin(), values.end()};
}
inline std::vector<float> values_f32(const Image& image) {
  const auto values = image.values<float>();
  return {values.begin(), values.end()};
}

}  // namespace laterna::testing
