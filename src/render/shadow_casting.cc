#include "render/shadow_casting.h"

#include "shadow/exact_shadow.h"
#include "shadow/ray_traced.h"
#include "shadow/shadow_map.h"

namespace laterna::render {

// Blended casters tint whatever technique finds the shadows of the others.
std::unique_ptr<shadow::ShadowTechnique> ShadowCasting::make(const light::PlannedLight& planned,
                                                             std::size_t index) {
  std::unique_ptr<shadow::ShadowTechnique> opaque = make_opaque(planned, index);
  if (opaque == nullptr || !context_.frame.has_blended_casters) return opaque;
  return std::make_unique<shadow::ShadowThroughPanes>(std::move(opaque), make_panes(planned), context_.frame,
                                                      context_.instruction_set);
}

std::unique_ptr<shadow::PaneFinder> ShadowCasting::make_panes(const light::PlannedLight& planned) {
  if (planned.technique == ShadowTechnique::raytraced) {
    return std::make_unique<shadow::RayTracedPanes>(planned, context_.ray_scene());
  }
  return std::make_unique<shadow::ExactPanes>(planned, context_.frame,
                                              context_.caster_tree(shadow::CasterTree::Casters::blended),
                                              context_.instruction_set);
}

std::unique_ptr<shadow::ShadowTechnique> ShadowCasting::make_opaque(const light::PlannedLight& planned,
                                                                    std::size_t index) {
  switch (planned.technique) {
    case ShadowTechnique::map:
    case ShadowTechnique::cascades:
      return make_map(planned, index);
    case ShadowTechnique::exact:
      return make_exact(planned);
    case ShadowTechnique::raytraced:
      return std::make_unique<shadow::RayTracedShadow>(planned, context_.ray_scene());
    default:
      return nullptr;
  }
}

std::unique_ptr<shadow::ShadowTechnique> ShadowCasting::make_map(const light::PlannedLight& planned,
                                                                 std::size_t index) {
  ProgressReport& progress = context_.progress;
  const auto asks_to_stop = [&progress] { return progress.asks_to_stop(); };
  const DepthMapKey key = {planned.shadow_views, planned.settings.caster_faces,
                           planned.settings.filter == ShadowFilter::refined, context_.casters_revision};
  const DepthMapCache::Found found =
      context_.maps.find(index, key,
                         {context_.frame, context_.pool, context_.bins, context_.instruction_set,
                          context_.statistics.map_stages},
                         !context_.settings.keep_shadow_maps, working_bytes_, asks_to_stop);
  context_.statistics.maps_drawn += found.made;
  context_.statistics.maps_kept += static_cast<int>(found.maps.size()) - found.made;
  std::size_t bytes = 0;
  for (const auto& map : found.maps) bytes += map->memory_bytes();
  report_memory(planned, static_cast<int>(found.maps.size()), bytes);
  return std::make_unique<shadow::ShadowMap>(planned, found.maps, context_.frame,
                                             context_.camera.homogeneous_ray(), context_.settings.samples,
                                             context_.instruction_set, asks_to_stop);
}

// The tree is all lights': the first is said to hold it.
std::unique_ptr<shadow::ShadowTechnique> ShadowCasting::make_exact(const light::PlannedLight& planned) {
  std::shared_ptr<const shadow::CasterTree> tree = context_.caster_tree(shadow::CasterTree::Casters::opaque);
  report_memory(planned, 0, has_reported_tree_ ? 0 : tree->memory_bytes());
  has_reported_tree_ = true;
  return std::make_unique<shadow::ExactShadow>(planned, context_.frame, std::move(tree),
                                               context_.instruction_set);
}

void ShadowCasting::report_memory(const light::PlannedLight& planned, int maps, std::size_t bytes) {
  context_.statistics.shadow_memory.push_back({planned.placed->light->name, maps, bytes});
}

}  // namespace laterna::render
