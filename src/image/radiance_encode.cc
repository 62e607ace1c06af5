// Radiance pictures in the newer run-length encoding. Three mantissas of 8 bits share an exponent: values are
// rounded to the nearest, negative ones and NaN to 0, and those beyond the largest (about 1.7e38) to it.
// There is no alpha: colours stay multiplied by it.
#include <algorithm>
#include <array>
#include <cmath>

#include "image/encoder.h"
#include "image/layers.h"

namespace laterna::image {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

// Rows of other lengths cannot be run-length encoded.
constexpr int kShortestRow = 8, kLongestRow = 0x7FFF;
constexpr std::size_t kLongestRun = 127, kLongestLiteral = 128;
constexpr std::size_t kShortestRun = 3;  // a run costs two bytes
constexpr int kExponentBias = 128;

Rgbe shared_exponent(std::array<float, 3> colour) {
  constexpr float kLargest = 255.0F * 0x1p119F;  // mantissa 255, exponent byte 255
  for (float& value : colour) value = value > 0 ? std::min(value, kLargest) : 0;
  const float largest = *std::max_element(colour.begin(), colour.end());
  if (largest == 0) return {};
  int exponent = 0;
  std::frexp(largest, &exponent);
  // A mantissa that would round to 256 takes the next exponent.
  if (std::ldexp(largest, 8 - exponent) >= 255.5F) ++exponent;
  if (exponent + kExponentBias < 1) return {};
  Rgbe pixel = {};
  for (std::size_t c = 0; c < 3; ++c) {
    pixel[c] = static_cast<std::uint8_t>(std::ldexp(colour[c], 8 - exponent) + 0.5F);
  }
  pixel[3] = static_cast<std::uint8_t>(exponent + kExponentBias);
  return pixel;
}

std::size_t run_length(const std::vector<Rgbe>& row, std::size_t x, std::size_t component) {
  std::size_t length = 1;
  while (length < kLongestRun && x + length < row.size() && row[x + length][component] == row[x][component])
    ++length;
  return length;
}

void append_component(EncodedBytes& bytes, const std::vector<Rgbe>& row, std::size_t component) {
  for (std::size_t x = 0; x < row.size();) {
    const std::size_t run = run_length(row, x, component);
    if (run >= kShortestRun) {
      bytes.push_back(static_cast<std::byte>(128 + run));
      bytes.push_back(std::byte{row[x][component]});
      x += run;
      continue;
    }
    std::size_t end = x + run;
    while (end < row.size() && end - x < kLongestLiteral && run_length(row, end, component) < kShortestRun)
      ++end;
    bytes.push_back(static_cast<std::byte>(end - x));
    for (; x < end; ++x) bytes.push_back(std::byte{row[x][component]});
  }
}

void append_row(EncodedBytes& bytes, const std::vector<Rgbe>& row) {
  const auto width = static_cast<int>(row.size());
  if (width < kShortestRow || width > kLongestRow) {
    for (const Rgbe& pixel : row) {
      for (const std::uint8_t value : pixel) bytes.push_back(std::byte{value});
    }
    return;
  }
  for (const int value : {2, 2, width >> 8, width & 255}) bytes.push_back(static_cast<std::byte>(value));
  for (std::size_t c = 0; c < 4; ++c) append_component(bytes, row, c);
}

}  // namespace

Result<EncodedBytes> encode_radiance(const LayeredImage& image, const WriteOptions& options,
                                     std::string_view name) {
  if (options.depth != WriteOptions::Depth::automatic) {
    return cannot_hold(name,
                       "a Radiance picture has one depth only: 8 bits per channel and a shared exponent");
  }
  const ColourChannels channels = find_colour_channels(image);
  if (channels.count == 0) {
    return cannot_hold(
        name, "a Radiance picture needs channels R, G, B or Y; the picture has " + channel_names(image));
  }
  EncodedBytes bytes;
  append(bytes, "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(image.height) + " +X " +
                    std::to_string(image.width) + "\n");
  std::vector<Rgbe> row(static_cast<std::size_t>(image.width));
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y) {
    for (std::size_t x = 0; x < row.size(); ++x) {
      std::array<float, 3> colour = {};
      for (std::size_t c = 0; c < 3; ++c) {
        colour[c] = channels.colour[channels.count == 1 ? 0 : c][y * row.size() + x];
      }
      row[x] = shared_exponent(colour);
    }
    append_row(bytes, row);
  }
  return bytes;
}

}  // namespace laterna::image
