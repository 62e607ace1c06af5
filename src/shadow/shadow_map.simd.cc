// Look-ups into depth maps.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shadow/shadow_map.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

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
    for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
      // Lanes that nobody asks about may read tiles that are not drawn: numbers that nobody uses.
      const std::uint32_t asked = std::uint32_t{wanted[group]} >> k & ((1U << kLanes) - 1);
      if (asked == 0) continue;
      const std::size_t i = group * kGroupSize + k;
      const Points points = LoadPoints(samples, i);
      auto result = Splat(test.outside_is_lit ? 1.0F : 0.0F);
      auto is_unsure = Splat(0.0F) > Splat(1.0F);
      ForEachMap(test, points, [&](const BoundDepthMap& map, const Share& share) HWY_ATTR {
        const MapReader reader(test, map, samples.position_error);
        if (test.filter == ShadowFilter::refined) {
          const Quick quick = QuickArrival(reader, points);
          result = LayOver(share, quick.alpha, result);
          is_unsure = hn::Or(is_unsure, hn::And(share.here, quick.unsure));
        } else {
          result = LayOver(share, reader.Arrival(reader.Find(points)), result);
        }
      });
      hn::Store(result, FloatTag(), alpha + i);
      unsure.Add(i, is_unsure, asked);
    }
  }
  unsure.Refine(test, samples, alpha);
}

// ---------------------------------------------------------------------------------------------- missing tiles

// A rectangle of texels or tiles, ends included.
struct Span2 {
  int x_first, x_last, y_first, y_last;
};

// Tiles with texels that a filter may read for places (x, y).
class TileFinder {
 public:
  TileFinder(const ShadowMapTest& test, std::size_t index, std::vector<MapTile>& missing)
      : map_(*test.maps[index].map), index_(index), missing_(missing) {
    // Taps of a kernel lie within half of it about the sample, and a texel more.
    const bool has_kernel =
        test.filter == ShadowFilter::percentage_closer || test.filter == ShadowFilter::averaged_depths;
    reach_ = static_cast<float>(has_kernel ? test.kernel : 2) * 0.5F + 1;
  }

  [[nodiscard]] Span2 Around(float x_low, float x_high, float y_low, float y_high) const {
    const auto tile = [](float texel, int count) {
      const auto last = static_cast<float>(count - 1);
      const float held = texel > 0 ? std::min(texel, last) : 0.0F;
      return static_cast<int>(held) >> raster::kTileBits;
    };
    return {tile(x_low - reach_, map_.width()), tile(x_high + reach_, map_.width()),
            tile(y_low - reach_, map_.height()), tile(y_high + reach_, map_.height())};
  }
  [[nodiscard]] bool IsDrawn(const Span2& tiles) const {
    for (int y = tiles.y_first; y <= tiles.y_last; ++y) {
      for (int x = tiles.x_first; x <= tiles.x_last; ++x) {
        if (!map_.is_drawn(x, y)) return false;
      }
    }
    return true;
  }
  void Note(const Span2& tiles) {
    for (int y = tiles.y_first; y <= tiles.y_last; ++y) {
      for (int x = tiles.x_first; x <= tiles.x_last; ++x) {
        if (!map_.is_drawn(x, y)) missing_.push_back({index_, x, y});
      }
    }
  }

 private:
  const DepthMap& map_;
  std::size_t index_;
  std::vector<MapTile>& missing_;
  float reach_;
};

// Calls `use(index of a map, samples as it sees them, which of them ask it)`, vector by vector.
template <class Use>
HWY_INLINE void ForEachReceiver(const ShadowMapTest& test, const SurfaceSamples& samples,
                                std::span<const std::uint16_t> wanted, Use use) {
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
      const std::uint32_t bits = std::uint32_t{wanted[group]} >> k & ((1U << kLanes) - 1);
      if (bits == 0) continue;
      const Points points = LoadPoints(samples, group * kGroupSize + k);
      ForEachMap(test, points, [&](const BoundDepthMap& bound, const Share& share) HWY_ATTR {
        const Receiver r = MapReader(test, bound, samples.position_error).Find(points);
        const auto asked = hn::And(hn::And(share.here, r.is_seen), MaskFromBits(bits));
        if (!hn::AllFalse(FloatTag(), asked))
          use(static_cast<std::size_t>(&bound - test.maps.data()), r, asked);
      });
    }
  }
}

// Where on a map samples lie.
class AskedTexels {
 public:
  AskedTexels()
      : low_x_(Splat(1e30F)), high_x_(Splat(-1e30F)), low_y_(Splat(1e30F)), high_y_(Splat(-1e30F)) {}

  HWY_INLINE void Add(const Receiver& r, FloatMask asked) {
    low_x_ = hn::Min(low_x_, hn::IfThenElse(asked, r.x, low_x_));
    high_x_ = hn::Max(high_x_, hn::IfThenElse(asked, r.x, high_x_));
    low_y_ = hn::Min(low_y_, hn::IfThenElse(asked, r.y, low_y_));
    high_y_ = hn::Max(high_y_, hn::IfThenElse(asked, r.y, high_y_));
  }
  [[nodiscard]] HWY_INLINE bool AreDrawn(const TileFinder& finder) const {
    const auto low = [](FloatVector v) HWY_ATTR { return hn::GetLane(hn::MinOfLanes(FloatTag(), v)); };
    const auto high = [](FloatVector v) HWY_ATTR { return hn::GetLane(hn::MaxOfLanes(FloatTag(), v)); };
    if (low(low_x_) > high(high_x_)) return true;  // nobody asks
    return finder.IsDrawn(finder.Around(low(low_x_), high(high_x_), low(low_y_), high(high_y_)));
  }

 private:
  FloatVector low_x_, high_x_, low_y_, high_y_;
};

// Most often all tiles about a batch's samples are drawn: then nothing is asked sample by sample.
HWY_INLINE bool AreAllDrawn(const ShadowMapTest& test, const SurfaceSamples& samples,
                            std::span<const std::uint16_t> wanted, std::vector<MapTile>& missing) {
  AskedTexels asked_texels[kMostMaps];
  ForEachReceiver(test, samples, wanted, [&](std::size_t map, const Receiver& r, FloatMask asked) HWY_ATTR {
    asked_texels[map].Add(r, asked);
  });
  for (std::size_t map = 0; map < test.maps.size(); ++map) {
    if (!asked_texels[map].AreDrawn(TileFinder(test, map, missing))) return false;
  }
  return true;
}

void find_missing_tiles(const ShadowMapTest& test, const SurfaceSamples& samples,
                        std::span<const std::uint16_t> wanted, std::vector<MapTile>& missing) {
  const auto is_complete = [](const BoundDepthMap& map) { return map.map->is_complete(); };
  if (std::all_of(test.maps.begin(), test.maps.end(), is_complete)) return;
  if (AreAllDrawn(test, samples, wanted, missing)) return;
  ForEachReceiver(test, samples, wanted, [&](std::size_t map, const Receiver& r, FloatMask asked) HWY_ATTR {
    TileFinder finder(test, map, missing);
    AskedTexels texels;
    texels.Add(r, asked);
    if (texels.AreDrawn(finder)) return;
    // Samples of one group may lie far apart on the map.
    alignas(64) float x[kLanes], y[kLanes];
    hn::Store(r.x, FloatTag(), x);
    hn::Store(r.y, FloatTag(), y);
    for (std::uint32_t left = BitsOf(asked); left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(__builtin_ctz(left));
      finder.Note(finder.Around(x[i], x[i], y[i], y[i]));
    }
  });
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shadow {
LATERNA_KERNEL_TABLE(look_up_shadow_map)
LATERNA_KERNEL_TABLE(find_missing_tiles)

bool is_lit(float stored, float tested, float bias) {
  return HWY_STATIC_DISPATCH(IsLit)(stored, tested, bias);
}
}  // namespace laterna::shadow
#endif
