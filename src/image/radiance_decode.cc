// Radiance pictures: three mantissas and a shared exponent per pixel, plain or in either of the two
// run-length encodings. Values are divided by EXPOSURE, which the format defines as a factor already applied
// to the pixels.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "image/byte_reader.h"
#include "image/decoder.h"
#include "image/image_rows.h"

namespace laterna::image {
namespace {

// The older encoding needs 12 bytes for a row of one colour, 12288 pixels wide here.
constexpr std::int64_t kMostPixelsPerByte = 1024;

// Rows outside these lengths are never in the newer encoding.
constexpr int kShortestRun = 8, kLongestRun = 0x7FFF;

struct RadianceHeader {
  int width = 0, height = 0;
  bool bottom_up = false, right_to_left = false;
  float exposure = 1;
  std::size_t pixels_position = 0;
};

std::string read_line(ByteReader& in) {
  constexpr std::size_t kLongestLine = 4096;
  std::string line;
  while (in.remaining() > 0 && line.size() < kLongestLine) {
    const char c = static_cast<char>(in.u8());
    if (c == '\n') break;
    if (c != '\r') line += c;
  }
  return line;
}

// "NAME=value": the value, without the blanks before it.
std::string_view value_of(std::string_view line, std::string_view name) {
  if (!line.starts_with(name)) return {};
  line.remove_prefix(name.size());
  line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
  return line;
}

// "-Y 512 +X 1024": the height first, from the top; from the left. Pictures turned on their side are not
// read.
bool parse_resolution(std::string_view line, RadianceHeader& header) {
  const auto take_side = [&](char axis, bool& is_positive, int& side) {
    if (line.size() < 4 || (line[0] != '+' && line[0] != '-') || line[1] != axis || line[2] != ' ')
      return false;
    is_positive = line[0] == '+';
    const auto [stop, fault] = std::from_chars(line.data() + 3, line.data() + line.size(), side);
    line.remove_prefix(static_cast<std::size_t>(stop - line.data()));
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    return fault == std::errc() && side >= 0;
  };
  bool x_is_positive = true;
  const bool is_valid =
      take_side('Y', header.bottom_up, header.height) && take_side('X', x_is_positive, header.width);
  header.right_to_left = !x_is_positive;
  return is_valid && line.empty();
}

Result<RadianceHeader> parse_header(const EncodedPicture& encoded) {
  ByteReader in(encoded.bytes);
  RadianceHeader header;
  int line_number = 0;
  const auto fault = [&](std::string message) {
    return unreadable(encoded, "line " + std::to_string(line_number), std::move(message));
  };
  for (;;) {
    if (in.remaining() == 0) return ends_early(encoded, "the header");
    const std::string line = read_line(in);
    ++line_number;
    if (line.empty()) break;
    const std::string_view format = value_of(line, "FORMAT=");
    if (!format.empty() && format != "32-bit_rle_rgbe") {
      return fault("expected FORMAT=32-bit_rle_rgbe, found " + std::string(format));
    }
    const std::string_view exposure = value_of(line, "EXPOSURE=");
    if (exposure.empty()) continue;
    float factor = 0;
    std::from_chars(exposure.data(), exposure.data() + exposure.size(), factor);
    header.exposure *= factor;
    if (!(std::isfinite(header.exposure) && header.exposure > 0))
      return fault("EXPOSURE must be greater than 0");
  }
  const std::string resolution = read_line(in);
  ++line_number;
  if (!parse_resolution(resolution, header)) {
    return fault("expected a resolution such as \"-Y 512 +X 1024\", found \"" + resolution + "\"");
  }
  header.pixels_position = in.position();
  return header;
}

// Red, green, blue, exponent.
using Rgbe = std::array<std::uint8_t, 4>;

// False: a run that is longer than the row. The end of the file shows in `in`.
bool read_component(ByteReader& in, std::vector<Rgbe>& row, std::size_t component) {
  for (std::size_t x = 0; x < row.size();) {
    const std::size_t code = in.u8();
    const bool repeats = code > 128;
    const std::size_t count = repeats ? code - 128 : code;
    if (in.ran_out()) return true;
    if (count == 0 || count > row.size() - x) return false;
    std::uint8_t value = 0;
    for (std::size_t i = 0; i < count; ++i, ++x) {
      if (i == 0 || !repeats) value = in.u8();
      row[x][component] = value;
    }
  }
  return true;
}

// The older encoding: a pixel (1, 1, 1, n) repeats the one before it n times; several in turn are the digits
// of a larger n in base 256, lowest first.
bool read_old_row(ByteReader& in, std::vector<Rgbe>& row) {
  int shift = 0;
  for (std::size_t x = 0; x < row.size() && !in.ran_out();) {
    Rgbe pixel;
    for (std::uint8_t& value : pixel) value = in.u8();
    if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
      row[x++] = pixel;
      shift = 0;
      continue;
    }
    const std::size_t count = std::size_t{pixel[3]} << shift;
    if (x == 0 || shift > 16 || count > row.size() - x) return false;
    std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(x), count, row[x - 1]);
    x += count;
    shift += 8;
  }
  return true;
}

bool read_row(ByteReader& in, std::vector<Rgbe>& row) {
  const auto width = static_cast<int>(row.size());
  if (width >= kShortestRun && width <= kLongestRun) {
    ByteReader ahead = in;
    const bool is_marked = ahead.u8() == 2 && ahead.u8() == 2;
    const int high = ahead.u8();
    const int length = high << 8 | ahead.u8();
    if (is_marked && high < 128 && !ahead.ran_out()) {
      in = ahead;
      for (std::size_t c = 0; c < 4; ++c) {
        if (length != width || !read_component(in, row, c)) return false;
      }
      return true;
    }
  }
  return read_old_row(in, row);
}

// 2^(e − 136): the mantissas are fractions of 256, and the exponent is biased by 128. 0 means black.
std::array<float, 256> exponent_table() {
  std::array<float, 256> table = {};
  for (std::size_t e = 1; e < table.size(); ++e) table[e] = std::ldexp(1.0F, static_cast<int>(e) - 136);
  return table;
}

bool recognises(const EncodedPicture& encoded) { return begins_with(encoded.bytes, "#?"); }

Result<ImageHeader> read_header(const EncodedPicture& encoded) {
  const Result<RadianceHeader> header = parse_header(encoded);
  if (!header) return tl::unexpected(header.error());
  return ImageHeader{
      .format = {}, .width = header->width, .height = header->height, .channels = 3, .type = PixelType::f32};
}

Result<Image> decode(const EncodedPicture& encoded, const ImageHeader&) {
  const Result<RadianceHeader> header = parse_header(encoded);
  if (!header) return tl::unexpected(header.error());
  ByteReader in(encoded.bytes);
  in.seek(header->pixels_position);
  const std::array<float, 256> scale = exponent_table();
  Image image(header->width, header->height, 3, PixelType::f32, Transfer::linear);
  float* to = image.values<float>().data();
  std::vector<Rgbe> row(static_cast<std::size_t>(header->width));
  for (int y = 0; y < header->height; ++y) {
    const bool is_valid = read_row(in, row);
    if (in.ran_out()) return ends_early(encoded, "the pixels");
    if (!is_valid) {
      return unreadable(encoded, at_byte(in.position()),
                        "row " + std::to_string(y) + ": a run does not fit the row");
    }
    for (const Rgbe& pixel : row) {
      for (std::size_t c = 0; c < 3; ++c)
        *to++ = static_cast<float>(pixel[c]) * scale[pixel[3]] / header->exposure;
    }
  }
  if (header->bottom_up) flip_rows(image);
  if (header->right_to_left) mirror_rows(image);
  return image;
}

}  // namespace

const Decoder kRadianceDecoder = {"Radiance HDR", kMostPixelsPerByte, recognises, read_header, decode};

}  // namespace laterna::image
