// PNG for speed: every row is filtered by the one above it, which suits rendered pictures, and strips of rows are
// compressed in parallel, fast. Smaller files take several times as long.
#include <libdeflate.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <memory>

#include "image/colour.h"
#include "image/encoder.h"
#include "image/image_rows.h"
#include "image/layers.h"
#include "image/parallel_rows.h"
#include "image/png_format.h"
#include "image/strip_compressor.h"

namespace laterna::image {
namespace {

constexpr std::byte kUpFilter{2};
constexpr std::byte kPerceptual{0};       // the sRGB chunk's rendering intent
constexpr std::size_t kAroundChunk = 12;  // length, type and checksum
// Long enough to lose little to matches that would begin in the strip before, short enough to share.
constexpr std::size_t kStripBytes = std::size_t{256} << 10U;

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
  EncodedBytes data;
  append_u32(data, static_cast<std::uint32_t>(image.width()));
  append_u32(data, static_cast<std::uint32_t>(image.height()));
  data.push_back(image.type() == PixelType::u16 ? std::byte{16} : std::byte{8});
  data.push_back(static_cast<std::byte>(png_colour_type(image)));
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

// Filters and compresses rows of a picture; one per thread.
class StripEncoder {
 public:
  explicit StripEncoder(const Image& image)
      : image_(image), row_size_(row_bytes(image, 0).size()), row_(row_size_), above_(row_size_) {}

  struct Strip {
    EncodedBytes data;
    std::uint32_t adler32 = 0;
    std::size_t filtered_size = 0;
  };

  Strip encode(int first, int last) {
    filtered_.resize(static_cast<std::size_t>(last - first) * (row_size_ + 1));
    for (int y = first; y < last; ++y)
      filter(y, filtered_.data() + static_cast<std::size_t>(y - first) * (row_size_ + 1));
    Strip strip = {{}, adler32(filtered_), filtered_.size()};
    compressor_.append(filtered_, last == image_.height(), strip.data);
    return strip;
  }

 private:
  // The filter's number and the differences to the row above. Above the first row lies black.
  void filter(int y, std::byte* to) {
    *to++ = kUpFilter;
    const std::span<const std::byte> row = big_endian_row(image_, y, row_);
    if (y == 0) {
      std::copy(row.begin(), row.end(), to);
      return;
    }
    const std::span<const std::byte> above = big_endian_row(image_, y - 1, above_);
    for (std::size_t i = 0; i < row_size_; ++i) {
      to[i] = static_cast<std::byte>(std::to_integer<unsigned>(row[i]) - std::to_integer<unsigned>(above[i]));
    }
  }

  const Image& image_;
  std::size_t row_size_;
  EncodedBytes row_, above_;  // scratch of big_endian_row()
  EncodedBytes filtered_;
  StripCompressor compressor_;
};

// The picture's rows from the top, in strips that depend on the picture alone.
std::vector<StripEncoder::Strip> encode_strips(const Image& image, const TaskPool& pool) {
  const std::size_t row_size = row_bytes(image, 0).size() + 1;
  const auto rows = static_cast<int>(std::clamp<std::size_t>(kStripBytes / row_size, 1, kMaxImageSide));
  std::vector<StripEncoder::Strip> strips(static_cast<std::size_t>((image.height() + rows - 1) / rows));
  std::vector<std::unique_ptr<StripEncoder>> encoders(static_cast<std::size_t>(pool.threads()));
  pool.for_each(strips.size(), [&](std::size_t strip, int worker) {
    std::unique_ptr<StripEncoder>& encoder = encoders[static_cast<std::size_t>(worker)];
    if (encoder == nullptr) encoder = std::make_unique<StripEncoder>(image);
    const int first = static_cast<int>(strip) * rows;
    strips[strip] = encoder->encode(first, std::min(first + rows, image.height()));
  });
  return strips;
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
  EncodedBytes file;
  append(file, "\x89PNG\r\n\x1a\n");
  append_chunk(file, "IHDR", header_chunk(image));
  if (image.transfer() == Transfer::srgb) append_chunk(file, "sRGB", std::span(&kPerceptual, 1));
  append_chunk(file, "IDAT", kZlibHeader);
  const std::vector<StripEncoder::Strip> strips = encode_strips(image, pool);
  std::size_t size = file.size() + 64;  // the strips and what closes the file
  for (const StripEncoder::Strip& strip : strips) size += strip.data.size() + kAroundChunk;
  file.reserve(size);
  std::uint32_t checksum = adler32({});
  for (const StripEncoder::Strip& strip : strips) {
    append_chunk(file, "IDAT", strip.data);
    checksum = adler32_of_both(checksum, strip.adler32, strip.filtered_size);
  }
  EncodedBytes end;
  append_u32(end, checksum);
  append_chunk(file, "IDAT", end);
  append_chunk(file, "IEND", {});
  return file;
}

}  // namespace

Result<Image> screen_pixels(const LayeredImage& image, float exposure, int threads, std::string_view name) {
  ColourChannels channels = find_colour_channels(image);
  if (channels.count == 0)
    return cannot_hold(name, "a film needs channels R, G, B or Y; the picture has " + channel_names(image));
  if (channels.count == 1) channels.colour.fill(channels.colour[0]);
  channels.count = 3;
  channels.alpha = nullptr;
  return quantised<std::uint8_t>(image, channels, PixelType::u8, exposure, TaskPool(threads));
}

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
