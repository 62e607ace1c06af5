// One traversal of a tile's triangles, with several sinks: depth; depth and triangle; fragments over an opaque surface.
#pragma once

#include <vector>

#include "raster/alpha_cut.h"
#include "raster/triangle_bins.h"

namespace laterna::raster {

/// What is drawn where. Sample offsets are in 1/256 pixel from the pixel's centre.
struct TileTask {
  const RasterView* view;
  std::span<const Batch> batches;
  int tile_x, tile_y;
  int offset_x = 0, offset_y = 0;
  const AlphaCut* cut = nullptr;  ///< null: cut-outs are drawn whole
};

/// A sample of a blended surface in front of the opaque one.
struct Fragment {
  std::uint32_t pixel;  // index in the tile
  TriangleId id;
  float reversed_depth;
};

/// Nearest reversed depth at each of the tile's kTilePixels samples; starts from what `depth` holds. Blended triangles
/// are not drawn.
using RasteriseDepth = void (*)(const TileTask& task, float* depth);
RasteriseDepth rasterise_depth_for(InstructionSet set);

/// The same, with the triangle that is nearest; at equal depth the smaller id wins, whatever the order of drawing.
using RasteriseVisibility = void (*)(const TileTask& task, float* depth, TriangleId* ids);
RasteriseVisibility rasterise_visibility_for(InstructionSet set);

/// Appends every sample of blended triangles that lies nearer than `depth`, in drawing order.
using RasteriseFragments = void (*)(const TileTask& task, const float* depth,
                                    std::vector<Fragment>& fragments);
RasteriseFragments rasterise_fragments_for(InstructionSet set);

}  // namespace laterna::raster
