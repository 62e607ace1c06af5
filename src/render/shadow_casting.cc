#include "render/shadow_casting.h"

#include <algorithm>

#include "base/stopwatch.h"
#include "render/silhouette_painter.h"
#include "shadow/exact_shadow.h"
#include "shadow/ground_shadow.h"
#include "shadow/paraboloid_shadow.h"
#include "shadow/ray_traced.h"
#include "shadow/relief_shadow.h"
#include "shadow/shadow_map.h"
#include "shadow/shadow_volume.h"
#include "shadow/silhouette_shadow.h"
#include "shadow/soft_shadow_map.h"
#include "shadow/variance_shadow_map.h"

namespace laterna::render {

std::unique_ptr<shadow::ShadowTechnique> ShadowCasting::make(const light::PlannedLight& planned,
                                                             std::size_t index) {
  std::unique_ptr<shadow::ShadowTechnique> technique = make_for_flat(planned, index);
  if (technique == nullptr || context_.frame.relief_charts.empty()) return technique;
  return std::make_unique<shadow::ShadowOnRelief>(std::move(technique), planned, context_.frame,
                                                  context_.camera, context_.instruction_set);
}

// Blended casters tint whatever technique finds the shadows of the others.
std::unique_ptr<shadow::ShadowTechnique> ShadowCasting::make_for_flat(const light::PlannedLight& planned,
                                                                      std::size_t index) {
  std::unique_ptr<shadow::ShadowTechnique> opaque = make_opaque(planned, index);
  if (opaque == nullptr || !context_.frame.has_blended_casters) return opaque;
  return std::make_unique<shadow::ShadowThroughPanes>(std::move(opaque), make_panes(planned), context_.frame,
                                                      context_.instruction_set);
}

std::unique_ptr<shadow::PaneFinder> ShadowCasting::make_panes(const light::PlannedLight& planned) {
  if (planned.technique == ShadowTechnique::raytraced) {
    return std::make_unique<shadow::RayTracedPanes>(planned, context_.frame, context_.casters.ray_scene());
  }
  return std::make_unique<shadow::ExactPanes>(planned, context_.frame, context_.casters.pane_tree(),
                                              context_.instruction_set);
}

std::unique_ptr<shadow::ShadowTechnique> ShadowCasting::make_opaque(const light::PlannedLight& planned,
                                                                    std::size_t index) {
  switch (planned.technique) {
    case ShadowTechnique::ground:
      return std::make_unique<shadow::GroundShadow>(planned, context_.frame);
    case ShadowTechnique::silhouette:
      return make_silhouettes(planned);
    case ShadowTechnique::map:
    case ShadowTechnique::cascades:
      return make_map(planned, index);
    case ShadowTechnique::pcss:
      return make_soft_map(planned, index);
    case ShadowTechnique::variance:
      return make_variance_map(planned, index);
    case ShadowTechnique::volume:
      return make_volume(planned);
    case ShadowTechnique::exact:
      return make_exact(planned);
    case ShadowTechnique::raytraced:
      return std::make_unique<shadow::RayTracedShadow>(planned, context_.casters.ray_scene());
    default:
      return nullptr;
  }
}

namespace {

// Whether where the camera stands decides on the light's maps: light::make_light_plan().
bool follows_camera(const light::PlannedLight& planned) {
  return planned.technique == ShadowTechnique::cascades || planned.settings.warp != ShadowWarp::none;
}

}  // namespace

DepthMaps ShadowCasting::find_maps(const light::PlannedLight& planned, std::size_t index,
                                   bool keeps_triangles) {
  ProgressReport& progress = context_.progress;
  const DepthMapKey key = {planned.shadow_views, planned.settings.caster_faces, keeps_triangles};
  const DepthMapOwner owner = {index, follows_camera(planned) ? context_.reflections : std::vector<int>()};
  const DepthMapCache::Found found = context_.maps.find(
      owner, key,
      {context_.frame, context_.pool, context_.bins, context_.instruction_set,
       context_.statistics.map_stages},
      !context_.settings.keep_shadow_maps, working_bytes_, [&progress] { return progress.asks_to_stop(); });
  const int redone = found.made + found.updated;
  context_.statistics.maps_drawn += redone;
  context_.statistics.maps_kept += static_cast<int>(found.maps.size()) - redone;
  context_.statistics.map_reuse.maps_updated += found.updated;
  context_.statistics.map_reuse.tiles_kept += found.tiles_kept;
  return found.maps;
}

const frame::TriangleNeighbours* ShadowCasting::find_neighbours(const light::PlannedLight& planned) const {
  return shadow::filter_of(planned.settings) == ShadowFilter::refined ? context_.casters.triangle_neighbours()
                                                                      : nullptr;
}

bool ShadowCasting::complete(const DepthMaps& maps) {
  ProgressReport& progress = context_.progress;
  const auto asks_to_stop = [&progress] { return progress.asks_to_stop(); };
  return std::ranges::all_of(maps, [&](const auto& map) {
    if (!map->is_complete()) draw_tiles(*map, context_.pool, context_.statistics.map_stages, asks_to_stop);
    return map->is_complete();
  });
}

std::unique_ptr<shadow::ShadowTechnique> ShadowCasting::make_map(const light::PlannedLight& planned,
                                                                 std::size_t index) {
  if (planned.settings.layout == ShadowLayout::dual_paraboloid) return make_paraboloids(planned, index);
  ProgressReport& progress = context_.progress;
  const DepthMaps maps = find_maps(planned, index, planned.settings.filter == ShadowFilter::refined);
  report_memory(planned, maps, 0);
  return std::make_unique<shadow::ShadowMap>(
      planned, maps, context_.frame, find_neighbours(planned), context_.camera.homogeneous_ray(),
      context_.settings.samples, context_.instruction_set, [&progress] { return progress.asks_to_stop(); });
}

std::unique_ptr<shadow::ShadowTechnique> ShadowCasting::make_paraboloids(const light::PlannedLight& planned,
                                                                         std::size_t index) {
  ProgressReport& progress = context_.progress;
  Stopwatch watch;
  watch.start();
  const ParaboloidMapCache::Found found = context_.paraboloids.find(
      index, shadow::ParaboloidShadow::pair_of(planned), planned.settings.caster_faces, context_.frame,
      context_.pool, !context_.settings.keep_shadow_maps, [&progress] { return progress.asks_to_stop(); });
  context_.statistics.map_stages[Stage::raster] += watch.lap_ms();
  (found.is_made || found.is_updated ? context_.statistics.maps_drawn : context_.statistics.maps_kept) += 2;
  context_.statistics.map_reuse.maps_updated += found.is_updated ? 2 : 0;
  auto technique = std::make_unique<shadow::ParaboloidShadow>(
      planned, found.map, context_.frame, find_neighbours(planned), context_.settings.samples);
  report_memory(planned, 2, technique->memory_bytes());
  return technique;
}

// The trees are all lights': the first is said to hold them.
std::unique_ptr<shadow::ShadowTechnique> ShadowCasting::make_exact(const light::PlannedLight& planned) {
  std::vector<std::shared_ptr<const shadow::CasterTree>> trees = context_.casters.caster_trees();
  std::size_t bytes = 0;
  for (const auto& tree : trees) bytes += tree->memory_bytes();
  report_memory(planned, 0, has_reported_tree_ ? 0 : bytes);
  has_reported_tree_ = true;
  return std::make_unique<shadow::ExactShadow>(planned, context_.frame, std::move(trees),
                                               context_.instruction_set);
}

std::unique_ptr<shadow::ShadowTechnique> ShadowCasting::make_volume(const light::PlannedLight& planned) {
  auto volume = std::make_unique<shadow::ShadowVolume>(planned, context_.frame, context_.camera,
                                                       context_.pool, context_.instruction_set);
  report_memory(planned, 0, volume->memory_bytes());
  return volume;
}

std::unique_ptr<shadow::ShadowTechnique> ShadowCasting::make_silhouettes(
    const light::PlannedLight& planned) const {
  auto technique = std::make_unique<shadow::SilhouetteShadow>(
      planned, context_.frame, context_.camera.homogeneous_ray(),
      std::make_unique<SilhouettePainter>(context_.frame, context_.bins, context_.instruction_set,
                                          planned.settings.caster_faces));
  // Otherwise they are drawn as samples ask for them: what the camera cannot see asks for none (row 47).
  if (!planned.settings.culls_occluders) {
    context_.pool.for_each(technique->silhouette_count(), [&](std::size_t i, int) {
      if (!context_.progress.asks_to_stop()) technique->draw(i);
    });
  }
  return technique;
}

void ShadowCasting::report_memory(const light::PlannedLight& planned, int maps, std::size_t bytes) {
  context_.statistics.shadow_memory.push_back({planned.placed->light->name, maps, bytes});
}

std::unique_ptr<shadow::ShadowTechnique> ShadowCasting::make_soft_map(const light::PlannedLight& planned,
                                                                      std::size_t index) {
  if (!light::has_samples(*planned.placed->light)) return make_map(planned, index);
  const DepthMaps maps = find_maps(planned, index, planned.settings.filter == ShadowFilter::refined);
  if (!complete(maps)) return nullptr;
  auto technique = std::make_unique<shadow::SoftShadowMap>(
      planned, maps, context_.frame, find_neighbours(planned), context_.camera.homogeneous_ray(),
      context_.settings.samples, context_.instruction_set, context_.pool);
  report_memory(planned, maps, technique->memory_bytes());
  return technique;
}

std::unique_ptr<shadow::ShadowTechnique> ShadowCasting::make_variance_map(const light::PlannedLight& planned,
                                                                          std::size_t index) {
  const DepthMaps maps = find_maps(planned, index, false);
  if (!complete(maps)) return nullptr;
  auto technique = std::make_unique<shadow::VarianceShadowMap>(planned, maps, context_.frame,
                                                               context_.camera.homogeneous_ray(),
                                                               context_.instruction_set, context_.pool);
  report_memory(planned, maps, technique->memory_bytes());
  return technique;
}

void ShadowCasting::report_memory(const light::PlannedLight& planned, const DepthMaps& maps,
                                  std::size_t more_bytes) {
  std::size_t bytes = more_bytes;
  for (const auto& map : maps) bytes += map->memory_bytes();
  report_memory(planned, static_cast<int>(maps.size()), bytes);
}

void report_drawn(const light::PlannedLight& planned, const shadow::ShadowTechnique* technique,
                  RenderStatistics& statistics) {
  if (technique == nullptr || planned.technique != ShadowTechnique::silhouette) return;
  const shadow::DrawnForShadows drawn = technique->drawn();
  const std::string& light = planned.placed->light->name;
  statistics.silhouettes.push_back(
      {light, drawn.objects, drawn.pairs, drawn.silhouettes, drawn.silhouettes_drawn});
  statistics.shadow_memory.push_back({light, static_cast<int>(drawn.silhouettes_drawn), drawn.bytes});
}

}  // namespace laterna::render
