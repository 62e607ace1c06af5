#include "shadow/variance_shadow_map.h"

namespace laterna::shadow {

VarianceShadowMap::VarianceShadowMap(const light::PlannedLight& planned,
                                     std::span<const std::shared_ptr<DepthMap>> maps,
                                     const frame::Frame& frame, const raster::RasterView::Ray& ray,
                                     InstructionSet set, const TaskPool& pool)
    : maps_(maps.begin(), maps.end()) {
  const ShadowSettings& settings = planned.settings;
  test_.hard = make_shadow_map_test(planned, maps, frame, nullptr, ray, 1, set);
  test_.measure = find_depth_measure(maps, settings.depth, pool);
  test_.kind = settings.moments;
  test_.bleeding_reduction = settings.bleeding_reduction;
  for (const auto& map : maps) {
    test_.maps.emplace_back(*map, test_.measure, settings.moments, settings.blur, set, pool);
  }
}

double VarianceShadowMap::find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                                       Arrival& arrival) const {
  arrival.is_tinted = false;
  look_up_variance_shadow_map_for(test_.hard.instruction_set)(test_, samples, wanted, arrival.alpha.data());
  return 0;
}

std::size_t VarianceShadowMap::memory_bytes() const {
  std::size_t bytes = 0;
  for (const MomentMap& map : test_.maps) bytes += map.memory_bytes();
  return bytes;
}

}  // namespace laterna::shadow
