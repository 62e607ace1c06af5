// Pictures as large as a tile, and their sums.
#pragma once

#include <array>

#include "raster/tile_raster.h"

namespace laterna::shade {

/// One channel of a tile, in the tile's storage order (raster::index_in_tile).
struct alignas(64) TilePlane : std::array<float, raster::kTilePixels> {};
struct TileColor {
  TilePlane r, g, b;
};

inline void fill(TileColor& color, float r, float g, float b) {
  color.r.fill(r);
  color.g.fill(g);
  color.b.fill(b);
}

inline void add(TilePlane& sum, const TilePlane& part) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += part[i];
}
inline void add(TileColor& sum, const TileColor& part) {
  add(sum.r, part.r);
  add(sum.g, part.g);
  add(sum.b, part.b);
}

inline void scale(TilePlane& plane, float factor) {
  for (float& value : plane) value *= factor;
}
inline void scale(TileColor& color, float factor) {
  scale(color.r, factor);
  scale(color.g, factor);
  scale(color.b, factor);
}

}  // namespace laterna::shade
