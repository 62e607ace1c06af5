// Batches of samples for shading, from the pixels of a tile and from fragments that are blended over them.
#pragma once

#include <span>

#include "frame/frame.h"
#include "raster/tile_raster.h"
#include "shade/surface_groups.h"
#include "shadow/surface_samples.h"

namespace laterna::shade {

/// Where a tile's samples lie: pixel (0, 0) of the tile in the view's coordinates, plus the place within a pixel.
struct TileOrigin {
  const frame::Frame* frame = nullptr;
  const raster::RasterView* view = nullptr;
  float x = 0, y = 0;

  /// offset_x, offset_y: the sample's place from the pixel's centre, in 1/256 pixel.
  TileOrigin(const frame::Frame& frame, const raster::RasterView& view, int tile_x, int tile_y, int offset_x,
             int offset_y);
};

/// At most shadow::kMaxGroups blocks, of the tile's depths and ids (in its storage order).
void fill_from_blocks(const TileOrigin& origin, std::span<const SurfaceGroups::Block> blocks,
                      const float* depth, const TriangleId* ids, shadow::SurfaceSamples& samples);

/// `indices` into `fragments`, at most shadow::kMaxSamples of one surface; SurfaceSamples::pixel becomes the index.
void fill_from_fragments(const TileOrigin& origin, std::span<const raster::Fragment> fragments,
                         std::span<const std::uint32_t> indices, shadow::SurfaceSamples& samples);

}  // namespace laterna::shade
