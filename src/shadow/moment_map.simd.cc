// Moments of depth, and weighted sums of rows of them.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shadow/moment_map.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "shadow/depth_measure-inl.h"
#include "shadow/map_reader-inl.h"
#include "shadow/moment_map.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

void find_moments(const DepthMap& map, const DepthMeasure& measure, ShadowMoments kind, int first_x, int y,
                  std::size_t count, float* moments) {
  const FloatTag d;
  const IntTag di;
  const auto row = RowPart(SplatInt(y), map.tiles_x());
  const auto centre_y = Splat(static_cast<float>(y) + 0.5F);
  const auto last = SplatInt(map.width() - 1);
  for (std::size_t i = 0; i < count; i += kLanes) {
    const auto x = hn::Iota(di, first_x + static_cast<int>(i));
    const auto held = hn::Min(hn::Max(x, SplatInt(0)), last);
    const auto q = hn::GatherIndex(d, map.texels(), ColumnPart(held) + row);
    const auto depth = MeasuredDepth(measure, map.view(), q, hn::ConvertTo(d, held) + Splat(0.5F), centre_y);
    if (kind == ShadowMoments::variance) {
      hn::StoreInterleaved2(depth, depth * depth, d, moments + 2 * i);
    } else {
      const auto positive = PositiveWarp(depth), negative = NegativeWarp(depth);
      hn::StoreInterleaved4(positive, positive * positive, negative, negative * negative, d, moments + 4 * i);
    }
  }
}

void add_weighted(std::span<const float> weights, std::span<const float* const> rows, std::size_t count,
                  float* sum) {
  const FloatTag d;
  for (std::size_t i = 0; i < count; i += kLanes) {
    auto total = Splat(weights[0]) * hn::LoadU(d, rows[0] + i);
    for (std::size_t k = 1; k < weights.size(); ++k) {
      total = total + Splat(weights[k]) * hn::LoadU(d, rows[k] + i);
    }
    hn::StoreU(total, d, sum + i);
  }
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shadow {
LATERNA_KERNEL_TABLE(find_moments)
LATERNA_KERNEL_TABLE(add_weighted)
}  // namespace laterna::shadow
#endif
