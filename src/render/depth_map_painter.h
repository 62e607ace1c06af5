// Tiles of shadow maps, drawn by the camera's own raster code (row 76), in two layers where something moves: what stands still
// is drawn once, and what moves over it.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "base/task_pool.h"
#include "frame/frame.h"
#include "laterna/instruction_set.h"
#include "laterna/scene.h"
#include "light/light_plan.h"
#include "raster/alpha_cut.h"
#include "render/caster_changes.h"
#include "render/reuse_pool.h"
#include "shadow/depth_map.h"

namespace laterna::render {

/// What painters have done, over all maps: see RenderStatistics::MapReuse.
struct MapWork {
  std::atomic<std::uint64_t> tiles_drawn = 0, tiles_updated = 0, triangles = 0, moving_triangles = 0;
};

/// A pass that touches nothing but positions, and alpha where a material is cut out.
///
/// Until something that the map sees moves, all casters are drawn at once. From then on each tile keeps, where casters move in
/// it, a copy without them. At equal depth the smaller id wins, whatever the order, so that both ways give the same bits.
class DepthMapPainter final : public shadow::TilePainter {
 public:
  /// All of these stay while the painter lives.
  struct Source {
    const frame::Frame& frame;
    BinsPool& bins;
    std::size_t bins_owner;
    InstructionSet instruction_set;
    CasterFaces faces;
    MapWork* work = nullptr;  ///< null: not counted
  };
  /// `has_movers`: some of the frame's casters have kMoves.
  DepthMapPainter(const Source& source, std::optional<light::Warp> warp, bool has_movers)
      : source_(source), warp_(warp), began_with_movers_(has_movers) {}

  /// Sorts the casters by tile with all threads, and says what that took. Without it the first tile does so by itself.
  StageTimes prepare(const raster::RasterView& view, const TaskPool& pool);
  void paint(const raster::RasterView& view, int tile_x, int tile_y, float* depth, TriangleId* ids) override;
  void rest() override;
  [[nodiscard]] std::size_t working_bytes() const override { return bins_bytes_ + moving_bins_bytes_; }

  /// Forgets those tiles of the map whose picture the changes alter. The map is this painter's and not warped; nobody reads
  /// it. False: the map does not see them.
  bool update(shadow::DepthMap& map, std::span<const CasterChange> changes);
  /// What is kept beside the map: copies of tiles, and sorted casters until rest().
  [[nodiscard]] std::size_t kept_bytes() const;

 private:
  using Bins = std::shared_ptr<const raster::TriangleBins>;
  enum class Casters : std::uint8_t { all, standing, moving };
  // Of one tile: where what stands still is to be found.
  struct Layer {
    enum class Place : std::uint8_t {
      nowhere,  // it is to be drawn
      in_map,   // in the map itself: nothing moves there
      in_copy
    };
    Place place = Place::nowhere;
    std::unique_ptr<float[]> depth;
    std::unique_ptr<TriangleId[]> ids;
  };

  // `pool` null: by this thread alone.
  Bins sort_casters(const raster::RasterView& view, const TaskPool* pool, Casters which);
  void draw(const raster::RasterView& view, const raster::TriangleBins& bins, int tile_x, int tile_y,
            float* depth, TriangleId* ids) const;
  void paint_layers(const raster::RasterView& view, int tile_x, int tile_y, float* depth, TriangleId* ids);
  void divide_into_layers(const shadow::DepthMap& map);
  void count(std::atomic<std::uint64_t> MapWork::*counter, std::uint64_t number) const {
    if (source_.work != nullptr) source_.work->*counter += number;
  }

  Source source_;
  std::optional<light::Warp> warp_;
  bool began_with_movers_;
  int tiles_x_ = 0;
  std::vector<Layer> layers_;  // one per tile; empty: all casters are drawn at once
  mutable std::mutex mutex_;
  Bins bins_, moving_bins_;                                          // null while resting
  std::atomic<std::size_t> bins_bytes_ = 0, moving_bins_bytes_ = 0;  // when last sorted
};

}  // namespace laterna::render
