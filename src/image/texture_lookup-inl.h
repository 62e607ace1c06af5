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

struct Texel4 {
  FloatVector r, g, b, a;
};

// Where a row or column of texels is read: two neighbours and the weight of the second.
struct Taps {
  IntVector low, high;
  FloatVector weight;
};

// Texel indices along one axis of `size` texels. Coordinates that are not numbers, or too large to have a
// fraction, read the first texel: no index ever leaves the level.
HWY_INLINE Taps FindTaps(FloatVector coordinate, IntVector size, Wrap wrap) {
  const FloatTag d;
  const IntTag di;
  const auto zero = hn::Zero(di);
  const auto one = SplatInt(1);
  auto c = hn::IfThenElseZero(hn::Abs(coordinate) <= Splat(8388608.0F), coordinate);
  if (wrap == Wrap::repeat) {
    c = c - hn::Floor(c);
  } else if (wrap == Wrap::mirror) {
    c = c - Splat(2.0F) * hn::Floor(c * Splat(0.5F));
    c = hn::Min(c, Splat(2.0F) - c);
  } else {
    c = Saturate(c);
  }
  const auto position = c * hn::ConvertTo(d, size) - Splat(0.5F);
  const auto floor = hn::Floor(position);
  const auto low = hn::ConvertTo(di, floor);
  const auto high = low + one;
  const auto last = size - one;
  Taps taps;
  taps.weight = position - floor;
  if (wrap == Wrap::repeat) {
    taps.low = hn::IfThenElse(low < zero, last, hn::Min(low, last));
    taps.high = hn::IfThenElse(high > last, zero, high);
  } else {
    taps.low = hn::Min(hn::Max(low, zero), last);
    taps.high = hn::Min(high, last);
  }
  return taps;
}

// The nearer of the two neighbours instead of both, where wanted.
HWY_INLINE void TakeNearest(Taps& taps, FloatMask is_nearest) {
  const auto second = hn::And(is_nearest, taps.weight >= Splat(0.5F));
  taps.low = hn::IfThenElse(hn::RebindMask(IntTag(), second), taps.high, taps.low);
  taps.weight = hn::IfThenZeroElse(is_nearest, taps.weight);
}

// Texels not yet scaled to [0, 1]: the scale is applied once, after filtering.
template <TexelFormat kFormat, bool kAlpha>
struct TexelReader {
  const MipChain& chain;

  HWY_INLINE Texel4 Read(IntVector index) const {
    const FloatTag d;
    const IntTag di;
    const UintTag du;
    Texel4 t;
    t.a = Splat(1.0F);
    if constexpr (kFormat == TexelFormat::wide) {
      t.r = hn::GatherIndex(d, chain.wide.data(), index);
      t.g = hn::GatherIndex(d, chain.wide.data() + chain.texel_count, index);
      t.b = hn::GatherIndex(d, chain.wide.data() + std::size_t{2} * chain.texel_count, index);
    } else {
      const auto packed = hn::BitCast(
          du, hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(chain.texels.data()), index));
      const auto number = [&](UintVector bits) HWY_ATTR { return hn::ConvertTo(d, hn::BitCast(di, bits)); };
      if constexpr (kFormat == TexelFormat::colour) {
        const auto r = number(hn::ShiftRight<21>(packed));
        const auto g = number(hn::And(hn::ShiftRight<10>(packed), hn::Set(du, 2047U)));
        const auto b = number(hn::And(packed, hn::Set(du, 1023U)));
        t.r = r * r;
        t.g = g * g;
        t.b = b * b;
      } else {
        const auto byte = hn::Set(du, 255U);
        t.r = number(hn::And(packed, byte));
        t.g = number(hn::And(hn::ShiftRight<8>(packed), byte));
        t.b = number(hn::And(hn::ShiftRight<16>(packed), byte));
        if constexpr (kAlpha) t.a = number(hn::ShiftRight<24>(packed));
      }
    }
    if constexpr (kAlpha && kFormat != TexelFormat::data) {
      if (!chain.alpha.empty()) {
        // Three more bytes than texels can be read.
        const auto word =
            hn::GatherOffset(di, reinterpret_cast<const std::int32_t*>(chain.alpha.data()), index);
        t.a = hn::ConvertTo(d, hn::And(word, SplatInt(255)));
      }
    }
    return t;
  }

  HWY_INLINE Texel4 Scaled(const Texel4& t) const {
    Texel4 out = t;
    if constexpr (kFormat == TexelFormat::colour) {
      const auto r_scale = Splat(1.0F / (2047.0F * 2047.0F));
      out.r = t.r * r_scale;
      out.g = t.g * r_scale;
      out.b = t.b * Splat(1.0F / (1023.0F * 1023.0F));
    } else if constexpr (kFormat == TexelFormat::data) {
      const auto scale = Splat(1.0F / 255.0F);
      out = {t.r * scale, t.g * scale, t.b * scale, kAlpha ? t.a * scale : t.a};
    }
    if constexpr (kAlpha && kFormat != TexelFormat::data) {
      if (!chain.alpha.empty()) out.a = t.a * Splat(1.0F / 255.0F);
    }
    return out;
  }
};

HWY_INLINE Texel4 Lerp(const Texel4& a, const Texel4& b, FloatVector t) {
  return {a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t, a.a + (b.a - a.a) * t};
}

template <TexelFormat kFormat, bool kAlpha>
class Lookup {
 public:
  Lookup(const MipChain& chain, const Sampler& sampler, int anisotropy)
      : reader_{chain}, chain_(chain), sampler_(sampler), anisotropy_(anisotropy) {}

  Texel4 Filtered(const Footprint& f) const {
    const auto width = Splat(static_cast<float>(chain_.width()));
    const auto height = Splat(static_cast<float>(chain_.height()));
    // Length of the pixel's two sides, in texels, squared.
    const auto ux = f.du_dx * width, vx = f.dv_dx * height, uy = f.du_dy * width, vy = f.dv_dy * height;
    const auto x_squared = ux * ux + vx * vx, y_squared = uy * uy + vy * vy;
    const auto longest = hn::Max(x_squared, y_squared);
    if (anisotropy_ <= 1 || sampler_.mip == MipFilter::none) return AtLevel(f.u, f.v, Level(longest));
    return Anisotropic(f, x_squared, y_squared);
  }

 private:
  // log2 of the footprint's side. Footprints of nothing and of everything are held to numbers.
  static HWY_INLINE FloatVector Level(FloatVector length_squared) {
    const auto held = hn::Min(hn::Max(length_squared, Splat(1e-20F)), Splat(1e20F));
    return Splat(0.5F) * Logarithm2(hn::IfThenElse(length_squared == length_squared, held, Splat(1e20F)));
  }

  // Several probes along the footprint's longer side, each as wide as the shorter
  // (EXT_texture_filter_anisotropic).
  HWY_NOINLINE Texel4 Anisotropic(const Footprint& f, FloatVector x_squared, FloatVector y_squared) const {
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
    const auto zero = Splat(0.0F);
    Texel4 sum = {zero, zero, zero, zero};
    for (int i = 1; i <= anisotropy_; ++i) {
      const auto number = Splat(static_cast<float>(i));
      const auto is_probe = number <= probes;
      if (hn::AllFalse(FloatTag(), is_probe)) break;
      const auto t = number * step - Splat(0.5F);
      const Texel4 probe = AtLevel(f.u + t * du, f.v + t * dv, level);
      sum.r = sum.r + hn::IfThenElseZero(is_probe, probe.r);
      sum.g = sum.g + hn::IfThenElseZero(is_probe, probe.g);
      sum.b = sum.b + hn::IfThenElseZero(is_probe, probe.b);
      sum.a = sum.a + hn::IfThenElseZero(is_probe, probe.a);
    }
    return {sum.r * inverse, sum.g * inverse, sum.b * inverse, sum.a * inverse};
  }

  HWY_NOINLINE Texel4 AtLevel(FloatVector u, FloatVector v, FloatVector level) const {
    const FloatTag d;
    const IntTag di;
    const auto is_minified = level > Splat(0.0F);
    const auto zero = hn::Zero(di);
    if (sampler_.mip == MipFilter::none || chain_.level_count == 1 || hn::AllFalse(d, is_minified)) {
      return Sharp(u, v, zero, is_minified);
    }
    const auto last = Splat(static_cast<float>(chain_.level_count - 1));
    const auto held = hn::Min(hn::Max(level, Splat(0.0F)), last);
    if (sampler_.mip == MipFilter::nearest) {
      return Sharp(u, v, hn::ConvertTo(di, hn::Floor(hn::Min(held + Splat(0.5F), last))), is_minified);
    }
    const auto floor = hn::Floor(held);
    const auto finer = hn::ConvertTo(di, floor);
    const auto coarser = hn::Min(finer + SplatInt(1), SplatInt(chain_.level_count - 1));
    return Lerp(Sharp(u, v, finer, is_minified), Sharp(u, v, coarser, is_minified), held - floor);
  }

  // One level, each lane its own, with the sampler's filter for minified and magnified pictures.
  HWY_INLINE Texel4 Sharp(FloatVector u, FloatVector v, IntVector level, FloatMask is_minified) const {
    const FloatTag d;
    const IntTag di;
    static_assert(sizeof(MipLevel) == 3 * sizeof(std::int32_t));
    const std::int32_t* table = &chain_.levels[0].width;
    const auto entry = level + level + level;
    const auto width = hn::GatherIndex(di, table, entry);
    const auto height = hn::GatherIndex(di, table, entry + SplatInt(1));
    const auto first = hn::GatherIndex(di, table, entry + SplatInt(2));
    Taps x = FindTaps(u, width, sampler_.wrap_u);
    Taps y = FindTaps(v, height, sampler_.wrap_v);
    if (sampler_.magnify == Filter::nearest || sampler_.minify == Filter::nearest) {
      const auto all = hn::MaskFromVec(hn::BitCast(d, SplatInt(-1)));
      const auto is_nearest = sampler_.magnify == sampler_.minify  ? all
                              : sampler_.minify == Filter::nearest ? is_minified
                                                                   : hn::Not(is_minified);
      TakeNearest(x, is_nearest);
      TakeNearest(y, is_nearest);
    }
    const auto top = first + y.low * width;
    const auto bottom = first + y.high * width;
    const Texel4 above = Lerp(reader_.Read(top + x.low), reader_.Read(top + x.high), x.weight);
    const Texel4 below = Lerp(reader_.Read(bottom + x.low), reader_.Read(bottom + x.high), x.weight);
    return reader_.Scaled(Lerp(above, below, y.weight));
  }

  TexelReader<kFormat, kAlpha> reader_;
  const MipChain& chain_;
  const Sampler& sampler_;
  int anisotropy_;  // most probes along a stretched footprint, 1…16
};

// The picture's colour over the footprint, in linear light; a is 1 unless kAlpha. A call costs little beside the
// look-up, and keeps each kernel that reads textures from holding a dozen copies of this.
template <bool kAlpha>
HWY_NOINLINE Texel4 LookUp(const MipChain& chain, const Sampler& sampler, int anisotropy,
                           const Footprint& footprint) {
  switch (chain.format) {
    case TexelFormat::colour:
      return Lookup<TexelFormat::colour, kAlpha>(chain, sampler, anisotropy).Filtered(footprint);
    case TexelFormat::data:
      return Lookup<TexelFormat::data, kAlpha>(chain, sampler, anisotropy).Filtered(footprint);
    case TexelFormat::wide:
      break;
  }
  return Lookup<TexelFormat::wide, kAlpha>(chain, sampler, anisotropy).Filtered(footprint);
}

// Alpha alone, of the full-size picture, filtered as where it is magnified: what LookUp<true> gives for a footprint of
// no size.
HWY_INLINE FloatVector LookUpFullSizeAlpha(const MipChain& chain, const Sampler& sampler, FloatVector u,
                                           FloatVector v) {
  const FloatTag d;
  const IntTag di;
  if (chain.format == TexelFormat::data) {
    const auto zero = Splat(0.0F);
    return LookUp<true>(chain, sampler, 1, {u, v, zero, zero, zero, zero}).a;
  }
  if (chain.alpha.empty()) return Splat(1.0F);
  Taps x = FindTaps(u, SplatInt(chain.width()), sampler.wrap_u);
  Taps y = FindTaps(v, SplatInt(chain.height()), sampler.wrap_v);
  if (sampler.magnify == Filter::nearest) {
    const auto all = hn::MaskFromVec(hn::BitCast(d, SplatInt(-1)));
    TakeNearest(x, all);
    TakeNearest(y, all);
  }
  const auto* bytes = reinterpret_cast<const std::int32_t*>(chain.alpha.data());
  const auto number = [&](IntVector word) HWY_ATTR { return hn::ConvertTo(d, hn::And(word, SplatInt(255))); };
  const auto are_neighbours = hn::AllTrue(di, x.high == x.low + SplatInt(1));
  const auto row = [&](IntVector first) HWY_ATTR {
    // Three more bytes than texels can be read: the word that starts with a texel holds its right neighbour, too.
    const auto word = hn::GatherOffset(di, bytes, first + x.low);
    const auto left = number(word);
    const auto right = are_neighbours ? number(hn::ShiftRight<8>(word))
                                      : number(hn::GatherOffset(di, bytes, first + x.high));
    return left + (right - left) * x.weight;
  };
  const auto width = SplatInt(chain.width());
  const auto above = row(y.low * width), below = row(y.high * width);
  return (above + (below - above) * y.weight) * Splat(1.0F / 255.0F);
}

}  // namespace laterna::image::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
