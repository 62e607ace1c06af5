#include "render/picture_writer.h"

#include <algorithm>

#include "base/refuse.h"
#include "image/colour.h"

namespace laterna::render {
namespace {

using raster::kTileSide;
using shade::TilePlane;

// Row y of a tile, from blocks of 4 × 4 to a run of pixels.
void read_row(const TilePlane& plane, int y, float* row) {
  for (int block = 0; block < raster::kBlocksPerSide; ++block) {
    const float* from = plane.data() + raster::index_in_tile(block * raster::kBlockSide, y);
    std::copy_n(from, raster::kBlockSide, row + block * raster::kBlockSide);
  }
}

}  // namespace

Result<PictureWriter> PictureWriter::create(const RenderSettings& settings, const RenderTarget& target,
                                            const frame::Frame& frame) {
  PictureWriter writer;
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
    read_row(plane, y, row);
    std::copy_n(row, columns,
                target.pixels + static_cast<std::size_t>(tile_y * kTileSide + y) * target.row_stride + x);
  }
}

void PictureWriter::write_color8(int tile_x, int tile_y, const shade::TileResult& tile) const {
  const int x = tile_x * kTileSide;
  const auto columns = static_cast<std::size_t>(std::min(kTileSide, width_ - x));
  const int rows = std::min(kTileSide, height_ - tile_y * kTileSide);
  const auto channels = static_cast<std::size_t>(color8_->channels);
  const TilePlane* planes[3] = {&tile.beauty.r, &tile.beauty.g, &tile.beauty.b};
  float row[kTileSide];
  float alpha[kTileSide];
  std::uint8_t codes[kTileSide];
  for (int y = 0; y < rows; ++y) {
    std::uint8_t* out = color8_->pixels +
                        static_cast<std::size_t>(tile_y * kTileSide + y) * color8_->row_stride +
                        static_cast<std::size_t>(x) * channels;
    if (channels == 4) read_row(tile.alpha, y, alpha);
    for (std::size_t c = 0; c < 3; ++c) {
      read_row(*planes[c], y, row);
      for (std::size_t i = 0; i < columns; ++i) row[i] *= color8_->exposure;
      if (channels == 4) {
        for (std::size_t i = 0; i < columns; ++i) row[i] = alpha[i] > 0 ? row[i] / alpha[i] : 0;
      }
      image::encode_srgb(std::span<const float>(row, columns), std::span<std::uint8_t>(codes, columns));
      for (std::size_t i = 0; i < columns; ++i) out[i * channels + c] = codes[i];
    }
    if (channels != 4) continue;
    image::encode_linear(std::span<const float>(alpha, columns), std::span<std::uint8_t>(codes, columns));
    for (std::size_t i = 0; i < columns; ++i) out[i * channels + 3] = codes[i];
  }
}

}  // namespace laterna::render
