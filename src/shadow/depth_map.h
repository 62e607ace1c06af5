// What a light sees: the nearest reversed depth at every texel.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include "base/aligned_vector.h"
#include "raster/raster_view.h"
#include "raster/triangle_bins.h"

namespace laterna::shadow {

/// Texel of a depth map in which the light sees nothing.
inline constexpr float kNothingSeen = -std::numeric_limits<float>::max();

/// Draws tiles of a depth map. Calls may come from several threads at once.
class TilePainter {
 public:
  virtual ~TilePainter() = default;
  TilePainter() = default;
  TilePainter(const TilePainter&) = delete;
  TilePainter& operator=(const TilePainter&) = delete;
  /// `depth` and `ids` take raster::kTilePixels each; `ids` is null where triangles are not kept.
  virtual void paint(const raster::RasterView& view, int tile_x, int tile_y, float* depth,
                     TriangleId* ids) = 0;
  /// Gives up what it can make again: no tiles will be asked for until the next picture.
  virtual void rest() = 0;
  /// What it holds while it paints, as far as it knows.
  [[nodiscard]] virtual std::size_t working_bytes() const = 0;
};

/// Texels are stored in tiles of 64 × 64 and blocks of 4 × 4, as they are rasterised: a 2 × 2 filter mostly stays in
/// one cache line. Values are reversed depths of `view` (1/distance in a perspective view), kNothingSeen where nothing
/// is; distance() gives metres along the light's axis.
///
/// With a painter, a tile is drawn when require() first asks for it: most of what a light sees no picture shows. Until
/// then its texels are not to be read.
class DepthMap {
 public:
  DepthMap() = default;
  /// `keeps_triangles`: which triangle each texel saw is kept too. `outworn`: a map that nobody needs any more, whose
  /// memory is taken over.
  DepthMap(const raster::RasterView& view, bool keeps_triangles, DepthMap outworn)
      : view_(view),
        tiles_x_(raster::tiles_across(view.width)),
        tiles_y_(raster::tiles_across(view.height)),
        texels_(std::move(outworn.texels_)),
        triangles_(std::move(outworn.triangles_)) {
    const std::size_t count = tile_count() * raster::kTilePixels;
    resize(texels_, count);
    resize(triangles_, keeps_triangles ? count : 0);
  }
  DepthMap(const raster::RasterView& view, bool keeps_triangles)
      : DepthMap(view, keeps_triangles, DepthMap()) {}

  /// From now on tiles come from `painter`.
  void set_painter(std::unique_ptr<TilePainter> painter) {
    painter_ = std::move(painter);
    states_ = std::make_unique<TileStates>(tile_count());
  }
  [[nodiscard]] bool is_complete() const {
    return states_ == nullptr || states_->missing.load(std::memory_order_acquire) == 0;
  }
  [[nodiscard]] bool is_drawn(int tile_x, int tile_y) const {
    return states_ == nullptr ||
           states_->of_tile[tile_number(tile_x, tile_y)].load(std::memory_order_acquire) == kDrawn;
  }
  /// Returns when the tile is drawn, by this thread or another.
  void require(int tile_x, int tile_y);
  /// What the tile shows is no longer so: it is drawn again when it is asked for. Texels stay as they are until then. Only
  /// with a painter, and while nobody reads the map.
  void forget(int tile_x, int tile_y);
  [[nodiscard]] std::size_t tiles_drawn() const {
    return states_ == nullptr ? tile_count()
                              : tile_count() - states_->missing.load(std::memory_order_acquire);
  }
  /// The same picture, seen through a view with another near plane, while nobody reads the map.
  void set_view(const raster::RasterView& view) { view_ = view; }
  /// See TilePainter.
  void rest() {
    if (painter_ != nullptr) painter_->rest();
  }
  [[nodiscard]] std::size_t working_bytes() const {
    return painter_ == nullptr || is_complete() ? 0 : painter_->working_bytes();
  }

  [[nodiscard]] const raster::RasterView& view() const { return view_; }
  [[nodiscard]] int width() const { return view_.width; }
  [[nodiscard]] int height() const { return view_.height; }
  [[nodiscard]] int tiles_x() const { return tiles_x_; }
  [[nodiscard]] int tiles_y() const { return tiles_y_; }
  [[nodiscard]] std::size_t tile_count() const {
    return static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y_);
  }
  [[nodiscard]] float* tile(int x, int y) { return texels_.data() + tile_start(x, y); }
  [[nodiscard]] const float* texels() const { return texels_.data(); }
  /// Null where triangles are not kept; kNoTriangle where nothing is.
  [[nodiscard]] TriangleId* triangle_tile(int x, int y) {
    return triangles_.empty() ? nullptr : triangles_.data() + tile_start(x, y);
  }
  [[nodiscard]] const TriangleId* triangles() const {
    return triangles_.empty() ? nullptr : triangles_.data();
  }
  [[nodiscard]] float reversed_depth(int x, int y) const {
    return texels_[tile_start(x >> raster::kTileBits, y >> raster::kTileBits) +
                   static_cast<std::size_t>(
                       raster::index_in_tile(x & (raster::kTileSide - 1), y & (raster::kTileSide - 1)))];
  }
  /// Metres along the axis, +infinity where nothing is.
  [[nodiscard]] double distance(int x, int y) const {
    const float q = reversed_depth(x, y);
    return q == kNothingSeen ? std::numeric_limits<double>::infinity() : view_.distance_from_reversed(q);
  }
  [[nodiscard]] std::size_t memory_bytes() const {
    return texels_.capacity() * sizeof(float) + triangles_.capacity() * sizeof(TriangleId);
  }

 private:
  enum TileState : std::uint8_t { kMissing, kBeingDrawn, kDrawn };
  struct TileStates {
    explicit TileStates(std::size_t count)
        : missing(count), of_tile(std::make_unique<std::atomic<std::uint8_t>[]>(count)) {}
    std::atomic<std::size_t> missing;
    std::unique_ptr<std::atomic<std::uint8_t>[]> of_tile;
  };

  [[nodiscard]] std::size_t tile_number(int x, int y) const {
    return static_cast<std::size_t>(y * tiles_x_ + x);
  }
  [[nodiscard]] std::size_t tile_start(int x, int y) const { return tile_number(x, y) * raster::kTilePixels; }

  // Contents are not kept, and no more memory than is needed.
  template <class T>
  static void resize(SparseAlignedVector<T>& values, std::size_t count) {
    if (values.capacity() != count) values = SparseAlignedVector<T>();
    values.resize(count);
  }

  raster::RasterView view_;
  int tiles_x_ = 0, tiles_y_ = 0;
  SparseAlignedVector<float> texels_;
  SparseAlignedVector<TriangleId> triangles_;
  std::unique_ptr<TilePainter> painter_;
  std::unique_ptr<TileStates> states_;  // null: all drawn
};

}  // namespace laterna::shadow
