#include "shadow/variance_shadow_map.h"

#include <utility>

namespace laterna::shadow {

MomentMaps::MomentMaps(std::span<const std::shared_ptr<DepthMap>> depths, const ShadowSettings& settings,
                       InstructionSet set, const TaskPool& pool)
    : measure(find_depth_measure(depths, settings.depth, pool)) {
  for (const auto& depth : depths)
    maps.emplace_back(*depth, measure, settings.moments, settings.blur, set, pool);
}

VarianceShadowMap::VarianceShadowMap(const light::PlannedLight& planned,
                                     std::span<const std::shared_ptr<DepthMap>> maps,
                                     std::shared_ptr<const MomentMaps> moments, const frame::Frame& frame,
                                     const raster::RasterView::Ray& ray, InstructionSet set)
    : maps_(maps.begin(), maps.end()), moments_(std::move(moments)) {
  const ShadowSettings& settings = planned.settings;
  test_.hard = make_shadow_map_test(planned, maps, frame, nullptr, ray, 1, set);
  test_.measure = moments_->measure;
  test_.maps = moments_->maps;
  test_.kind = settings.moments;
  test_.bleeding_reduction = settings.bleeding_reduction;
}

double VarianceShadowMap::find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                                       Arrival& arrival) const {
  arrival.is_tinted = false;
  look_up_variance_shadow_map_for(test_.hard.instruction_set)(test_, samples, wanted, arrival.alpha.data());
  return 0;
}

std::size_t VarianceShadowMap::memory_bytes() const { return moments_->memory_bytes(); }

std::size_t MomentMaps::memory_bytes() const {
  std::size_t bytes = 0;
  for (const MomentMap& map : maps) bytes += map.memory_bytes();
  return bytes;
}

}  // namespace laterna::shadow
