// Codes of 8 bits by CodeSteps: one look-up per value, whatever it is.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "image/encode_pixels.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <bit>

#include "base/vectors-inl.h"
#include "image/colour.h"
#include "image/encode_pixels.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::image::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

HWY_INLINE UintVector Codes(const std::uint32_t* steps, FloatVector value) {
  const UintTag du;
  const auto lowest = Splat(std::bit_cast<float>(CodeSteps::kLowestBits));
  const auto below_one = Splat(std::bit_cast<float>(CodeSteps::kOneBits - 1));
  // Both comparisons are false for NaN, which so becomes the lowest value.
  const auto not_low = hn::IfThenElse(value > lowest, value, lowest);
  const auto bits = hn::BitCast(du, hn::IfThenElse(not_low < below_one, not_low, below_one));
  constexpr int kShift = CodeSteps::kBucketBits;
  const auto bucket = hn::ShiftRight<kShift>(bits - hn::Set(du, CodeSteps::kLowestBits));
  const auto step = hn::GatherIndex(du, steps, hn::BitCast(IntTag(), bucket));
  return hn::ShiftRight<kShift>(step + hn::And(bits, hn::Set(du, (1U << kShift) - 1)));
}

template <bool kHasAlpha>
void EncodeWith(const LinearPixels& linear, std::size_t count, std::uint32_t* pixels) {
  const FloatTag d;
  const std::uint32_t* srgb = srgb_steps().steps();
  const std::uint32_t* straight = linear_steps().steps();
  const auto exposure = Splat(linear.exposure);
  for (std::size_t i = 0; i < count; i += kLanes) {
    const auto alpha = kHasAlpha ? hn::Load(d, linear.alpha + i) : Splat(1.0F);
    const auto codes = [&](const float* plane) HWY_ATTR {
      auto value = hn::Load(d, plane + i) * exposure;
      if constexpr (kHasAlpha) value = hn::IfThenElseZero(alpha > Splat(0.0F), value / alpha);
      return Codes(srgb, value);
    };
    auto pixel = hn::Or(hn::Or(codes(linear.r), hn::ShiftLeft<8>(codes(linear.g))),
                        hn::ShiftLeft<16>(codes(linear.b)));
    if constexpr (kHasAlpha) pixel = hn::Or(pixel, hn::ShiftLeft<24>(Codes(straight, alpha)));
    hn::Store(pixel, UintTag(), pixels + i);
  }
}

void encode_pixels(const LinearPixels& linear, std::size_t count, std::uint32_t* pixels) {
  if (linear.alpha != nullptr) {
    EncodeWith<true>(linear, count, pixels);
  } else {
    EncodeWith<false>(linear, count, pixels);
  }
}

}  // namespace laterna::image::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::image {
LATERNA_KERNEL_TABLE(encode_pixels)
}  // namespace laterna::image
#endif
