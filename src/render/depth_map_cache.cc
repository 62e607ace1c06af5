#include "render/depth_map_cache.h"

#include <algorithm>

#include "raster/tile_raster.h"
#include "shade/surface_cut.h"

namespace laterna::render {
namespace {

bool same_view(const light::ShadowView& a, const light::ShadowView& b) {
  const Projection& p = a.view.projection;
  const Projection& q = b.view.projection;
  return a.width == b.width && a.height == b.height && a.view.pose.position_ws == b.view.pose.position_ws &&
         a.view.pose.world_from_view_rotation == b.view.pose.world_from_view_rotation &&
         p.is_orthographic == q.is_orthographic && p.left == q.left && p.right == q.right &&
         p.bottom == q.bottom && p.top == q.top && p.near == q.near && p.far == q.far;
}

std::size_t tile_count(const shadow::DepthMap& map) {
  return static_cast<std::size_t>(map.tiles_x()) * static_cast<std::size_t>(map.tiles_y());
}

// Every texel is written, so that compilers make vectors of it.
void mark_empty_texels(float* tile, float reversed_far) {
  for (int i = 0; i < raster::kTilePixels; ++i) {
    tile[i] = tile[i] == reversed_far ? shadow::kNothingSeen : tile[i];
  }
}

}  // namespace

bool DepthMapKey::operator==(const DepthMapKey& other) const {
  return faces == other.faces && keeps_triangles == other.keeps_triangles &&
         casters_revision == other.casters_revision &&
         std::equal(views.begin(), views.end(), other.views.begin(), other.views.end(), same_view);
}

shadow::DepthMap draw_depth_map(const DrawContext& context, const light::ShadowView& shadow_view,
                                CasterFaces faces, bool keeps_triangles, shadow::DepthMap outworn) {
  shadow::DepthMap map(raster::RasterView(shadow_view.view, shadow_view.width, shadow_view.height),
                       keeps_triangles, std::move(outworn));
  const raster::RasterView& view = map.view();
  raster::BinOptions options;
  options.cull = faces == CasterFaces::back_only ? raster::CullFaces::front : raster::CullFaces::none;
  options.required_flags = kCastsShadow;
  options.blend_as_mask = true;
  options.pixels = {0, 0, map.width(), map.height()};
  options.instruction_set = context.instruction_set;
  const auto bins = context.bins.take();
  bins->fill(view, context.frame.geometry(), options, context.pool);

  const shade::SurfaceCut cut({&context.frame, &view, Interpolation::perspective, 1}, true,
                              context.instruction_set);
  const raster::RasteriseDepth rasterise_depth = raster::rasterise_depth_for(context.instruction_set);
  const raster::RasteriseVisibility rasterise_visibility =
      raster::rasterise_visibility_for(context.instruction_set);
  context.pool.for_each(tile_count(map), [&](std::size_t i, int) {
    if (context.progress.is_cancelled()) return;
    const int x = static_cast<int>(i) % map.tiles_x();
    const int y = static_cast<int>(i) / map.tiles_x();
    float* tile = map.tile(x, y);
    std::fill_n(tile, raster::kTilePixels, view.reversed_far);
    const raster::TileTask task = {&view, bins->batches(), x, y, 0, 0, &cut};
    if (TriangleId* ids = map.triangle_tile(x, y); ids != nullptr) {
      std::fill_n(ids, raster::kTilePixels, kNoTriangle);
      rasterise_visibility(task, tile, ids);
    } else {
      rasterise_depth(task, tile);
    }
    mark_empty_texels(tile, view.reversed_far);
    context.progress.advance();
  });
  return map;
}

DepthMapCache::Found DepthMapCache::find(std::size_t light, const DepthMapKey& key,
                                         const DrawContext& context, bool anew) {
  std::unique_lock list_lock(mutex_);
  Entry& entry = entries_[light];  // stays where it is
  list_lock.unlock();
  const std::lock_guard lock(entry.mutex);
  if (!anew && !entry.maps.empty() && entry.key == key) {
    for (const auto& map : entry.maps) context.progress.advance(tile_count(*map));
    return {entry.maps, 0};
  }
  entry.maps.clear();
  DepthMaps maps;
  for (const light::ShadowView& view : key.views) {
    auto lease = outworn_.take();
    *lease = draw_depth_map(context, view, key.faces, key.keeps_triangles, std::move(*lease));
    maps.push_back(std::move(lease));
    if (context.progress.is_cancelled()) return {};
  }
  outworn_.clear();
  entry.key = key;
  entry.maps = std::move(maps);
  return {entry.maps, static_cast<int>(entry.maps.size())};
}

}  // namespace laterna::render
