#include "render/depth_map_cache.h"

#include <algorithm>
#include <utility>

#include "base/stopwatch.h"
#include "render/depth_map_painter.h"
#include "render/tiles_in_view.h"
#include "shadow/shadow_map.h"

namespace laterna::render {
namespace {

bool same_warp(const light::ShadowView& a, const light::ShadowView& b) {
  if (!a.warp || !b.warp) return !a.warp && !b.warp;
  return a.warp->warped_from_world == b.warp->warped_from_world;
}

// All but the near plane.
bool same_picture(const light::ShadowView& a, const light::ShadowView& b) {
  const Projection& p = a.view.projection;
  const Projection& q = b.view.projection;
  return a.width == b.width && a.height == b.height && a.view.pose.position_ws == b.view.pose.position_ws &&
         a.view.pose.world_from_view_rotation == b.view.pose.world_from_view_rotation &&
         p.is_orthographic == q.is_orthographic && p.left == q.left && p.right == q.right &&
         p.bottom == q.bottom && p.top == q.top && p.far == q.far && same_warp(a, b);
}

bool has_near_of(const light::ShadowView& a, const light::ShadowView& b) {
  return a.view.projection.near == b.view.projection.near;
}

raster::RasterView raster_view(const light::ShadowView& shadow) {
  return {shadow.view, shadow.width, shadow.height};
}

}  // namespace

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
  shadow::DepthMap map(raster_view(shadow_view), keeps_triangles, std::move(outworn));
  const DepthMapPainter::Source source = {context.frame,           context.bins, context.bins_owner,
                                          context.instruction_set, faces,        nullptr};
  auto painter = std::make_unique<DepthMapPainter>(source, shadow_view.warp, false);
  context.times += painter->prepare(map.view(), context.pool);
  map.set_painter(std::move(painter));
  draw_tiles(map, context.pool, context.times, nullptr);
  return map;
}

DepthMapCache::KeptMap DepthMapCache::make(const light::ShadowView& view, const DepthMapKey& key,
                                           const DrawContext& context) {
  auto lease = outworn_.take();
  *lease = shadow::DepthMap(raster_view(view), key.keeps_triangles, std::move(*lease));
  const DepthMapPainter::Source source = {context.frame,           context.bins, context.bins_owner,
                                          context.instruction_set, key.faces,    &work_};
  auto painter = std::make_unique<DepthMapPainter>(source, view.warp, casters_.has_movers());
  context.times += painter->prepare(lease->view(), context.pool);
  DepthMapPainter* const is_painted_by = painter.get();
  lease->set_painter(std::move(painter));
  return {view, std::move(lease), is_painted_by, casters_.revision()};
}

// The near plane of a lamp stands before the nearest caster. Where that moves and nothing comes near the plane, the map stays
// what it is.
std::vector<DepthMapCache::KeptMap>::iterator DepthMapCache::find_view(std::vector<KeptMap>& maps,
                                                                       const light::ShadowView& view,
                                                                       const frame::Frame& frame) {
  return std::ranges::find_if(maps, [&](KeptMap& kept) {
    if (kept.map == nullptr || !same_picture(kept.view, view)) return false;
    if (has_near_of(kept.view, view)) return true;
    if (view.warp || view.view.projection.is_orthographic) return false;
    const raster::RasterView moved = raster_view(view);
    if (!is_clear_between(kept.map->view(), moved, frame)) return false;
    kept.view = view;
    kept.map->set_view(moved);
    return true;
  });
}

bool DepthMapCache::update(KeptMap& kept, Found& found) const {
  if (kept.casters_revision != casters_.revision()) {
    const auto changes = casters_.since(kept.casters_revision);
    // What a warp leaves out depends on casters.
    if (!changes || (kept.view.warp && !changes->empty())) return false;
    kept.casters_revision = casters_.revision();
    if (kept.painter->update(*kept.map, *changes)) ++found.updated;
  }
  found.tiles_kept += kept.map->tiles_drawn();
  return true;
}

DepthMapCache::Found DepthMapCache::find(const DepthMapOwner& owner, const DepthMapKey& key,
                                         const DrawContext& context, bool anew, std::size_t& working_bytes,
                                         const std::function<bool()>& asks_to_stop) {
  std::unique_lock list_lock(mutex_);
  Entry& entry = entries_[owner];  // stays where it is
  entry.used = ++uses_;
  list_lock.unlock();
  const std::lock_guard lock(entry.mutex);
  // Where this ends with an exception, nothing is kept.
  std::vector<KeptMap> before = std::exchange(entry.maps, {});
  const bool may_stay = !anew && entry.faces == key.faces && entry.keeps_triangles == key.keeps_triangles;
  Found found;
  // Of cascades, those that the camera has not moved stay.
  std::vector<KeptMap> maps(key.views.size());
  for (std::size_t i = 0; may_stay && i < maps.size(); ++i) {
    const auto kept = find_view(before, key.views[i], context.frame);
    if (kept == before.end()) continue;
    KeptMap taken = std::exchange(*kept, {});
    if (update(taken, found)) maps[i] = std::move(taken);
  }
  // Sorted casters that nobody else draws from go back to their owners' places first.
  for (const KeptMap& outworn : before) {
    if (outworn.map != nullptr && outworn.map.use_count() == 1) outworn.map->rest();
  }
  before.clear();
  entry.faces = key.faces;
  entry.keeps_triangles = key.keeps_triangles;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (maps[i].map == nullptr) {
      ++found.made;
      DrawContext own = context;
      own.bins_owner = 1 + shadow::kMostMaps * owner.light + i;  // the camera's is 0
      maps[i] = make(key.views[i], key, own);
    }
    shadow::DepthMap& map = *maps[i].map;
    if (const std::size_t bytes = map.working_bytes(); working_bytes + bytes <= kMaxWorkingBytes) {
      working_bytes += bytes;
    } else {
      draw_tiles(map, context.pool, context.times, asks_to_stop);
    }
    found.maps.push_back(maps[i].map);
  }
  outworn_.clear();
  entry.maps = std::move(maps);
  return found;
}

// Maps that a picture uses are not freed: their owners hold them by more than one pointer.
void DepthMapCache::make_room(std::size_t most_bytes) {
  const std::lock_guard list_lock(mutex_);
  struct Idle {
    std::uint64_t used;
    std::size_t bytes;
    Entry* entry;
    std::unique_lock<std::mutex> lock;
  };
  std::vector<Idle> idle;
  std::size_t bytes = 0;
  for (auto& [owner, entry] : entries_) {
    std::unique_lock lock(entry.mutex, std::try_to_lock);
    if (!lock) continue;
    const bool is_used =
        std::ranges::any_of(entry.maps, [](const KeptMap& kept) { return kept.map.use_count() > 1; });
    std::size_t own = 0;
    for (const KeptMap& kept : entry.maps) own += is_used ? kept.map->memory_bytes() : kept.bytes();
    bytes += own;
    if (!is_used && own > 0) idle.push_back({entry.used, own, &entry, std::move(lock)});
  }
  std::ranges::sort(idle, {}, &Idle::used);
  for (Idle& oldest : idle) {
    if (bytes <= most_bytes) break;
    bytes -= oldest.bytes;
    oldest.entry->maps.clear();
  }
  if (!idle.empty()) outworn_.clear();
}

// Lists would take memory, of which there may be none left.
void DepthMapCache::rest(std::size_t most_bytes) {
  const std::lock_guard list_lock(mutex_);
  std::size_t bytes = 0;
  for (auto& [owner, entry] : entries_) {
    for (const KeptMap& kept : entry.maps) {
      if (kept.map->is_complete()) kept.map->rest();
      bytes += kept.bytes();
    }
  }
  // What is sorted is made again sooner than maps are.
  for (auto& [owner, entry] : entries_) {
    for (const KeptMap& kept : entry.maps) {
      if (bytes <= most_bytes) break;
      bytes -= kept.bytes();
      kept.map->rest();
      bytes += kept.bytes();
    }
  }
  while (bytes > most_bytes) {
    Entry* longest_unused = nullptr;
    for (auto& [owner, entry] : entries_) {
      const bool is_older = longest_unused == nullptr || entry.used < longest_unused->used;
      if (!entry.maps.empty() && is_older) longest_unused = &entry;
    }
    for (const KeptMap& kept : longest_unused->maps) bytes -= kept.bytes();
    longest_unused->maps.clear();
  }
  std::erase_if(entries_, [](const auto& owned) { return owned.second.maps.empty(); });
  outworn_.clear();
  kept_bytes_ = bytes;
}

}  // namespace laterna::render
