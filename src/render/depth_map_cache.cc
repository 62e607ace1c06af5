#include "render/depth_map_cache.h"

#include <algorithm>

#include "base/stopwatch.h"
#include "render/depth_map_painter.h"
#include "shadow/shadow_map.h"

namespace laterna::render {
namespace {

bool same_warp(const light::ShadowView& a, const light::ShadowView& b) {
  if (!a.warp || !b.warp) return !a.warp && !b.warp;
  return a.warp->warped_from_world == b.warp->warped_from_world;
}

bool same_view(const light::ShadowView& a, const light::ShadowView& b) {
  const Projection& p = a.view.projection;
  const Projection& q = b.view.projection;
  return a.width == b.width && a.height == b.height && a.view.pose.position_ws == b.view.pose.position_ws &&
         a.view.pose.world_from_view_rotation == b.view.pose.world_from_view_rotation &&
         p.is_orthographic == q.is_orthographic && p.left == q.left && p.right == q.right &&
         p.bottom == q.bottom && p.top == q.top && p.near == q.near && p.far == q.far && same_warp(a, b);
}

}  // namespace

bool DepthMapKey::has_same_casters(const DepthMapKey& other) const {
  return faces == other.faces && keeps_triangles == other.keeps_triangles &&
         casters_revision == other.casters_revision;
}

bool DepthMapKey::operator==(const DepthMapKey& other) const {
  return has_same_casters(other) &&
         std::equal(views.begin(), views.end(), other.views.begin(), other.views.end(), same_view);
}

shadow::DepthMap make_depth_map(const DrawContext& context, const light::ShadowView& shadow_view,
                                CasterFaces faces, bool keeps_triangles, shadow::DepthMap outworn) {
  shadow::DepthMap map(raster::RasterView(shadow_view.view, shadow_view.width, shadow_view.height),
                       keeps_triangles, std::move(outworn));
  auto painter = std::make_unique<DepthMapPainter>(context.frame, context.bins, context.bins_owner,
                                                   context.instruction_set, faces, shadow_view.warp);
  context.times += painter->prepare(map.view(), context.pool);
  map.set_painter(std::move(painter));
  return map;
}

void draw_tiles(shadow::DepthMap& map, const TaskPool& pool, StageTimes& times,
                const std::function<bool()>& asks_to_stop) {
  std::vector<double> raster_ms(static_cast<std::size_t>(pool.threads()));
  pool.for_each(map.tile_count(), [&](std::size_t i, int worker) {
    if (asks_to_stop && asks_to_stop()) return;
    Stopwatch watch;
    watch.start();
    map.require(static_cast<int>(i) % map.tiles_x(), static_cast<int>(i) / map.tiles_x());
    raster_ms[static_cast<std::size_t>(worker)] += watch.lap_ms();
  });
  map.rest();
  for (const double ms : raster_ms) times[Stage::raster] += ms;
}

shadow::DepthMap draw_depth_map(const DrawContext& context, const light::ShadowView& shadow_view,
                                CasterFaces faces, bool keeps_triangles, shadow::DepthMap outworn) {
  shadow::DepthMap map = make_depth_map(context, shadow_view, faces, keeps_triangles, std::move(outworn));
  draw_tiles(map, context.pool, context.times, nullptr);
  return map;
}

DepthMapCache::Found DepthMapCache::find(std::size_t light, const DepthMapKey& key,
                                         const DrawContext& context, bool anew, std::size_t& working_bytes,
                                         const std::function<bool()>& asks_to_stop) {
  std::unique_lock list_lock(mutex_);
  Entry& entry = entries_[light];  // stays where it is
  list_lock.unlock();
  const std::lock_guard lock(entry.mutex);
  const auto settle = [&](shadow::DepthMap& map) {
    const std::size_t bytes = map.working_bytes();
    if (working_bytes + bytes <= kMaxWorkingBytes) {
      working_bytes += bytes;
    } else {
      draw_tiles(map, context.pool, context.times, asks_to_stop);
    }
  };
  if (!anew && !entry.maps.empty() && entry.key == key) {
    for (const auto& map : entry.maps) settle(*map);
    return {entry.maps, 0};
  }
  // Of cascades, those that the camera has not moved stay.
  const bool is_same_otherwise = !anew && entry.key.has_same_casters(key);
  DepthMaps kept(key.views.size());
  for (std::size_t i = 0; is_same_otherwise && i < kept.size(); ++i) {
    for (std::size_t j = 0; j < entry.maps.size() && kept[i] == nullptr; ++j) {
      if (same_view(key.views[i], entry.key.views[j])) kept[i] = entry.maps[j];
    }
  }
  entry.maps.clear();
  DepthMaps maps;
  int made = 0;
  for (std::size_t i = 0; i < key.views.size(); ++i) {
    if (kept[i] != nullptr) {
      settle(*kept[i]);
      maps.push_back(std::move(kept[i]));
      continue;
    }
    const light::ShadowView& view = key.views[i];
    ++made;
    auto lease = outworn_.take();
    DrawContext own = context;
    own.bins_owner = 1 + shadow::kMostMaps * light + maps.size();  // the camera's is 0
    *lease = make_depth_map(own, view, key.faces, key.keeps_triangles, std::move(*lease));
    settle(*lease);
    maps.push_back(std::move(lease));
  }
  outworn_.clear();
  entry.key = key;
  entry.maps = std::move(maps);
  return {entry.maps, made};
}

void DepthMapCache::rest() {
  const std::lock_guard list_lock(mutex_);
  for (auto& [light, entry] : entries_) {
    const std::lock_guard lock(entry.mutex);
    for (const auto& map : entry.maps) map->rest();
  }
  outworn_.clear();
}

}  // namespace laterna::render
