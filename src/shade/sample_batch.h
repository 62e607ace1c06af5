// Batches of samples for shading, from the pixels of a tile and from fragments that are blended over them.
#pragma once

#include <span>

#include "frame/frame.h"
#include "laterna/instruction_set.h"
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
using FillFromBlocks = void (*)(const TileOrigin& origin, std::span<const SurfaceGroups::Block> blocks,
                                const float* depth, const TriangleId* ids, shadow::SurfaceSamples& samples);
FillFromBlocks fill_from_blocks_for(InstructionSet set);

/// `indices` into `fragments`, at most shadow::kMaxSamples of one surface; SurfaceSamples::pixel becomes the index.
void fill_from_fragments(const TileOrigin& origin, std::span<const raster::Fragment> fragments,
                         std::span<const std::uint32_t> indices, shadow::SurfaceSamples& samples);

/// SurfaceSamples::position_error of samples of which the farthest has the reversed depth `least_q`.
float position_error(const TileOrigin& origin, float least_q);

}  // namespace laterna::shade
