// Tiles of shadow maps, drawn by the camera's own raster code (row 76).
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>

#include "base/task_pool.h"
#include "frame/frame.h"
#include "laterna/instruction_set.h"
#include "laterna/scene.h"
#include "light/light_plan.h"
#include "raster/alpha_cut.h"
#include "render/reuse_pool.h"
#include "shadow/depth_map.h"

namespace laterna::render {

/// A pass that touches nothing but positions, and alpha where a material is cut out.
class DepthMapPainter final : public shadow::TilePainter {
 public:
  /// `frame` and `bins` stay while the painter lives.
  DepthMapPainter(const frame::Frame& frame, BinsPool& bins, std::size_t bins_owner, InstructionSet set,
                  CasterFaces faces, std::optional<light::Warp> warp)
      : frame_(frame),
        bins_pool_(bins),
        bins_owner_(bins_owner),
        set_(set),
        faces_(faces),
        warp_(std::move(warp)) {}

  /// Sorts the casters by tile with all threads, and says what that took. Without it the first tile does so by itself.
  StageTimes prepare(const raster::RasterView& view, const TaskPool& pool);
  void paint(const raster::RasterView& view, int tile_x, int tile_y, float* depth, TriangleId* ids) override;
  void rest() override;
  [[nodiscard]] std::size_t working_bytes() const override { return working_bytes_; }

 private:
  using Bins = std::shared_ptr<const raster::TriangleBins>;
  // `pool` null: by this thread alone.
  Bins sort_casters(const raster::RasterView& view, const TaskPool* pool);

  const frame::Frame& frame_;
  BinsPool& bins_pool_;
  std::size_t bins_owner_;
  InstructionSet set_;
  CasterFaces faces_;
  std::optional<light::Warp> warp_;
  std::mutex mutex_;
  Bins bins_;  // null while resting
  std::atomic<std::size_t> working_bytes_ = 0;
};

}  // namespace laterna::render
