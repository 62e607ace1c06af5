// From clusters in world space to triangles sorted by screen tile. Output of the set-up stage (triangle_setup), input
// of the tile stage (tile_raster).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/aligned_vector.h"
#include "base/task_pool.h"
#include "base/triangle_clusters.h"
#include "laterna/instruction_set.h"
#include "laterna/stages.h"
#include "raster/raster_view.h"

namespace laterna::raster {

/// Tiles are 64 × 64 pixels: depth and triangle of each take 32 KB, which stays in the first-level cache.
inline constexpr int kTileBits = 6;
inline constexpr int kTileSide = 1 << kTileBits;
inline constexpr int kTilePixels = kTileSide * kTileSide;
/// Tiles that a row of so many pixels begins.
inline constexpr int tiles_across(int pixels) { return (pixels + kTileSide - 1) / kTileSide; }
/// Within a tile, pixels are stored in blocks of 4 × 4: 16 floats, one cache line, one AVX-512 register.
inline constexpr int kBlockSide = 4;
inline constexpr int kBlockPixels = kBlockSide * kBlockSide;
inline constexpr int kBlocksPerSide = kTileSide / kBlockSide;

/// Where pixel (x, y) of a tile is stored.
constexpr int index_in_tile(int x, int y) {
  return ((y >> 2) * kBlocksPerSide + (x >> 2)) * kBlockPixels + (y & 3) * kBlockSide + (x & 3);
}

/// Positions are snapped to 1/256 pixel.
inline constexpr int kSubpixelBits = 8;
inline constexpr int kSubpixels = 1 << kSubpixelBits;

/// Triangles are clipped to this many pixels on each side of the origin. Snapped coordinates then fit 23 bits with
/// sign and an edge's slope 24, so that slope · 63 pixels of a tile stays below 2³⁰.
inline constexpr int kGuardBand = 16384;
static_assert(std::int64_t{2} * kGuardBand * kSubpixels * (kTileSide - 1) < (std::int64_t{1} << 30));
/// Largest side of a picture: half of it lies on each side of the origin, the rest of the guard band spares clipping.
inline constexpr int kMaxRasterSide = kGuardBand;

/// A triangle up to this many pixels wide and high takes the short path of set-up and tile stage.
inline constexpr int kSmallTriangle = 16;

enum TriangleKind : std::uint32_t {
  kMasked = 1U << 0U,   // the cut is asked about each covered sample
  kBlended = 1U << 1U,  // collected in a second list over the opaque surface
};

/// A triangle at most kSmallTriangle pixels wide and high, as set-up leaves it; one cache line. Its numbers are those at
/// the centre of its first pixel, (x, y), and their change from there.
struct alignas(kCacheLine) SmallTriangle {
  /// Edge functions in 1/256 pixel, less 1 where samples on the edge belong to the neighbour: at least 0 inside.
  std::int32_t edge[3];
  /// Change of the first two edge functions in 1/256 pixel; that of the third is the negative sum of both.
  float edge_dx[2], edge_dy[2];
  std::int16_t x, y;           ///< from the view's origin
  std::uint8_t columns, rows;  ///< of pixels with samples that may be covered
  std::uint16_t kind;          ///< TriangleKind
  float q, q_dx, q_dy;         ///< reversed depth
  float q_min,
      q_max;  ///< of the corners: snapping may let a covered sample lie just outside the true triangle
  TriangleId id;
};
static_assert(sizeof(SmallTriangle) == kCacheLine);

/// Any other triangle; one cache line. Corners are ordered so that the area is positive (clockwise on screen).
struct alignas(kCacheLine) WideTriangle {
  std::int32_t x[3], y[3];  ///< snapped, relative to the view's origin
  /// Reversed depth q(x, y) = q_0 + q_dx x + q_dy y, from the corners before clipping and snapping.
  double q_0, q_dx, q_dy;
  float q_min, q_max;  ///< of the corners
  TriangleId id;
  std::uint32_t kind;  ///< TriangleKind
};
static_assert(sizeof(WideTriangle) == kCacheLine);

/// A rectangle of pixels, or of tiles: begin inclusive, end exclusive.
struct Rect {
  int x_begin = 0, y_begin = 0, x_end = 0, y_end = 0;
  [[nodiscard]] int width() const { return x_end - x_begin; }
  [[nodiscard]] int height() const { return y_end - y_begin; }
  [[nodiscard]] bool is_empty() const { return x_begin >= x_end || y_begin >= y_end; }
  /// Grows to hold `other`; `nowhere()` is where to start from.
  void include(const Rect& other) {
    x_begin = std::min(x_begin, other.x_begin);
    y_begin = std::min(y_begin, other.y_begin);
    x_end = std::max(x_end, other.x_end);
    y_end = std::max(y_end, other.y_end);
  }
  static constexpr Rect nowhere() { return {1 << 30, 1 << 30, -(1 << 30), -(1 << 30)}; }
};

inline Rect overlap(const Rect& a, const Rect& b) {
  return {std::max(a.x_begin, b.x_begin), std::max(a.y_begin, b.y_begin), std::min(a.x_end, b.x_end),
          std::min(a.y_end, b.y_end)};
}

/// Pixels of one axis, from the view's origin: end exclusive.
struct PixelSpan {
  int begin, end;
};
/// Those with samples in the bounds of three snapped coordinates, where samples lie from `least` to `most` 1/256 pixel
/// off their pixel's centre.
inline PixelSpan pixels_between(const std::int32_t* v, int least, int most) {
  const int low = std::min({v[0], v[1], v[2]}), high = std::max({v[0], v[1], v[2]});
  return {(low + kSubpixels / 2 - 1 - most) >> kSubpixelBits,
          ((high - kSubpixels / 2 - least) >> kSubpixelBits) + 1};
}

enum class CullFaces : std::uint8_t {
  none,          ///< shadow maps
  single_sided,  ///< back faces of clusters that are not double-sided: cameras
  front,         ///< front faces of closed meshes: "render back faces into the map" (row 81)
};

/// What lies behind a plane is not drawn: normal · position < offset.
struct CuttingPlane {
  glm::dvec3 normal_ws{0};
  double offset = 0;  ///< metres
  [[nodiscard]] double side(const glm::dvec3& position_ws) const {
    return normal_ws.x * position_ws.x + normal_ws.y * position_ws.y + normal_ws.z * position_ws.z - offset;
  }
};

struct BinOptions {
  CullFaces cull = CullFaces::none;
  std::uint32_t required_flags = 0;      ///< only clusters with all of these
  std::uint32_t excluded_flags = 0;      ///< no clusters with any of these
  std::uint32_t cut_flags = kAlphaMask;  ///< clusters with any of these are asked about (AlphaCut)
  bool nearest_first = true;             ///< sort clusters front to back: fewer samples are drawn over
  Rect pixels;                           ///< what is needed of the picture
  int sample_reach = 0;                  ///< largest sample offset from the pixel centre, in 1/256 pixel
  InstructionSet instruction_set = InstructionSet::scalar;
  const CuttingPlane* cut = nullptr;  ///< null: nothing is cut; must stay while triangles are binned
  /// By cluster, those that are left out: a mirror in its own picture. Null: none; must stay likewise.
  const std::vector<bool>* left_out = nullptr;
};

struct BinStatistics {
  std::uint64_t clusters = 0, clusters_culled = 0;
  std::uint64_t triangles = 0, triangles_binned = 0;
  StageTimes times;
};

/// Which triangles touch which tile: first those that cover what they touch, then those with holes, which are better
/// asked for where nothing stands in front.
struct TileLists {
  struct List {
    std::span<const std::uint32_t> triangles;
    float nearest;  ///< largest reversed depth of any of them
  };

  Rect tiles;                          // bounds of what the triangles touch
  std::vector<std::uint32_t> offsets;  // into entries, two lists for each tile, and the end
  std::vector<std::uint32_t> entries;  // triangles
  std::vector<float> nearest;          // by list

  [[nodiscard]] List in_tile(int tile_x, int tile_y, bool with_holes) const {
    if (tile_x < tiles.x_begin || tile_x >= tiles.x_end || tile_y < tiles.y_begin || tile_y >= tiles.y_end)
      return {};
    const std::size_t i = list_number(tile_x, tile_y, with_holes);
    return {{entries.data() + offsets[i], offsets[i + 1] - offsets[i]}, nearest[i]};
  }
  [[nodiscard]] std::size_t list_number(int tile_x, int tile_y, bool with_holes) const {
    const int tile = (tile_y - tiles.y_begin) * tiles.width() + tile_x - tiles.x_begin;
    return 2 * static_cast<std::size_t>(tile) + (with_holes ? 1 : 0);
  }
};

/// The work of one task: consecutive clusters, the nearest first. At equal depth the smaller id wins, so that the order
/// of drawing is for speed alone.
struct Batch {
  AlignedVector<SmallTriangle> small;
  AlignedVector<WideTriangle> wide;
  Rect small_pixels, wide_pixels;  // bounds of what they touch, from the view's origin
  TileLists small_by_tile, wide_by_tile;
  BinStatistics statistics;
};

/// Triangles sorted by tile. Kept and refilled from frame to frame, so that its memory is touched only once.
class TriangleBins {
 public:
  /// Culls, transforms, clips, sets up and bins. What comes out depends on neither threads nor instruction set.
  void fill(const RasterView& view, const TriangleClusters& geometry, const BinOptions& options,
            const TaskPool& pool);

  [[nodiscard]] std::span<const Batch> batches() const { return {batches_.data(), used_}; }
  [[nodiscard]] BinStatistics statistics() const;
  /// What is held, also from earlier fillings.
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  std::vector<Batch> batches_;
  double cull_ms_ = 0;
  std::size_t used_ = 0;
  std::vector<std::uint32_t> order_;
};

}  // namespace laterna::raster
