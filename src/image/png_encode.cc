// PNG for speed: every row is filtered by the one above it, which suits rendered pictures, and compressed at
// libdeflate's fastest level. Smaller files take several times as long.
#include <libdeflate.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <memory>
#include <new>

#include "base/aligned_vector.h"
#include "image/colour.h"
#include "image/encoder.h"
#include "image/image_rows.h"
#include "image/layers.h"
#include "image/parallel_rows.h"

namespace laterna::image {
namespace {

constexpr int kCompressionLevel = 1;
constexpr std::byte kUpFilter{2};
constexpr std::byte kPerceptual{0};  // the sRGB chunk's rendering intent
constexpr std::size_t kLongestChunk = std::size_t{1} << 30;

struct FreeCompressor {
  void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};

// Not cleared: they are written in whole, by the threads that fill them.
using LargeBuffer = AlignedVector<std::byte>;

void append_u32(EncodedBytes& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::byte>(value >> shift));
}

void append_chunk(EncodedBytes& bytes, std::string_view type, std::span<const std::byte> data) {
  append_u32(bytes, static_cast<std::uint32_t>(data.size()));
  append(bytes, type);
  bytes.insert(bytes.end(), data.begin(), data.end());
  // The checksum covers the type and the data.
  const std::size_t covered = type.size() + data.size();
  append_u32(bytes, libdeflate_crc32(0, bytes.data() + bytes.size() - covered, covered));
}

EncodedBytes header_chunk(const Image& image) {
  constexpr std::array kColourTypes = {0, 4, 2, 6};  // grey, grey with alpha, RGB, RGBA
  EncodedBytes data;
  append_u32(data, static_cast<std::uint32_t>(image.width()));
  append_u32(data, static_cast<std::uint32_t>(image.height()));
  data.push_back(image.type() == PixelType::u16 ? std::byte{16} : std::byte{8});
  data.push_back(static_cast<std::byte>(kColourTypes[static_cast<std::size_t>(image.channels() - 1)]));
  data.insert(data.end(), 3, std::byte{0});  // deflate, the usual filters, not interlaced
  return data;
}

// One row as PNG wants it: 16-bit values with the high byte first. Returns the row itself or `buffer`, which
// has its size.
std::span<const std::byte> big_endian_row(const Image& image, int y, EncodedBytes& buffer) {
  const std::span<const std::byte> row = row_bytes(image, y);
  if (image.type() != PixelType::u16 || std::endian::native == std::endian::big) return row;
  for (std::size_t i = 0; i < row.size(); i += 2) {
    buffer[i] = row[i + 1];
    buffer[i + 1] = row[i];
  }
  return buffer;
}

// Rows of the filter's number and the differences to the row above. Above the first row lies black.
LargeBuffer filtered_rows(const Image& image, const TaskPool& pool) {
  const std::size_t row_size = row_bytes(image, 0).size();
  LargeBuffer filtered((row_size + 1) * static_cast<std::size_t>(image.height()));
  struct Buffers {
    EncodedBytes row, above;
  };
  std::vector<Buffers> buffers(static_cast<std::size_t>(pool.threads()),
                               {EncodedBytes(row_size), EncodedBytes(row_size)});
  for_each_row_block(pool, image.height(), [&](int first, int last, int worker) {
    Buffers& mine = buffers[static_cast<std::size_t>(worker)];
    for (int y = first; y < last; ++y) {
      std::byte* to = filtered.data() + static_cast<std::size_t>(y) * (row_size + 1);
      *to++ = kUpFilter;
      const std::span<const std::byte> row = big_endian_row(image, y, mine.row);
      if (y == 0) {
        std::copy(row.begin(), row.end(), to);
        continue;
      }
      const std::span<const std::byte> above = big_endian_row(image, y - 1, mine.above);
      for (std::size_t i = 0; i < row_size; ++i) {
        to[i] =
            static_cast<std::byte>(std::to_integer<unsigned>(row[i]) - std::to_integer<unsigned>(above[i]));
      }
    }
  });
  return filtered;
}

LargeBuffer compressed(const LargeBuffer& data) {
  const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
      libdeflate_alloc_compressor(kCompressionLevel));
  if (compressor == nullptr) throw std::bad_alloc();
  LargeBuffer result(libdeflate_zlib_compress_bound(compressor.get(), data.size()));
  result.resize(
      libdeflate_zlib_compress(compressor.get(), data.data(), data.size(), result.data(), result.size()));
  return result;
}

// Rounds the colour channels to T; exposure is a factor on the light, so alpha does not take part.
template <class T>
Image quantised(const LayeredImage& layers, const ColourChannels& channels, PixelType type, float exposure,
                const TaskPool& pool) {
  const int count = channels.count + (channels.alpha != nullptr ? 1 : 0);
  Image image(layers.width, layers.height, count, type, Transfer::srgb);
  const auto width = static_cast<std::size_t>(layers.width), stride = static_cast<std::size_t>(count);
  struct Buffers {
    std::vector<float> linear;
    std::vector<T> codes;
  };
  std::vector<Buffers> buffers(static_cast<std::size_t>(pool.threads()),
                               {std::vector<float>(width), std::vector<T>(width)});
  for_each_row_block(pool, layers.height, [&](int first, int last, int worker) {
    auto& [linear, codes] = buffers[static_cast<std::size_t>(worker)];
    for (int y = first; y < last; ++y) {
      T* const row = image.values<T>().data() + static_cast<std::size_t>(y) * width * stride;
      for (int c = 0; c < channels.count; ++c) {
        unmultiplied_row(channels, c, layers.width, y, linear);
        for (float& value : linear) value *= exposure;
        encode_srgb(linear, std::span<T>(codes));
        for (std::size_t x = 0; x < width; ++x) row[x * stride + static_cast<std::size_t>(c)] = codes[x];
      }
      if (channels.alpha == nullptr) continue;
      encode_linear({channels.alpha + static_cast<std::size_t>(y) * width, width}, std::span<T>(codes));
      for (std::size_t x = 0; x < width; ++x) row[x * stride + stride - 1] = codes[x];
    }
  });
  return image;
}

EncodedBytes encode_pixels(const Image& image, const TaskPool& pool) {
  const LargeBuffer pixels = compressed(filtered_rows(image, pool));
  EncodedBytes file;
  file.reserve(pixels.size() + 128);
  append(file, "\x89PNG\r\n\x1a\n");
  append_chunk(file, "IHDR", header_chunk(image));
  if (image.transfer() == Transfer::srgb) append_chunk(file, "sRGB", std::span(&kPerceptual, 1));
  for (std::size_t at = 0; at < pixels.size(); at += kLongestChunk) {
    append_chunk(file, "IDAT", std::span(pixels).subspan(at, std::min(kLongestChunk, pixels.size() - at)));
  }
  append_chunk(file, "IEND", {});
  return file;
}

}  // namespace

EncodedBytes encode_png(const Image& image, int threads) { return encode_pixels(image, TaskPool(threads)); }

Result<EncodedBytes> encode_png(const LayeredImage& image, const WriteOptions& options,
                                std::string_view name) {
  using Depth = WriteOptions::Depth;
  if (options.depth == Depth::half || options.depth == Depth::single) {
    return cannot_hold(name, "a PNG holds 8 or 16 bits per value, no floating point");
  }
  const ColourChannels channels = find_colour_channels(image);
  if (channels.count == 0) {
    return cannot_hold(name, "a PNG needs channels R, G, B or Y; the picture has " + channel_names(image));
  }
  const TaskPool pool(options.threads);
  const Image pixels = options.depth == Depth::bits16
                           ? quantised<std::uint16_t>(image, channels, PixelType::u16, options.exposure, pool)
                           : quantised<std::uint8_t>(image, channels, PixelType::u8, options.exposure, pool);
  return encode_pixels(pixels, pool);
}

}  // namespace laterna::image
