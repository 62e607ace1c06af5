// Batches of samples filled in from the blocks of a tile, bounded, and written back, a group at a time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shade/sample_batch.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <limits>

#include "base/vectors-inl.h"
#include "shade/light_reach.h"
#include "shade/sample_batch.h"
#include "shade/scatter.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shade::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using shadow::kGroupSize;
using shadow::SurfaceSamples;

// Lowest and highest of the first `groups` groups.
struct Range {
  float low, high;
};
HWY_INLINE Range FindRange(const float* values, std::size_t groups) {
  const FloatTag d;
  auto low = Splat(std::numeric_limits<float>::max()), high = Splat(std::numeric_limits<float>::lowest());
  for (std::size_t i = 0; i < groups * kGroupSize; i += kLanes) {
    const auto value = hn::Load(d, values + i);
    low = hn::Min(low, value);
    high = hn::Max(high, value);
  }
  return {hn::GetLane(hn::MinOfLanes(d, low)), hn::GetLane(hn::MaxOfLanes(d, high))};
}

frame::Bounds find_bounds(const SurfaceSamples& samples) {
  const float* axes[3] = {samples.x_ws.data(), samples.y_ws.data(), samples.z_ws.data()};
  frame::Bounds bounds;
  bounds.is_empty = samples.group_count == 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Range range = FindRange(axes[axis], samples.group_count);
    bounds.low[axis] = range.low;
    bounds.high[axis] = range.high;
  }
  return bounds;
}

void fill_from_blocks(const TileOrigin& origin, std::span<const SurfaceGroups::Block> blocks,
                      const float* depth, const TriangleId* ids, SurfaceSamples& s) {
  const FloatTag d;
  const IntTag di;
  const UintTag du;
  s.group_count = blocks.size();
  for (std::size_t group = 0; group < blocks.size(); ++group) {
    const auto [block, mask] = blocks[group];
    s.active[group] = mask;
    const std::size_t from = block * kGroupSize, to = group * kGroupSize;
    const auto x = Splat(origin.x + static_cast<float>(block % raster::kBlocksPerSide * 4)),
               y = Splat(origin.y + static_cast<float>(block / raster::kBlocksPerSide * 4));
    // Samples that do not count become copies of one that does.
    const auto model = static_cast<std::size_t>(__builtin_ctz(mask));
    const auto model_q = Splat(depth[from + model]);
    const auto model_id = hn::Set(du, ids[from + model]);
    for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
      const auto counts = MaskFromBits(std::uint32_t{mask} >> k & ((1U << kLanes) - 1));
      const auto place = hn::Iota(di, static_cast<std::int32_t>(k));
      const auto copied =
          hn::IfThenElse(hn::RebindMask(di, counts), place, SplatInt(static_cast<std::int32_t>(model)));
      hn::Store(x + hn::ConvertTo(d, hn::And(copied, SplatInt(3))), d, s.x.data() + to + k);
      hn::Store(y + hn::ConvertTo(d, hn::ShiftRight<2>(copied)), d, s.y.data() + to + k);
      hn::Store(hn::IfThenElse(counts, hn::LoadU(d, depth + from + k), model_q), d, s.q.data() + to + k);
      hn::Store(hn::IfThenElse(hn::RebindMask(du, counts), hn::LoadU(du, ids + from + k), model_id), du,
                s.id.data() + to + k);
      hn::Store(hn::BitCast(du, place) + hn::Set(du, static_cast<std::uint32_t>(from)), du,
                s.pixel.data() + to + k);
    }
  }
  s.position_error = position_error(origin, FindRange(s.q.data(), s.group_count).low);
}

// Most groups lie in a row in the target, in the order of their lanes.
void scatter_radiance(const SurfaceSamples& samples, const Radiance& radiance, const ColorTarget& target) {
  const FloatTag d;
  const UintTag du;
  const struct {
    const float* values;
    float* target;
  } channels[3] = {
      {radiance.r.data(), target.r}, {radiance.g.data(), target.g}, {radiance.b.data(), target.b}};
  for (std::size_t first = 0; first < samples.group_count * kGroupSize; first += kLanes) {
    const std::uint32_t bits =
        std::uint32_t{samples.active[first / kGroupSize]} >> first % kGroupSize & ((1U << kLanes) - 1);
    if (bits == 0) continue;
    const std::uint32_t* pixel = samples.pixel.data() + first;
    const auto in_a_row = hn::Load(du, pixel) == hn::Iota(du, *pixel);
    if ((BitsOf(hn::RebindMask(FloatTag(), in_a_row)) & bits) == bits) {
      for (const auto& channel : channels)
        hn::BlendedStore(hn::Load(d, channel.values + first), MaskFromBits(bits), d, channel.target + *pixel);
      continue;
    }
    for (std::uint32_t left = bits; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(__builtin_ctz(left));
      for (const auto& channel : channels) channel.target[pixel[i]] = channel.values[first + i];
    }
  }
}

}  // namespace laterna::shade::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shade {
LATERNA_KERNEL_TABLE(find_bounds)
LATERNA_KERNEL_TABLE(fill_from_blocks)
LATERNA_KERNEL_TABLE(scatter_radiance)
}  // namespace laterna::shade
#endif
