// Look-ups into depth maps.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shadow/shadow_map.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "shadow/depth_comparison-inl.h"
#include "shadow/depth_comparison.h"
#include "shadow/map_reader-inl.h"
#include "shadow/refinement-inl.h"
#include "shadow/shadow_map.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

void look_up_shadow_map(const ShadowMapTest& test, const SurfaceSamples& samples,
                        std::span<const std::uint16_t> wanted, float* alpha) {
  RefinementList unsure;
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    if (wanted[group] == 0) continue;
    for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
      const std::size_t i = group * kGroupSize + k;
      const Points points = LoadPoints(samples, i);
      auto result = Splat(test.outside_is_lit ? 1.0F : 0.0F);
      auto is_unsure = Splat(0.0F) > Splat(1.0F);
      ForEachMap(test, points.position_ws, [&](const BoundDepthMap& map, FloatMask here) HWY_ATTR {
        const MapReader reader(test, map, samples.position_error);
        if (test.filter == ShadowFilter::refined) {
          const Quick quick = QuickArrival(reader, points);
          result = hn::IfThenElse(here, quick.alpha, result);
          is_unsure = hn::Or(is_unsure, hn::And(here, quick.unsure));
        } else {
          result = hn::IfThenElse(here, reader.Arrival(reader.Find(points)), result);
        }
      });
      hn::Store(result, FloatTag(), alpha + i);
      unsure.Add(i, is_unsure, static_cast<std::uint32_t>(wanted[group]) >> k);
    }
  }
  unsure.Refine(test, samples, alpha);
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shadow {
LATERNA_KERNEL_TABLE(look_up_shadow_map)

bool is_lit(float stored, float tested, float bias) {
  return HWY_STATIC_DISPATCH(IsLit)(stored, tested, bias);
}
}  // namespace laterna::shadow
#endif
