#include "image/png_plain.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <vector>

#include "base/aligned_vector.h"
#include "image/image_rows.h"
#include "image/png_format.h"

namespace laterna::image {
namespace {

using LargeBuffer = AlignedVector<std::uint8_t>;

constexpr std::size_t kSignatureBytes = 8;

struct Chunk {
  std::string_view type;
  std::span<const std::uint8_t> data;
};

// Chunk after chunk, as long as lengths and checksums are right.
class ChunkReader {
 public:
  explicit ChunkReader(std::span<const std::uint8_t> file) : rest_(file.subspan(kSignatureBytes)) {}

  std::optional<Chunk> next() {
    constexpr std::size_t kAround = 12;  // length and type before the data, the checksum behind it
    if (rest_.size() < kAround) return std::nullopt;
    const std::size_t length = big_endian(0);
    if (length > rest_.size() - kAround) return std::nullopt;
    const std::span<const std::uint8_t> covered = rest_.subspan(4, 4 + length);
    if (libdeflate_crc32(0, covered.data(), covered.size()) != big_endian(8 + length)) return std::nullopt;
    rest_ = rest_.subspan(kAround + length);
    return Chunk{{reinterpret_cast<const char*>(covered.data()), 4}, covered.subspan(4)};
  }

 private:
  [[nodiscard]] std::uint32_t big_endian(std::size_t at) const {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8U | rest_[at + i];
    return value;
  }

  std::span<const std::uint8_t> rest_;
};

bool is_plain_header(std::span<const std::uint8_t> header, const Image& image) {
  if (header.size() != 13 || image.type() != PixelType::u8) return false;
  const bool is_8_bit = header[8] == 8, is_interlaced = header[12] != 0;
  return is_8_bit && !is_interlaced && header[9] == png_colour_type(image);
}

// The data of all IDAT chunks, where there is nothing that libpng would make something of: palettes, transparent
// colours, chunks that must be understood, or an order that is wrong.
std::optional<LargeBuffer> find_data(std::span<const std::uint8_t> file, const Image& image) {
  ChunkReader chunks(file);
  const std::optional<Chunk> header = chunks.next();
  if (!header || header->type != "IHDR" || !is_plain_header(header->data, image)) return std::nullopt;
  LargeBuffer data;
  bool is_complete = false;  // a chunk that is no IDAT came after one
  while (const std::optional<Chunk> chunk = chunks.next()) {
    if (chunk->type == "IEND") return data;
    if (chunk->type == "IDAT") {
      if (is_complete) return std::nullopt;
      data.insert(data.end(), chunk->data.begin(), chunk->data.end());
      continue;
    }
    const bool must_be_understood = (static_cast<unsigned char>(chunk->type[0]) & 0x20U) == 0;
    if (must_be_understood || chunk->type == "tRNS") return std::nullopt;
    is_complete = !data.empty();
  }
  return std::nullopt;
}

struct FreeDecompressor {
  void operator()(libdeflate_decompressor* decompressor) const { libdeflate_free_decompressor(decompressor); }
};

bool decompress(const LargeBuffer& data, LargeBuffer& to) {
  const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> decompressor(
      libdeflate_alloc_decompressor());
  if (decompressor == nullptr) throw std::bad_alloc();
  return libdeflate_zlib_decompress(decompressor.get(), data.data(), data.size(), to.data(), to.size(),
                                    nullptr) == LIBDEFLATE_SUCCESS;
}

// The neighbour that left + above − corner comes nearest to (PNG specification, 9.4).
int paeth(int left, int above, int corner) {
  const int to_left = std::abs(above - corner);
  const int to_above = std::abs(left - corner);
  const int to_corner = std::abs(left + above - 2 * corner);
  const int nearer = to_above <= to_corner ? above : corner;
  return to_left <= to_above && to_left <= to_corner ? left : nearer;
}

// One row. `predict` is given the neighbours of a byte: the same channel of the pixel to the left, of the one above, and
// of the one between these.
template <std::size_t kChannels, class Predict>
void add_prediction(const std::uint8_t* from, const std::uint8_t* above, std::size_t size, std::uint8_t* to,
                    Predict predict) {
  std::array<int, kChannels> left = {}, corner = {};
  for (std::size_t i = 0; i < size; i += kChannels) {
    for (std::size_t c = 0; c < kChannels; ++c) {
      const int over = above[i + c];
      left[c] = (from[i + c] + predict(left[c], over, corner[c])) & 255;
      corner[c] = over;
      to[i + c] = static_cast<std::uint8_t>(left[c]);
    }
  }
}

// The reverse of the filter named by `filter`; false if there is none of that number.
template <std::size_t kChannels>
bool unfilter_row(int filter, const std::uint8_t* from, const std::uint8_t* above, std::size_t size,
                  std::uint8_t* to) {
  const auto add = [&](auto predict) { add_prediction<kChannels>(from, above, size, to, predict); };
  switch (filter) {
    case 0:
      std::copy_n(from, size, to);
      return true;
    case 1:
      add([](int left, int, int) { return left; });
      return true;
    case 2:
      add([](int, int over, int) { return over; });
      return true;
    case 3:
      add([](int left, int over, int) { return (left + over) / 2; });
      return true;
    case 4:
      add(paeth);
      return true;
    default:
      return false;
  }
}

template <std::size_t kChannels>
bool unfilter(const LargeBuffer& filtered, Image& image) {
  const std::size_t size = row_bytes(image, 0).size();
  const std::vector<std::uint8_t> black(size);  // what lies above the first row
  const std::uint8_t* above = black.data();
  const std::uint8_t* from = filtered.data();
  for (int y = 0; y < image.height(); ++y, from += size + 1) {
    auto* row = reinterpret_cast<std::uint8_t*>(row_bytes(image, y).data());
    if (!unfilter_row<kChannels>(from[0], from + 1, above, size, row)) return false;
    above = row;
  }
  return true;
}

bool unfilter(const LargeBuffer& filtered, Image& image) {
  switch (image.channels()) {
    case 1:
      return unfilter<1>(filtered, image);
    case 2:
      return unfilter<2>(filtered, image);
    case 3:
      return unfilter<3>(filtered, image);
    default:
      return unfilter<4>(filtered, image);
  }
}

}  // namespace

bool read_plain_png(std::span<const std::byte> file, Image& image) {
  const std::optional<LargeBuffer> data =
      find_data({reinterpret_cast<const std::uint8_t*>(file.data()), file.size()}, image);
  if (!data) return false;
  LargeBuffer filtered((row_bytes(image, 0).size() + 1) * static_cast<std::size_t>(image.height()));
  return decompress(*data, filtered) && unfilter(filtered, image);
}

}  // namespace laterna::image
