#include "render/depth_map_painter.h"

#include <algorithm>

#include "raster/tile_raster.h"
#include "render/warped_casters.h"
#include "shade/surface_cut.h"

namespace laterna::render {
namespace {

// Every texel is written, so that compilers make vectors of it.
void mark_empty_texels(float* tile, float reversed_far) {
  for (int i = 0; i < raster::kTilePixels; ++i) {
    tile[i] = tile[i] == reversed_far ? shadow::kNothingSeen : tile[i];
  }
}

}  // namespace

DepthMapPainter::Bins DepthMapPainter::sort_casters(const raster::RasterView& view, const TaskPool* pool) {
  const std::lock_guard lock(mutex_);
  if (bins_ != nullptr) return bins_;
  raster::BinOptions options;
  options.cull = faces_ == CasterFaces::back_only ? raster::CullFaces::front : raster::CullFaces::none;
  options.required_flags = kCastsShadow;
  options.excluded_flags = kPaneFlags;  // see shadow/panes.h
  options.pixels = {0, 0, view.width, view.height};
  options.instruction_set = set_;
  BinsPool::Lease lease = bins_pool_.take(bins_owner_);
  const TaskPool alone(1);
  const TaskPool& threads = pool != nullptr ? *pool : alone;
  if (warp_) {
    // Sorted triangles are copies: the warped ones are needed no longer than for sorting.
    const WarpedCasters casters(frame_.geometry(), *warp_, threads);
    lease->fill(view, casters.geometry(), options, threads);
  } else {
    lease->fill(view, frame_.geometry(), options, threads);
  }
  working_bytes_ = lease->memory_bytes();
  bins_ = std::move(lease);
  return bins_;
}

StageTimes DepthMapPainter::prepare(const raster::RasterView& view, const TaskPool& pool) {
  return sort_casters(view, &pool)->statistics().times;
}

void DepthMapPainter::paint(const raster::RasterView& view, int tile_x, int tile_y, float* depth,
                            TriangleId* ids) {
  // Other threads are busy with tiles of their own.
  const Bins bins = sort_casters(view, nullptr);
  const raster::RasterView unwarped =
      warp_ ? raster::RasterView(warp_->light_view, view.width, view.height) : view;
  const shade::SurfaceCut unwarped_cut({&frame_, &unwarped, Interpolation::perspective, 1}, true, set_);
  std::optional<WarpedCut> warped_cut;
  if (warp_) warped_cut.emplace(unwarped_cut, *warp_, view, unwarped);
  const raster::AlphaCut& cut = warped_cut ? static_cast<const raster::AlphaCut&>(*warped_cut) : unwarped_cut;
  const raster::TileTask task = {&view, bins->batches(), tile_x, tile_y, 0, 0, &cut};
  std::fill_n(depth, raster::kTilePixels, view.reversed_far);
  if (ids != nullptr) {
    std::fill_n(ids, raster::kTilePixels, kNoTriangle);
    raster::rasterise_visibility_for(set_)(task, depth, ids);
  } else {
    raster::rasterise_depth_for(set_)(task, depth);
  }
  mark_empty_texels(depth, view.reversed_far);
}

void DepthMapPainter::rest() {
  const std::lock_guard lock(mutex_);
  bins_.reset();
}

}  // namespace laterna::render
