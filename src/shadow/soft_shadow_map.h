// Soft shadows of lights with a size, from one map drawn from the light's middle: Fernando, Percentage-closer soft shadows,
// 2005. Look for what stands between a sample and the light, take its mean depth, and filter as widely as a caster of that
// depth blurs the light.
#pragma once

#include <memory>
#include <vector>

#include "base/task_pool.h"
#include "light/light_plan.h"
#include "shadow/nearest_pyramid.h"
#include "shadow/shadow_map.h"

namespace laterna::shadow {

/// Where taps lie: points of a unit disc, or of the square from −1 to 1.
struct TapPattern {
  static constexpr int kSearchTaps = 40, kFilterTaps = 64, kRimTaps = 16;
  /// Crowded toward the middle, so that what stands near a sample is found as well as what stands near the light; the
  /// last kRimTaps lie about the rim, where penumbrae begin.
  float search_x[kSearchTaps], search_y[kSearchTaps];
  float filter_x[kFilterTaps], filter_y[kFilterTaps];
  /// How large the shape must be to reach the tap: 1 at its rim.
  float search_size[kSearchTaps], filter_size[kFilterTaps];
};
const TapPattern& disc_pattern();
const TapPattern& square_pattern();

/// One map of a light with a size. What the kernel reads.
struct SoftDepthMap {
  const NearestPyramid* nearest = nullptr;
  // Rows over (position_ws − eye): texels, homogeneous in a perspective view, and its divisor.
  float x_row_ws[3] = {0, 0, 0}, y_row_ws[3] = {0, 0, 0}, w_row_ws[3] = {0, 0, 0};
  float origin_x = 0, origin_y = 0;
};

enum class LightShape : std::uint8_t {
  ball,
  plane
};  // plane: a rectangle, a projector's lens, or the disc of a light in the sky

/// What one light's soft look-ups need.
struct SoftShadowTest {
  ShadowMapTest hard;
  std::vector<SoftDepthMap> maps;  // as many as `hard` has
  const TapPattern* pattern = nullptr;
  LightShape shape = LightShape::ball;
  float radius = 0;                                          // ball
  float half_x_ws[3] = {0, 0, 0}, half_y_ws[3] = {0, 0, 0};  // plane: from the light's middle to its sides
};

class SoftShadowMap final : public ShadowTechnique {
 public:
  /// All tiles of the maps are drawn. The light has a size, or a lens that is open. `nearest`: of these maps.
  SoftShadowMap(const light::PlannedLight& planned, std::span<const std::shared_ptr<DepthMap>> maps,
                std::shared_ptr<const NearestPyramids> nearest, const frame::Frame& frame,
                const frame::TriangleNeighbours* neighbours, const raster::RasterView::Ray& ray,
                int samples_per_pixel, InstructionSet set);
  double find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                      Arrival& arrival) const override;
  /// Beside the maps themselves.
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  std::vector<std::shared_ptr<DepthMap>> maps_;
  std::shared_ptr<const NearestPyramids> nearest_;
  SoftShadowTest test_;
};

using LookUpSoftShadowMap = void (*)(const SoftShadowTest& test, const SurfaceSamples& samples,
                                     std::span<const std::uint16_t> wanted, float* alpha);
LookUpSoftShadowMap look_up_soft_shadow_map_for(InstructionSet set);

}  // namespace laterna::shadow
