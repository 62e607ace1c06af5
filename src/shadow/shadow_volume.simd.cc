// Counts what lines of sight cross of shadow volumes.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shadow/shadow_volume.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "shadow/shadow_volume.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DoubleTag = hn::CappedTag<double, kGroupSize>;
using DoubleVector = hn::Vec<DoubleTag>;
using DoubleMask = hn::Mask<DoubleTag>;
constexpr std::size_t kDoubleLanes = hn::MaxLanes(DoubleTag());

HWY_INLINE std::uint32_t BitsOfDoubles(DoubleMask mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(DoubleTag(), mask, bytes);
  return bytes[0] | std::uint32_t{bytes[1]} << 8U;
}

HWY_INLINE DoubleMask DoubleMaskFromBits(std::uint32_t bits) {
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits & 255U)};
  return hn::LoadMaskBits(DoubleTag(), bytes);
}

struct Crossings {
  DoubleMask certain, doubtful;
};

// Where the lines of sight of samples i, i + 1, … pass all three edges on the inner side.
HWY_INLINE Crossings CrossingsOf(const VolumeFacet& facet, const VolumeSamples& s, std::size_t i) {
  const DoubleTag d;
  const auto x = hn::Load(d, s.direction_x.data() + i);
  const auto y = hn::Load(d, s.direction_y.data() + i);
  const auto w = hn::Load(d, s.direction_w.data() + i);
  const auto inside = [&](int k) HWY_ATTR {
    const double* edge = facet.edge[k];
    return hn::Set(d, edge[0]) * x + hn::Set(d, edge[1]) * y + hn::Set(d, edge[2]) * w;
  };
  const auto a = inside(0), b = inside(1), c = inside(2);
  const auto doubt_a = hn::Set(d, facet.doubt[0]), doubt_b = hn::Set(d, facet.doubt[1]),
             doubt_c = hn::Set(d, facet.doubt[2]);
  const auto certain = hn::And(a > doubt_a, hn::And(b > doubt_b, c > doubt_c));
  const auto possible = hn::And(a >= hn::Neg(doubt_a), hn::And(b >= hn::Neg(doubt_b), c >= hn::Neg(doubt_c)));
  return {certain, hn::AndNot(certain, possible)};
}

// plane · (p, 1) of samples i, i + 1, …
HWY_INLINE DoubleVector HeightOver(const double* plane, const VolumeSamples& s, std::size_t i) {
  const DoubleTag d;
  return hn::Set(d, plane[0]) * hn::Load(d, s.x_ws.data() + i) +
         hn::Set(d, plane[1]) * hn::Load(d, s.y_ws.data() + i) +
         hn::Set(d, plane[2]) * hn::Load(d, s.z_ws.data() + i) + hn::Set(d, plane[3]);
}

void Postpone(DoubleMask mask, std::uint32_t index, std::size_t first, bool is_prism, VolumeSamples& s) {
  for (std::uint32_t left = BitsOfDoubles(mask); left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(__builtin_ctz(left));
    s.pending.push_back({index, static_cast<std::uint16_t>(first + lane), is_prism});
  }
}

HWY_INLINE DoubleMask Asked(const VolumeSamples& s, std::size_t group, std::size_t k) {
  return DoubleMaskFromBits(std::uint32_t{s.asked[group]} >> k);
}

void CrossFacet(const VolumeFacet& facet, std::uint32_t index, std::size_t group, VolumeSamples& s) {
  const DoubleTag d;
  for (std::size_t k = 0; k < kGroupSize; k += kDoubleLanes) {
    const std::size_t i = group * kGroupSize + k;
    const Crossings crossings = CrossingsOf(facet, s, i);
    if (hn::AllFalse(d, hn::Or(crossings.certain, crossings.doubtful))) continue;
    const auto beyond = hn::And(Asked(s, group, k), HeightOver(facet.plane, s, i) > hn::Zero(d));
    const auto step =
        hn::IfThenElseZero(hn::And(crossings.certain, beyond), hn::Set(d, static_cast<double>(facet.step)));
    hn::Store(hn::Load(d, s.count.data() + i) + step, d, s.count.data() + i);
    Postpone(hn::And(crossings.doubtful, beyond), index, i, false, s);
  }
}

void EnterPrism(const PrismPlanes& prism, std::uint32_t index, std::size_t group, VolumeSamples& s) {
  const DoubleTag d;
  for (std::size_t k = 0; k < kGroupSize; k += kDoubleLanes) {
    const std::size_t i = group * kGroupSize + k;
    auto inside = Asked(s, group, k);
    for (int side = 0; side < 4; ++side) {
      inside = hn::And(inside, HeightOver(prism.plane[side], s, i) >= hn::Set(d, -prism.doubt[side]));
    }
    Postpone(inside, index, i, true, s);
  }
}

void count_crossings(const VolumeBins& bins, int tile, VolumeSamples& samples) {
  const auto for_groups = [&](const VolumeBins::Entry& entry, const auto& work) HWY_ATTR {
    if ((entry.cells & samples.all_cells) == 0) return;
    for (std::size_t group = 0; group < kMaxGroups; ++group) {
      if ((entry.cells & samples.cells[group]) != 0) work(group);
    }
  };
  for (const VolumeBins::Entry& entry : bins.facets_in(tile)) {
    for_groups(entry, [&](std::size_t group)
                          HWY_ATTR { CrossFacet(bins.facet(entry.index), entry.index, group, samples); });
  }
  for (const VolumeBins::Entry& entry : bins.prisms_in(tile)) {
    for_groups(entry, [&](std::size_t group)
                          HWY_ATTR { EnterPrism(bins.prism(entry.index), entry.index, group, samples); });
  }
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shadow {
LATERNA_KERNEL_TABLE(count_crossings)
}  // namespace laterna::shadow
#endif
