#include "render/depth_map_painter.h"

#include <algorithm>

#include "raster/tile_raster.h"
#include "render/tiles_in_view.h"
#include "render/warped_casters.h"
#include "shade/surface_cut.h"

namespace laterna::render {
namespace {

// Beside the numbers of maps: the two layers' bins are of different sizes.
constexpr std::size_t kMovingBins = std::size_t{1} << 32U;

// Every texel is written, so that compilers make vectors of it.
void replace(float* tile, float what, float by) {
  for (int i = 0; i < raster::kTilePixels; ++i) tile[i] = tile[i] == what ? by : tile[i];
}

bool touches(const raster::TriangleBins& bins, int tile_x, int tile_y) {
  return std::ranges::any_of(bins.batches(), [&](const raster::Batch& batch) {
    return std::ranges::any_of(std::initializer_list<bool>{false, true}, [&](bool with_holes) {
      return !batch.small_by_tile.in_tile(tile_x, tile_y, with_holes).triangles.empty() ||
             !batch.wide_by_tile.in_tile(tile_x, tile_y, with_holes).triangles.empty();
    });
  });
}

template <class Visit>
void for_each_tile(const raster::Rect& tiles, Visit visit) {
  for (int y = tiles.y_begin; y < tiles.y_end; ++y) {
    for (int x = tiles.x_begin; x < tiles.x_end; ++x) visit(x, y);
  }
}

}  // namespace

DepthMapPainter::Bins DepthMapPainter::sort_casters(const raster::RasterView& view, const TaskPool* pool,
                                                    Casters which) {
  const std::lock_guard lock(mutex_);
  const bool moving = which == Casters::moving;
  Bins& sorted = moving ? moving_bins_ : bins_;
  if (sorted != nullptr) return sorted;
  raster::BinOptions options;
  options.cull = source_.faces == CasterFaces::back_only ? raster::CullFaces::front : raster::CullFaces::none;
  options.required_flags = kCastsShadow | (moving ? kMoves : 0U);
  options.excluded_flags = kPaneFlags | (which == Casters::standing ? kMoves : 0U);  // see shadow/panes.h
  options.pixels = {0, 0, view.width, view.height};
  options.instruction_set = source_.instruction_set;
  BinsPool::Lease lease = source_.bins.take(source_.bins_owner | (moving ? kMovingBins : 0));
  const TaskPool alone(1);
  const TaskPool& threads = pool != nullptr ? *pool : alone;
  if (warp_) {
    // Sorted triangles are copies: the warped ones are needed no longer than for sorting.
    const WarpedCasters casters(source_.frame.geometry(), *warp_, threads);
    lease->fill(view, casters.geometry(), options, threads);
  } else {
    lease->fill(view, source_.frame.geometry(), options, threads);
  }
  count(moving ? &MapWork::moving_triangles : &MapWork::triangles, lease->statistics().triangles_binned);
  (moving ? moving_bins_bytes_ : bins_bytes_) = lease->memory_bytes();
  sorted = std::move(lease);
  return sorted;
}

StageTimes DepthMapPainter::prepare(const raster::RasterView& view, const TaskPool& pool) {
  return sort_casters(view, &pool, Casters::all)->statistics().times;
}

// Over what is there, in reversed depths down to that of the far plane.
void DepthMapPainter::draw(const raster::RasterView& view, const raster::TriangleBins& bins, int tile_x,
                           int tile_y, float* depth, TriangleId* ids) const {
  const raster::RasterView unwarped =
      warp_ ? raster::RasterView(warp_->light_view, view.width, view.height) : view;
  const shade::SurfaceCut unwarped_cut({&source_.frame, &unwarped, Interpolation::perspective, 1}, true,
                                       source_.instruction_set);
  std::optional<WarpedCut> warped_cut;
  if (warp_) warped_cut.emplace(unwarped_cut, *warp_, view, unwarped);
  const raster::AlphaCut& cut = warped_cut ? static_cast<const raster::AlphaCut&>(*warped_cut) : unwarped_cut;
  const raster::TileTask task = {&view, bins.batches(), tile_x, tile_y, 0, 0, &cut};
  if (ids != nullptr) {
    raster::rasterise_visibility_for(source_.instruction_set)(task, depth, ids);
  } else {
    raster::rasterise_depth_for(source_.instruction_set)(task, depth);
  }
}

void DepthMapPainter::paint(const raster::RasterView& view, int tile_x, int tile_y, float* depth,
                            TriangleId* ids) {
  if (!layers_.empty()) return paint_layers(view, tile_x, tile_y, depth, ids);
  // Other threads are busy with tiles of their own.
  const Bins bins = sort_casters(view, nullptr, Casters::all);
  std::fill_n(depth, raster::kTilePixels, view.reversed_far);
  if (ids != nullptr) std::fill_n(ids, raster::kTilePixels, kNoTriangle);
  draw(view, *bins, tile_x, tile_y, depth, ids);
  replace(depth, view.reversed_far, shadow::kNothingSeen);
  count(&MapWork::tiles_drawn, 1);
}

// What was drawn stays drawn where it ends with an exception.
void DepthMapPainter::paint_layers(const raster::RasterView& view, int tile_x, int tile_y, float* depth,
                                   TriangleId* ids) {
  Layer& layer = layers_[static_cast<std::size_t>(tile_y * tiles_x_ + tile_x)];
  count(layer.place == Layer::Place::nowhere ? &MapWork::tiles_drawn : &MapWork::tiles_updated, 1);
  if (layer.place == Layer::Place::nowhere) {
    const Bins standing = sort_casters(view, nullptr, Casters::standing);
    std::fill_n(depth, raster::kTilePixels, view.reversed_far);
    if (ids != nullptr) std::fill_n(ids, raster::kTilePixels, kNoTriangle);
    draw(view, *standing, tile_x, tile_y, depth, ids);
    replace(depth, view.reversed_far, shadow::kNothingSeen);
  } else if (layer.place == Layer::Place::in_copy) {
    std::copy_n(layer.depth.get(), raster::kTilePixels, depth);
    if (ids != nullptr) std::copy_n(layer.ids.get(), raster::kTilePixels, ids);
  }
  const Bins moving = sort_casters(view, nullptr, Casters::moving);
  if (!touches(*moving, tile_x, tile_y)) {
    layer = {Layer::Place::in_map, nullptr, nullptr};
    return;
  }
  if (layer.place != Layer::Place::in_copy) {
    auto depth_copy = std::make_unique_for_overwrite<float[]>(raster::kTilePixels);
    std::copy_n(depth, raster::kTilePixels, depth_copy.get());
    std::unique_ptr<TriangleId[]> id_copy;
    if (ids != nullptr) {
      id_copy = std::make_unique_for_overwrite<TriangleId[]>(raster::kTilePixels);
      std::copy_n(ids, raster::kTilePixels, id_copy.get());
    }
    layer = {Layer::Place::in_copy, std::move(depth_copy), std::move(id_copy)};
  }
  replace(depth, shadow::kNothingSeen, view.reversed_far);
  draw(view, *moving, tile_x, tile_y, depth, ids);
  replace(depth, view.reversed_far, shadow::kNothingSeen);
}

void DepthMapPainter::divide_into_layers(const shadow::DepthMap& map) {
  layers_.resize(map.tile_count());
  tiles_x_ = map.tiles_x();
  rest();  // what is sorted is of both
  if (began_with_movers_) return;
  for_each_tile({0, 0, map.tiles_x(), map.tiles_y()}, [&](int x, int y) {
    if (map.is_drawn(x, y)) layers_[static_cast<std::size_t>(y * tiles_x_ + x)].place = Layer::Place::in_map;
  });
}

bool DepthMapPainter::update(shadow::DepthMap& map, std::span<const CasterChange> changes) {
  bool is_seen = false;
  const auto forget_standing = [&](const raster::Rect& tiles) {
    for_each_tile(tiles, [&](int x, int y) { layers_[static_cast<std::size_t>(y * tiles_x_ + x)] = {}; });
  };
  for (const CasterChange& change : changes) {
    const raster::Rect before = tiles_in_view(map.view(), change.before);
    const raster::Rect after = tiles_in_view(map.view(), change.after);
    if (before.is_empty() && after.is_empty()) continue;
    if (layers_.empty()) divide_into_layers(map);
    if (change.stood_before) forget_standing(before);
    if (change.stands_after) forget_standing(after);
    if (change.stood_before || change.stands_after) rest();
    const std::lock_guard lock(mutex_);
    moving_bins_.reset();
    if (change.stands_after) continue;
    is_seen = true;
    for (const raster::Rect& tiles : {before, after})
      for_each_tile(tiles, [&](int x, int y) { map.forget(x, y); });
  }
  return is_seen;
}

void DepthMapPainter::rest() {
  const std::lock_guard lock(mutex_);
  bins_.reset();
  moving_bins_.reset();
}

std::size_t DepthMapPainter::kept_bytes() const {
  std::size_t copies = 0;
  for (const Layer& layer : layers_) {
    if (layer.place != Layer::Place::in_copy) continue;
    copies += raster::kTilePixels * (sizeof(float) + (layer.ids != nullptr ? sizeof(TriangleId) : 0));
  }
  const std::lock_guard lock(mutex_);
  const auto bytes_of = [](const Bins& bins) { return bins == nullptr ? 0 : bins->memory_bytes(); };
  return copies + layers_.capacity() * sizeof(Layer) + bytes_of(bins_) + bytes_of(moving_bins_);
}

}  // namespace laterna::render
