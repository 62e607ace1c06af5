// Filtered look-ups into a MipChain, N at a time: nearest, bilinear, trilinear and anisotropic.
#if defined(LATERNA_IMAGE_TEXTURE_LOOKUP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_IMAGE_TEXTURE_LOOKUP_INL_H_
#undef LATERNA_IMAGE_TEXTURE_LOOKUP_INL_H_
#else
#define LATERNA_IMAGE_TEXTURE_LOOKUP_INL_H_
#endif

#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "image/mip_chain.h"
#include "laterna/sampler.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::image::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// Coordinates over the picture, (0, 0) its top-left corner, and their change from one pixel to the next.
struct Footprint {
  FloatVector u, v;
  FloatVector du_dx, dv_dx, du_dy, dv_dy;
};

HWY_INLINE Vector3 Where(FloatMask mask, const Vector3& v) {
  return {hn::IfThenElseZero(mask, v.x), hn::IfThenElseZero(mask, v.y), hn::IfThenElseZero(mask, v.z)};
}
HWY_INLINE FloatVector Where(FloatMask mask, FloatVector value) { return hn::IfThenElseZero(mask, value); }

// Of colours or numbers.
template <class T>
HWY_INLINE T Lerp(const T& a, const T& b, FloatVector t) {
  return a + (b - a) * t;
}

// Where a row or column of texels is read: two neighbours and the weight of the second.
struct Taps {
  IntVector low, high;
  FloatVector weight;
};

// A coordinate brought into [0, 1] along its axis. Coordinates that are not numbers, or too large to have a fraction,
// read the first texel: no index ever leaves the picture.
HWY_INLINE FloatVector Wrapped(FloatVector coordinate, Wrap wrap) {
  const auto c = hn::IfThenElseZero(hn::Abs(coordinate) <= Splat(8388608.0F), coordinate);
  if (wrap == Wrap::repeat) return c - hn::Floor(c);
  if (wrap == Wrap::clamp) return Saturate(c);
  const auto there_and_back = c - Splat(2.0F) * hn::Floor(c * Splat(0.5F));
  return hn::Min(there_and_back, Splat(2.0F) - there_and_back);
}

// Texel indices along one axis of `size` texels.
HWY_INLINE Taps FindTaps(FloatVector wrapped, IntVector size, Wrap wrap) {
  const FloatTag d;
  const IntTag di;
  const auto zero = hn::Zero(di);
  const auto position = wrapped * hn::ConvertTo(d, size) - Splat(0.5F);
  const auto floor = hn::Floor(position);
  const auto low = hn::ConvertTo(di, floor);  // −1 … size − 1
  const auto high = low + SplatInt(1);
  const auto last = size - SplatInt(1);
  const bool repeats = wrap == Wrap::repeat;
  Taps taps;
  taps.weight = position - floor;
  taps.low = repeats ? hn::IfThenElse(low < zero, last, low) : hn::Max(low, zero);
  taps.high = repeats ? hn::IfThenElse(high > last, zero, high) : hn::Min(high, last);
  return taps;
}

// The nearer of the two neighbours instead of both, where wanted.
HWY_INLINE void TakeNearest(Taps& taps, FloatMask is_nearest) {
  const auto second = hn::And(is_nearest, taps.weight >= Splat(0.5F));
  taps.low = hn::IfThenElse(hn::RebindMask(IntTag(), second), taps.high, taps.low);
  taps.weight = hn::IfThenZeroElse(is_nearest, taps.weight);
}

// A reader fetches two texels of a row as they are stored, and turns what it fetched into numbers not yet scaled to
// [0, 1]: the scale is applied once, after filtering.
template <class Stored>
struct Pair {
  Stored left, right;
};

// Alpha alone.
struct AlphaReader {
  using Texel = FloatVector;
  using Stored = UintVector;
  const MipChain& chain;

  HWY_INLINE Pair<UintVector> Fetch(IntVector row, const Taps& x, bool are_neighbours) const {
    const IntTag di;
    const UintTag du;
    if (chain.format == TexelFormat::data) {
      const auto* words = reinterpret_cast<const std::int32_t*>(chain.texels.data());
      const auto read = [&](IntVector column) HWY_ATTR {
        return hn::ShiftRight<24>(hn::BitCast(du, hn::GatherIndex(di, words, row + column)));
      };
      return {read(x.low), read(x.high)};
    }
    // Three more bytes than texels can be read: the word that starts with a texel holds its right neighbour, too.
    const auto* bytes = reinterpret_cast<const std::int32_t*>(chain.alpha.data());
    const auto read = [&](IntVector column)
                          HWY_ATTR { return hn::BitCast(du, hn::GatherOffset(di, bytes, row + column)); };
    const auto word = read(x.low);
    return {word, are_neighbours ? hn::ShiftRight<8>(word) : read(x.high)};
  }

  static HWY_INLINE FloatVector Decoded(UintVector word) {
    return hn::ConvertTo(FloatTag(), hn::BitCast(IntTag(), hn::And(word, hn::Set(UintTag(), 255U))));
  }

  static HWY_INLINE FloatVector Scaled(FloatVector alpha) { return alpha * Splat(1.0F / 255.0F); }
};

// Red, green and blue as x, y, z: `colour` and `data`.
template <TexelFormat kFormat>
struct ColourReader {
  using Texel = Vector3;
  using Stored = UintVector;
  const MipChain& chain;

  // Most often the two are neighbours in memory, and one access reads both.
  HWY_INLINE Pair<UintVector> Fetch(IntVector row, const Taps& x, bool are_neighbours) const {
    if (HWY_LIKELY(are_neighbours)) return GatherNeighbours(row + x.low);
    return {At(row + x.low), At(row + x.high)};
  }
  // One texel alone.
  HWY_INLINE UintVector At(IntVector index) const {
    const auto* texels = reinterpret_cast<const std::int32_t*>(chain.texels.data());
    return hn::BitCast(UintTag(), hn::GatherIndex(IntTag(), texels, index));
  }

  static HWY_INLINE Vector3 Decoded(UintVector packed) {
    const FloatTag d;
    const IntTag di;
    const UintTag du;
    const auto number = [&](UintVector bits) HWY_ATTR { return hn::ConvertTo(d, hn::BitCast(di, bits)); };
    if constexpr (kFormat == TexelFormat::colour) {
      const auto r = number(hn::ShiftRight<21>(packed));
      const auto g = number(hn::And(hn::ShiftRight<10>(packed), hn::Set(du, 2047U)));
      const auto b = number(hn::And(packed, hn::Set(du, 1023U)));
      return {r * r, g * g, b * b};
    } else {
      const auto byte = hn::Set(du, 255U);
      return {number(hn::And(packed, byte)), number(hn::And(hn::ShiftRight<8>(packed), byte)),
              number(hn::And(hn::ShiftRight<16>(packed), byte))};
    }
  }

  static HWY_INLINE Vector3 Scaled(const Vector3& t) {
    if constexpr (kFormat == TexelFormat::colour) {
      const auto scale = Splat(1.0F / (kLargestRedGreen * kLargestRedGreen));
      return {t.x * scale, t.y * scale, t.z * Splat(1.0F / (kLargestBlue * kLargestBlue))};
    } else {
      return t * Splat(1.0F / 255.0F);
    }
  }

 private:
  // The texels at `index` and to their right: 64 bits at a time, first for the even lanes, then for the odd ones.
  HWY_INLINE Pair<UintVector> GatherNeighbours(IntVector index) const {
#if HWY_TARGET == HWY_SCALAR  // has no vectors of 64-bit lanes half as long
    return {At(index), At(index + SplatInt(1))};
#else
    const UintTag du;
    const hn::Repartition<std::uint64_t, UintTag> du64;
    const hn::RebindToSigned<decltype(du64)> di64;
    const auto* texels = reinterpret_cast<const std::uint64_t*>(chain.texels.data());
    const auto indices = hn::BitCast(du64, index);
    const auto even_offset = hn::ShiftRight<30>(hn::ShiftLeft<32>(indices));
    const auto odd_offset = hn::ShiftLeft<2>(hn::ShiftRight<32>(indices));
    const auto even = hn::GatherOffset(du64, texels, hn::BitCast(di64, even_offset));
    const auto odd = hn::GatherOffset(du64, texels, hn::BitCast(di64, odd_offset));
    return {hn::OddEven(hn::BitCast(du, hn::ShiftLeft<32>(odd)), hn::BitCast(du, even)),
            hn::OddEven(hn::BitCast(du, odd), hn::BitCast(du, hn::ShiftRight<32>(even)))};
#endif
  }
};

template <>
struct ColourReader<TexelFormat::wide> {
  using Texel = Vector3;
  using Stored = Vector3;
  const MipChain& chain;

  HWY_INLINE Pair<Vector3> Fetch(IntVector row, const Taps& x, bool) const {
    return {At(row + x.low), At(row + x.high)};
  }
  HWY_INLINE Vector3 At(IntVector index) const {
    const FloatTag d;
    const float* r = chain.wide.data();
    return {hn::GatherIndex(d, r, index), hn::GatherIndex(d, r + chain.texel_count, index),
            hn::GatherIndex(d, r + std::size_t{2} * chain.texel_count, index)};
  }
  static HWY_INLINE Vector3 Decoded(const Vector3& colour) { return colour; }
  static HWY_INLINE Vector3 Scaled(const Vector3& colour) { return colour; }
};

template <class Reader>
class Lookup {
  using Texel = typename Reader::Texel;

 public:
  Lookup(const MipChain& chain, const Sampler& sampler, int anisotropy)
      : reader_{chain}, chain_(chain), sampler_(sampler), anisotropy_(anisotropy) {}

  Texel Filtered(const Footprint& f) const {
    const auto width = Splat(static_cast<float>(chain_.width()));
    const auto height = Splat(static_cast<float>(chain_.height()));
    // Length of the pixel's two sides, in texels, squared.
    const auto ux = f.du_dx * width, vx = f.dv_dx * height, uy = f.du_dy * width, vy = f.dv_dy * height;
    const auto x_squared = ux * ux + vx * vx, y_squared = uy * uy + vy * vy;
    const auto longest = hn::Max(x_squared, y_squared);
    if (anisotropy_ <= 1 || sampler_.mip == MipFilter::none) return AtLevel(f.u, f.v, Level(longest));
    return Anisotropic(f, x_squared, y_squared);
  }

  // As for a footprint of no size.
  HWY_INLINE Texel AtFullSize(FloatVector u, FloatVector v) const {
    const auto none = Splat(0.0F) > Splat(1.0F);
    return Blended(Fetch(Wrapped(u, sampler_.wrap_u), Wrapped(v, sampler_.wrap_v), hn::Zero(IntTag()), none));
  }

 private:
  // log2 of the footprint's side. Footprints of nothing and of everything are held to numbers.
  static HWY_INLINE FloatVector Level(FloatVector length_squared) {
    const auto held = hn::Min(hn::Max(length_squared, Splat(1e-20F)), Splat(1e20F));
    return Splat(0.5F) * Logarithm2(hn::IfThenElse(length_squared == length_squared, held, Splat(1e20F)));
  }

  // Several probes along the footprint's longer side, each as wide as the shorter
  // (EXT_texture_filter_anisotropic).
  HWY_NOINLINE Texel Anisotropic(const Footprint& f, FloatVector x_squared, FloatVector y_squared) const {
    const auto along_x = x_squared > y_squared;
    const auto longest = hn::Max(x_squared, y_squared);
    const auto shortest = hn::Max(hn::Min(x_squared, y_squared), Splat(1e-20F));
    const auto most = static_cast<float>(anisotropy_);
    // Magnified pictures need no probes.
    const auto ratio =
        hn::Sqrt(hn::Min(hn::Min(longest / shortest, hn::Max(longest, Splat(1.0F))), Splat(most * most)));
    auto probes = hn::Max(hn::Ceil(ratio - Splat(1e-4F)), Splat(1.0F));
    probes =
        hn::IfThenElse(probes <= Splat(most), probes, Splat(most));  // also where the ratio is not a number
    const auto level = Level(longest / (probes * probes));
    const auto du = hn::IfThenElse(along_x, f.du_dx, f.du_dy);
    const auto dv = hn::IfThenElse(along_x, f.dv_dx, f.dv_dy);
    const auto step = Splat(1.0F) / (probes + Splat(1.0F));
    const auto inverse = Splat(1.0F) / probes;
    Texel sum = {};
    for (int i = 1; i <= anisotropy_; ++i) {
      const auto number = Splat(static_cast<float>(i));
      const auto is_probe = number <= probes;
      if (hn::AllFalse(FloatTag(), is_probe)) break;
      const auto t = number * step - Splat(0.5F);
      const Texel probe = AtLevel(f.u + t * du, f.v + t * dv, level);
      sum = sum + Where(is_probe, probe);
    }
    return sum * inverse;
  }

  HWY_NOINLINE Texel AtLevel(FloatVector u, FloatVector v, FloatVector level) const {
    const FloatTag d;
    const IntTag di;
    u = Wrapped(u, sampler_.wrap_u);
    v = Wrapped(v, sampler_.wrap_v);
    const auto is_minified = level > Splat(0.0F);
    if (sampler_.mip == MipFilter::none || chain_.level_count == 1 || hn::AllFalse(d, is_minified)) {
      return Blended(Fetch(u, v, hn::Zero(di), is_minified));
    }
    const auto last = Splat(static_cast<float>(chain_.level_count - 1));
    const auto held = hn::Min(hn::Max(level, Splat(0.0F)), last);
    if (sampler_.mip == MipFilter::nearest) {
      const auto nearest = hn::ConvertTo(di, hn::Floor(hn::Min(held + Splat(0.5F), last)));
      return Blended(Fetch(u, v, nearest, is_minified));
    }
    const auto floor = hn::Floor(held);
    const auto finer = hn::ConvertTo(di, floor);
    const auto coarser = hn::Min(finer + SplatInt(1), SplatInt(chain_.level_count - 1));
    // Memory is slow: both levels are asked for before either is used.
    const Quad fine = Fetch(u, v, finer, is_minified), coarse = Fetch(u, v, coarser, is_minified);
    return Lerp(Blended(fine), Blended(coarse), held - floor);
  }

  struct LevelLayout {
    IntVector width, height, first;
  };
  // One look-up for all lanes where they read the same level, as most neighbours do.
  HWY_INLINE LevelLayout LayoutOf(IntVector level) const {
    const IntTag di;
    const std::int32_t common = hn::GetLane(level);
    if (HWY_LIKELY(hn::AllTrue(di, level == SplatInt(common)))) {
      const MipLevel& l = chain_.levels[static_cast<std::size_t>(common)];
      return {SplatInt(l.width), SplatInt(l.height), SplatInt(static_cast<std::int32_t>(l.first))};
    }
    static_assert(sizeof(MipLevel) == 3 * sizeof(std::int32_t));
    const std::int32_t* table = &chain_.levels[0].width;
    const auto entry = level + level + level;
    return {hn::GatherIndex(di, table, entry), hn::GatherIndex(di, table, entry + SplatInt(1)),
            hn::GatherIndex(di, table, entry + SplatInt(2))};
  }

  // The four texels about each lane's place in one level, as they are stored, and how to weigh them.
  struct Quad {
    Pair<typename Reader::Stored> above, below;
    FloatVector x_weight, y_weight;
  };
  // Each lane has its own level. With the sampler's filter for minified and magnified pictures.
  HWY_INLINE Quad Fetch(FloatVector wrapped_u, FloatVector wrapped_v, IntVector level,
                        FloatMask is_minified) const {
    const FloatTag d;
    const IntTag di;
    const LevelLayout layout = LayoutOf(level);
    Taps x = FindTaps(wrapped_u, layout.width, sampler_.wrap_u);
    Taps y = FindTaps(wrapped_v, layout.height, sampler_.wrap_v);
    if (sampler_.magnify == Filter::nearest || sampler_.minify == Filter::nearest) {
      const auto all = hn::MaskFromVec(hn::BitCast(d, SplatInt(-1)));
      const auto is_nearest = sampler_.magnify == sampler_.minify  ? all
                              : sampler_.minify == Filter::nearest ? is_minified
                                                                   : hn::Not(is_minified);
      TakeNearest(x, is_nearest);
      TakeNearest(y, is_nearest);
    }
    const bool are_neighbours = hn::AllTrue(di, x.high == x.low + SplatInt(1));
    return {reader_.Fetch(layout.first + y.low * layout.width, x, are_neighbours),
            reader_.Fetch(layout.first + y.high * layout.width, x, are_neighbours), x.weight, y.weight};
  }

  static HWY_INLINE Texel Blended(const Quad& quad) {
    const auto row = [&](const Pair<typename Reader::Stored>& pair) HWY_ATTR {
      return Lerp(Reader::Decoded(pair.left), Reader::Decoded(pair.right), quad.x_weight);
    };
    return Reader::Scaled(Lerp(row(quad.above), row(quad.below), quad.y_weight));
  }

  Reader reader_;
  const MipChain& chain_;
  const Sampler& sampler_;
  int anisotropy_;  // most probes along a stretched footprint, 1…16
};

// The picture's colour over the footprint, in linear light. A call costs little beside the look-up, and keeps each
// kernel that reads textures from holding a dozen copies of this.
inline HWY_NOINLINE Vector3 LookUp(const MipChain& chain, const Sampler& sampler, int anisotropy,
                                   const Footprint& footprint) {
  switch (chain.format) {
    case TexelFormat::colour:
      return Lookup<ColourReader<TexelFormat::colour>>(chain, sampler, anisotropy).Filtered(footprint);
    case TexelFormat::data:
      return Lookup<ColourReader<TexelFormat::data>>(chain, sampler, anisotropy).Filtered(footprint);
    case TexelFormat::wide:
      break;
  }
  return Lookup<ColourReader<TexelFormat::wide>>(chain, sampler, anisotropy).Filtered(footprint);
}

// The picture's alpha over the footprint; 1 where it has none.
inline HWY_NOINLINE FloatVector LookUpAlpha(const MipChain& chain, const Sampler& sampler, int anisotropy,
                                            const Footprint& footprint) {
  if (!chain.has_alpha()) return Splat(1.0F);
  return Lookup<AlphaReader>(chain, sampler, anisotropy).Filtered(footprint);
}

// The same for a footprint of no size.
HWY_INLINE FloatVector LookUpFullSizeAlpha(const MipChain& chain, const Sampler& sampler, FloatVector u,
                                           FloatVector v) {
  if (!chain.has_alpha()) return Splat(1.0F);
  return Lookup<AlphaReader>(chain, sampler, 1).AtFullSize(u, v);
}

}  // namespace laterna::image::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
