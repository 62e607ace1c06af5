// Terrain: maps of heights become triangles. docs/terrain.md
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "laterna/result.h"
#include "laterna/scene.h"

namespace laterna {

/// Heights on a grid, seen from above: columns from −X to +X, rows from −Z to +Z.
struct HeightMap {
  int columns = 0, rows = 0;   ///< at least 2 each, together at most kMaxHeightSamples
  std::vector<float> heights;  ///< metres above the terrain's own zero, rows first
};

/// 8192 × 8192: as triangles, 4 GB of scene.
inline constexpr std::size_t kMaxHeightSamples = std::size_t{1} << 26U;

/// Reads a picture's first channel as heights: `height` metres for the largest code of 8- and 16-bit files, with no transfer
/// function, and for 1 in files of floating point. Each texel is a sample. Errors name the file: not readable, of a single row or
/// column, too large, or heights that are not finite or beyond kMaxCoordinate.
Result<HeightMap> read_height_map(const std::filesystem::path& file, double height);

struct TerrainShape {
  double width = 1, depth = 1;  ///< metres along X and Z, from the first sample to the last
  /// Metres by which a sample may lie above or under the surface: larger, and there are fewer triangles. 0: none does.
  double error = 0;
};

/// The surface over a height map, its middle above the origin. Sample (i, j) is at x = (i / (columns − 1) − ½) width and
/// z = (j / (rows − 1) − ½) depth. Normals are those of the map's central differences, (−∂h/∂x, 1, −∂h/∂z), one-sided at its
/// border. Texture coordinates run from (0, 0) at the first sample to (1, 1) at the last.
///
/// Right triangles are halved until every sample is within the error (Evans, Kirkpatrick and Townsend, Right-Triangulated
/// Irregular Networks, Algorithmica 30, 2001): those on both sides of an edge are halved together, so that there is no crack.
/// The level of detail depends on the map alone, so that neither surface nor shadows change with the camera. Takes 8 bytes for
/// each sample, rounded up to whole squares of 256, beside the primitive.
/// Error: heights of another number, a size that is not positive, a negative error.
Result<Primitive> make_terrain(const HeightMap& map, const TerrainShape& shape);

}  // namespace laterna
