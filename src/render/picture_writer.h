// Shaded tiles into the caller's memory.
#pragma once

#include "image/encode_pixels.h"
#include "laterna/render.h"
#include "render/channels.h"

namespace laterna::render {

class PictureWriter {
 public:
  /// Error: a target names a channel that the settings do not produce, or has no memory.
  static Result<PictureWriter> create(const RenderSettings& settings, const RenderTarget& target,
                                      const frame::Frame& frame, InstructionSet set);

  /// Tiles do not overlap, so calls may come from several threads at once.
  void write(int tile_x, int tile_y, const shade::TileResult& tile) const;

 private:
  struct Plane {
    ChannelPlane source;
    float* pixels;
    std::size_t row_stride;
  };

  void write_plane(int tile_x, int tile_y, const shade::TilePlane& plane, const Plane& target) const;
  void write_color8(int tile_x, int tile_y, const shade::TileResult& tile) const;

  image::EncodePixels encode_pixels_ = nullptr;
  int width_ = 0, height_ = 0;
  std::vector<Plane> planes_;
  std::optional<ColorTarget8> color8_;
};

}  // namespace laterna::render
