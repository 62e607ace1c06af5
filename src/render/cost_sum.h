// What several pictures cost together.
#pragma once

#include "laterna/render.h"

namespace laterna::render {

/// Adds times, triangles and maps; memory is the last picture's, which is drawn when the others' has been given back.
inline void add_costs(RenderStatistics& sum, const RenderStatistics& one) {
  sum.plan_ms += one.plan_ms;
  sum.shadow_ms += one.shadow_ms;
  sum.bin_ms += one.bin_ms;
  sum.shade_ms += one.shade_ms;
  sum.map_stages += one.map_stages;
  sum.picture_stages += one.picture_stages;
  sum.triangles += one.triangles;
  sum.triangles_drawn += one.triangles_drawn;
  sum.maps_drawn += one.maps_drawn;
  sum.maps_kept += one.maps_kept;
  sum.map_reuse.maps_updated += one.map_reuse.maps_updated;
  sum.map_reuse.tiles_kept += one.map_reuse.tiles_kept;
  sum.map_reuse.tiles_updated += one.map_reuse.tiles_updated;
  sum.map_reuse.tiles_drawn += one.map_reuse.tiles_drawn;
  sum.map_reuse.triangles += one.map_reuse.triangles;
  sum.map_reuse.moving_triangles += one.map_reuse.moving_triangles;
  sum.mirror_pictures += one.mirror_pictures;
  sum.shadow_memory = one.shadow_memory;
  sum.silhouettes = one.silhouettes;
}

}  // namespace laterna::render
