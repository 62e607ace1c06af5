// Means of a MipChain over discs, N at a time: pictures out of focus.
#if defined(LATERNA_IMAGE_DISC_LOOKUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_IMAGE_DISC_LOOKUP_INL_H_
#undef LATERNA_IMAGE_DISC_LOOKUP_INL_H_
#else
#define LATERNA_IMAGE_DISC_LOOKUP_INL_H_
#endif

#include <hwy/highway.h>

#include "image/texture_lookup-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::image::HWY_NAMESPACE {

// Ellipses along the picture's sides, about (u, v), with radii greater than 0; all in units of the sides.
struct Disc {
  FloatVector u, v, radius_u, radius_v;
};

// Stands for a picture of nothing but white, whose texels need not be stored.
struct WhiteReader {
  using Stored = Vector3;
  static HWY_INLINE Vector3 At(IntVector) {
    const auto one = Splat(1.0F);
    return {one, one, one};
  }
  static HWY_INLINE Vector3 Decoded(const Vector3& white) { return white; }
  static HWY_INLINE Vector3 Scaled(const Vector3& white) { return white; }
};
inline constexpr int kWhiteSide = 4096, kWhiteLevels = 13;

// What lies beyond the picture: nothing, or the picture as the sampler repeats it.
enum class Beyond : std::uint8_t { black, clamp, repeat, mirror };

// Every texel whose centre lies in the disc counts alike; across the rim the weight falls over a few texels' width. The level
// is chosen so that discs are kFinest to 2 kFinest texels in radius, or smaller at full size.
template <class Reader>
class DiscLookup {
 public:
  DiscLookup(Reader reader, const MipChain* chain, Beyond beyond)
      : reader_(reader), chain_(chain), beyond_(beyond) {}

  HWY_NOINLINE Vector3 Mean(Disc disc) const {
    const FloatTag d;
    const IntTag di;
    const int level_count = chain_ != nullptr ? chain_->level_count : kWhiteLevels;
    const auto width = Splat(static_cast<float>(chain_ != nullptr ? chain_->width() : kWhiteSide));
    const auto height = Splat(static_cast<float>(chain_ != nullptr ? chain_->height() : kWhiteSide));
    disc.u = Held(disc.u);
    disc.v = Held(disc.v);
    disc.radius_u = hn::Min(disc.radius_u, Splat(kFarthest));
    disc.radius_v = hn::Min(disc.radius_v, Splat(kFarthest));
    const auto radius = hn::Max(disc.radius_u * width, disc.radius_v * height);
    const auto last = Splat(static_cast<float>(level_count - 1));
    const auto level = hn::Min(hn::Max(Logarithm2(radius * Splat(1.0F / kFinest)), Splat(0.0F)), last);
    const auto floor = hn::Floor(level);
    const Vector3 fine = MeanAt(disc, hn::ConvertTo(di, floor));
    // Shortly before the next level takes over it is blended in, so that no edge is seen where it does.
    const auto t = Saturate((level - floor) * Splat(kBlend) - Splat(kBlend - 1));
    if (hn::AllTrue(d, t <= Splat(0.0F))) return fine;
    return Lerp(fine, MeanAt(disc, hn::ConvertTo(di, hn::Min(floor + Splat(1.0F), last))), t);
  }

 private:
  static constexpr float kFinest = 4;      // texels
  static constexpr float kBlend = 4;       // 1 / the share of an octave
  static constexpr float kFarthest = 256;  // pictures
  static constexpr float kLargest = 8;     // texels; larger discs, of the last level, are dimmed instead
  // Beyond the rim, where weights fall from 1 to 0. As wide as a tent of two texels (bilinear filtering) is to its variance.
  static constexpr float kRim = 1.41421356F;

  // Where nothing is seen numbers may be any; indices are of small ones.
  static HWY_INLINE FloatVector Held(FloatVector coordinate) {
    const auto c = hn::IfThenElseZero(hn::Abs(coordinate) <= Splat(8388608.0F), coordinate);
    return hn::Min(hn::Max(c, Splat(-kFarthest)), Splat(kFarthest));
  }

  struct Level {
    FloatVector width, height;  // texels
    IntVector row_length, first;
  };
  HWY_INLINE Level FindLevel(IntVector level) const {
    const FloatTag d;
    const IntTag di;
    if (chain_ == nullptr) {
      alignas(64) std::int32_t sides[kLanes];
      hn::Store(level, di, sides);
      for (std::int32_t& side : sides) side = kWhiteSide >> side;
      const auto side = hn::Load(di, sides);
      return {hn::ConvertTo(d, side), hn::ConvertTo(d, side), side, hn::Zero(di)};
    }
    static_assert(sizeof(MipLevel) == 3 * sizeof(std::int32_t));
    const std::int32_t* table = &chain_->levels[0].width;
    const auto entry = level + level + level;
    const auto width = hn::GatherIndex(di, table, entry);
    const auto height = hn::GatherIndex(di, table, entry + SplatInt(1));
    return {hn::ConvertTo(d, width), hn::ConvertTo(d, height), width,
            hn::GatherIndex(di, table, entry + SplatInt(2))};
  }

  // Texels along one axis, held within the picture, and whether they are there at all.
  struct Place {
    IntVector index;
    FloatMask is_there;
  };
  HWY_INLINE Place FindPlace(FloatVector texel, FloatVector size) const {
    const IntTag di;
    const auto zero = Splat(0.0F), half = Splat(0.5F);
    const auto last = size - Splat(1.0F);
    const auto is_within = hn::And(texel >= zero, texel <= last);
    auto t = texel;
    if (beyond_ == Beyond::repeat) t = t - size * hn::Floor((t + half) / size);
    if (beyond_ == Beyond::mirror) {
      const auto period = size + size;
      t = t - period * hn::Floor((t + half) / period);
      t = hn::Min(t, period - Splat(1.0F) - t);
    }
    const auto held = hn::Min(hn::Max(t, zero), last);
    return {hn::ConvertTo(di, held), beyond_ == Beyond::black ? is_within : zero <= zero};
  }

  static HWY_INLINE int LargestWhole(FloatVector value) {
    const FloatTag d;
    return static_cast<int>(hn::GetLane(hn::MaxOfLanes(d, value)));
  }

  HWY_NOINLINE Vector3 MeanAt(const Disc& disc, IntVector of_level) const {
    const FloatTag d;
    const auto zero = Splat(0.0F), one = Splat(1.0F), half = Splat(0.5F);
    const Level level = FindLevel(of_level);
    const auto x = disc.u * level.width, y = disc.v * level.height;
    const auto true_x = disc.radius_u * level.width, true_y = disc.radius_v * level.height;
    const auto radius_x = hn::Min(hn::Max(true_x, half), Splat(kLargest));
    const auto radius_y = hn::Min(hn::Max(true_y, half), Splat(kLargest));
    const auto inverse_x = one / radius_x, inverse_y = one / radius_y;
    const auto steepness = hn::Min(radius_x, radius_y) * Splat(0.5F / kRim);
    const auto column_0 = hn::Floor(x), row_0 = hn::Floor(y);
    // Weights are 0 from d² = 1 + 1 / (2 steepness) on.
    const auto reach_squared = one + half / steepness;
    // Rows and columns in which some lane has a weight; what is added to the others is nothing, whatever the lanes.
    const int rows = LargestWhole(hn::Ceil(radius_y * hn::Sqrt(reach_squared)));
    Vector3 sum = {zero, zero, zero};
    auto weights = zero;
    for (int j = -rows; j <= rows; ++j) {
      const auto row = row_0 + Splat(static_cast<float>(j));
      const auto dy = (row + half - y) * inverse_y;
      const auto left = reach_squared - dy * dy;
      const Place place_y = FindPlace(row, level.height);
      if (hn::AllTrue(d, left <= zero)) continue;
      const int chord = LargestWhole(hn::Ceil(radius_x * hn::Sqrt(hn::Max(left, zero))));
      const auto row_start = level.first + place_y.index * level.row_length;
      for (int i = -chord; i <= chord; ++i) {
        const auto column = column_0 + Splat(static_cast<float>(i));
        const auto dx = (column + half - x) * inverse_x;
        const auto weight = Saturate((left - dx * dx) * steepness);
        weights = weights + weight;
        const Place place_x = FindPlace(column, level.width);
        const auto counts = hn::And(weight > zero, hn::And(place_x.is_there, place_y.is_there));
        const Vector3 colour = Reader::Decoded(reader_.At(row_start + place_x.index));
        sum = sum + Where(counts, colour * weight);
      }
    }
    auto scale = one / weights;
    if (beyond_ == Beyond::black)
      scale = scale * hn::Min(one, (radius_x * radius_y) / hn::Max(true_x * true_y, Splat(1e-20F)));
    return Reader::Scaled(sum) * scale;
  }

  Reader reader_;
  const MipChain* chain_;
  Beyond beyond_;
};

// The picture's mean colour over the disc, in linear light; of a white picture where there is none.
inline HWY_NOINLINE Vector3 LookUpDisc(const MipChain* chain, Beyond beyond, const Disc& disc) {
  if (chain == nullptr) return DiscLookup<WhiteReader>({}, nullptr, beyond).Mean(disc);
  switch (chain->format) {
    case TexelFormat::colour:
      return DiscLookup<ColourReader<TexelFormat::colour>>({*chain}, chain, beyond).Mean(disc);
    case TexelFormat::data:
      return DiscLookup<ColourReader<TexelFormat::data>>({*chain}, chain, beyond).Mean(disc);
    case TexelFormat::wide:
      break;
  }
  return DiscLookup<ColourReader<TexelFormat::wide>>({*chain}, chain, beyond).Mean(disc);
}

}  // namespace laterna::image::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
