#include "render/picture_writer.h"

#include <algorithm>
#include <cstring>

#include "base/refuse.h"

namespace laterna::render {
namespace {

using raster::kTileSide;
using shade::TilePlane;

// Row y of a tile, from blocks of 4 × 4 to a run of pixels.
template <class T>
void read_row(const T* plane, int y, T* row) {
  for (int block = 0; block < raster::kBlocksPerSide; ++block) {
    const T* from = plane + raster::index_in_tile(block * raster::kBlockSide, y);
    std::copy_n(from, raster::kBlockSide, row + block * raster::kBlockSide);
  }
}

// Pixels of four bytes, the last of them 0, to pixels of three, four at a time.
void drop_alpha(const std::uint32_t* pixels, std::uint8_t* bytes) {
  for (int x = 0; x < kTileSide; x += 4, pixels += 4, bytes += 12) {
    const std::uint32_t packed[3] = {pixels[0] | pixels[1] << 24U, pixels[1] >> 8U | pixels[2] << 16U,
                                     pixels[2] >> 16U | pixels[3] << 8U};
    std::memcpy(bytes, packed, sizeof packed);
  }
}

}  // namespace

Result<PictureWriter> PictureWriter::create(const RenderSettings& settings, const RenderTarget& target,
                                            const frame::Frame& frame, InstructionSet set) {
  PictureWriter writer;
  writer.encode_pixels_ = image::encode_pixels_for(set);
  writer.width_ = settings.width;
  writer.height_ = settings.height;
  const auto width = static_cast<std::size_t>(settings.width);
  if (target.color8) {
    const ColorTarget8& color = *target.color8;
    if (color.channels != 3 && color.channels != 4) return refuse("an 8-bit target has 3 or 4 channels");
    if (color.pixels == nullptr || color.row_stride < width * static_cast<std::size_t>(color.channels)) {
      return refuse("the 8-bit target has no memory for a row");
    }
    writer.color8_ = color;
  }
  const std::vector<PictureChannel> channels = picture_channels(settings, frame);
  for (const ChannelTarget& wanted : target.channels) {
    const auto found = std::find_if(channels.begin(), channels.end(), [&](const PictureChannel& channel) {
      return channel.name == wanted.name;
    });
    if (found == channels.end()) return refuse("these settings produce no channel \"" + wanted.name + "\"");
    if (wanted.pixels == nullptr || wanted.row_stride < width) {
      return refuse("the target of channel \"" + wanted.name + "\" has no memory for a row");
    }
    writer.planes_.push_back({found->plane, wanted.pixels, wanted.row_stride});
  }
  return writer;
}

void PictureWriter::write(int tile_x, int tile_y, const shade::TileResult& tile) const {
  alignas(64) TilePlane buffer;
  for (const Plane& target : planes_) write_plane(tile_x, tile_y, *target.source(tile, buffer), target);
  if (color8_) write_color8(tile_x, tile_y, tile);
}

void PictureWriter::write_plane(int tile_x, int tile_y, const TilePlane& plane, const Plane& target) const {
  const int x = tile_x * kTileSide;
  const int columns = std::min(kTileSide, width_ - x);
  const int rows = std::min(kTileSide, height_ - tile_y * kTileSide);
  float row[kTileSide];
  for (int y = 0; y < rows; ++y) {
    read_row(plane.data(), y, row);
    std::copy_n(row, columns,
                target.pixels + static_cast<std::size_t>(tile_y * kTileSide + y) * target.row_stride + x);
  }
}

void PictureWriter::write_color8(int tile_x, int tile_y, const shade::TileResult& tile) const {
  const int x = tile_x * kTileSide;
  const auto columns = static_cast<std::size_t>(std::min(kTileSide, width_ - x));
  const int rows = std::min(kTileSide, height_ - tile_y * kTileSide);
  const auto channels = static_cast<std::size_t>(color8_->channels);
  const bool has_alpha = channels == 4;
  std::uint8_t* first = color8_->pixels + static_cast<std::size_t>(tile_y * kTileSide) * color8_->row_stride +
                        static_cast<std::size_t>(x) * channels;
  // Nobody has touched the picture's memory yet: it is fetched while the tile is encoded.
  constexpr std::size_t kCacheLine = 64;
  for (int y = 0; y < rows; ++y) {
    const std::uint8_t* row = first + static_cast<std::size_t>(y) * color8_->row_stride;
    for (std::size_t byte = 0; byte < columns * channels; byte += kCacheLine)
      __builtin_prefetch(row + byte, 1);
  }
  alignas(64) std::uint32_t pixels[raster::kTilePixels];
  encode_pixels_({tile.beauty.r.data(), tile.beauty.g.data(), tile.beauty.b.data(),
                  has_alpha ? tile.alpha.data() : nullptr, color8_->exposure},
                 raster::kTilePixels, pixels);
  std::uint32_t row[kTileSide];
  std::uint8_t bytes[kTileSide * sizeof *row];
  for (int y = 0; y < rows; ++y) {
    read_row(pixels, y, row);
    if (has_alpha) {
      std::memcpy(bytes, row, sizeof bytes);
    } else {
      drop_alpha(row, bytes);
    }
    std::memcpy(first + static_cast<std::size_t>(y) * color8_->row_stride, bytes, columns * channels);
  }
}

}  // namespace laterna::render
