// Shadows from filtered moments of depth. Chebyshev's inequality bounds how much of what a filter saw can be as far off as
// the receiver: of depths with mean μ and variance σ², no more than σ² / (σ² + (t − μ)²) lie at t > μ or beyond. That
// bound is taken for the share that arrives. Donnelly and Lauritzen, Variance shadow maps, 2006.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "shadow/moment_map.h"
#include "shadow/shadow_map.h"

namespace laterna::shadow {

/// The moments of one light's maps, all of one measure.
struct MomentMaps {
  /// All tiles of the maps are drawn.
  MomentMaps(std::span<const std::shared_ptr<DepthMap>> depths, const ShadowSettings& settings,
             InstructionSet set, const TaskPool& pool);
  [[nodiscard]] std::size_t memory_bytes() const;

  DepthMeasure measure;
  std::vector<MomentMap> maps;
};

/// What one light's look-ups need.
struct VarianceShadowTest {
  ShadowMapTest hard;
  std::span<const MomentMap> maps;  // as many as `hard` has
  DepthMeasure measure;
  ShadowMoments kind = ShadowMoments::exponential;
  float bleeding_reduction = 0;
};

class VarianceShadowMap final : public ShadowTechnique {
 public:
  /// `moments`: of these maps, for the light's settings.
  VarianceShadowMap(const light::PlannedLight& planned, std::span<const std::shared_ptr<DepthMap>> maps,
                    std::shared_ptr<const MomentMaps> moments, const frame::Frame& frame,
                    const raster::RasterView::Ray& ray, InstructionSet set);
  double find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                      Arrival& arrival) const override;
  /// Beside the maps themselves.
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  std::vector<std::shared_ptr<DepthMap>> maps_;
  std::shared_ptr<const MomentMaps> moments_;
  VarianceShadowTest test_;
};

using LookUpVarianceShadowMap = void (*)(const VarianceShadowTest& test, const SurfaceSamples& samples,
                                         std::span<const std::uint16_t> wanted, float* alpha);
LookUpVarianceShadowMap look_up_variance_shadow_map_for(InstructionSet set);

}  // namespace laterna::shadow
