// Vectors of floats and ints as all kernels use them, and mathematics on them that is the same on every instruction
// set. Included once per target by *.simd.cc files.
#if defined(LATERNA_BASE_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_BASE_VECTORS_INL_H_
#undef LATERNA_BASE_VECTORS_INL_H_
#else
#define LATERNA_BASE_VECTORS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace laterna::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 16>;
using IntTag = hn::RebindToSigned<FloatTag>;
using UintTag = hn::RebindToUnsigned<FloatTag>;
using FloatVector = hn::Vec<FloatTag>;
using IntVector = hn::Vec<IntTag>;
using UintVector = hn::Vec<UintTag>;
using FloatMask = hn::Mask<FloatTag>;
using IntMask = hn::Mask<IntTag>;
constexpr std::size_t kLanes = hn::MaxLanes(FloatTag());

HWY_INLINE FloatVector Splat(float value) { return hn::Set(FloatTag(), value); }
HWY_INLINE IntVector SplatInt(std::int32_t value) { return hn::Set(IntTag(), value); }

// A mask as bits, lane 0 the lowest, and back.
HWY_INLINE std::uint32_t BitsOf(FloatMask mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(FloatTag(), mask, bytes);
  return bytes[0] | std::uint32_t{bytes[1]} << 8U;
}
HWY_INLINE std::uint32_t BitsOf(IntMask mask) { return BitsOf(hn::RebindMask(FloatTag(), mask)); }
HWY_INLINE FloatMask MaskFromBits(std::uint32_t bits) {
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits & 255U),
                                 static_cast<std::uint8_t>(bits >> 8U & 255U)};
  return hn::LoadMaskBits(FloatTag(), bytes);
}

// Three components of N points or directions.
struct Vector3 {
  FloatVector x, y, z;
};

HWY_INLINE Vector3 Splat3(const float* v) { return {Splat(v[0]), Splat(v[1]), Splat(v[2])}; }
HWY_INLINE Vector3 operator+(const Vector3& a, const Vector3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
HWY_INLINE Vector3 operator-(const Vector3& a, const Vector3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
HWY_INLINE Vector3 operator*(const Vector3& a, FloatVector s) { return {a.x * s, a.y * s, a.z * s}; }
HWY_INLINE FloatVector Dot(const Vector3& a, const Vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
HWY_INLINE Vector3 Cross(const Vector3& a, const Vector3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// The zero vector stays zero.
HWY_INLINE Vector3 Normalised(const Vector3& v) {
  const auto length_squared = Dot(v, v);
  const auto is_zero = length_squared <= Splat(1e-36F);
  return v * hn::IfThenZeroElse(is_zero,
                                Splat(1.0F) / hn::Sqrt(hn::IfThenElse(is_zero, Splat(1.0F), length_squared)));
}
HWY_INLINE Vector3 IfThenElse3(FloatMask mask, const Vector3& yes, const Vector3& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}

HWY_INLINE FloatVector Saturate(FloatVector v) { return hn::Min(hn::Max(v, Splat(0.0F)), Splat(1.0F)); }

// 2^x with relative error below 2e-7; x is held to [−126, 127]. The series of e^(f ln 2), |f| ≤ 1/2.
HWY_INLINE FloatVector Exponential2(FloatVector x) {
  const FloatTag d;
  const auto held = hn::Min(hn::Max(x, Splat(-126.0F)), Splat(127.0F));
  const auto whole = hn::NearestInt(held);
  const auto y = (held - hn::ConvertTo(d, whole)) * Splat(0.693147180559945F);
  auto sum = Splat(1.0F / 5040);
  sum = sum * y + Splat(1.0F / 720);
  sum = sum * y + Splat(1.0F / 120);
  sum = sum * y + Splat(1.0F / 24);
  sum = sum * y + Splat(1.0F / 6);
  sum = sum * y + Splat(0.5F);
  sum = sum * y + Splat(1.0F);
  sum = sum * y + Splat(1.0F);
  return sum * hn::BitCast(d, hn::ShiftLeft<23>(whole + SplatInt(127)));
}

// log2 of a positive normal number, absolute error below 3e-7: the exponent plus 2 atanh((m − 1) / (m + 1)) / ln 2.
HWY_INLINE FloatVector Logarithm2(FloatVector x) {
  const FloatTag d;
  const IntTag di;
  const auto bits = hn::BitCast(di, x);
  // Mantissa in [0.75, 1.5): subtracting the bits of 0.75 carries into the exponent where it should.
  const auto exponent = hn::ShiftRight<23>(bits - SplatInt(0x3F400000));
  const auto m = hn::BitCast(d, bits - hn::ShiftLeft<23>(exponent));
  const auto s = (m - Splat(1.0F)) / (m + Splat(1.0F));
  const auto z = s * s;
  auto sum = Splat(2.8853900817779268F / 9);
  sum = sum * z + Splat(2.8853900817779268F / 7);
  sum = sum * z + Splat(2.8853900817779268F / 5);
  sum = sum * z + Splat(2.8853900817779268F / 3);
  sum = sum * z + Splat(2.8853900817779268F);
  return hn::ConvertTo(d, exponent) + s * sum;
}

// base^exponent for base in [0, 1e30], 0 for base 0.
HWY_INLINE FloatVector Power(FloatVector base, FloatVector exponent) {
  const auto is_zero = base <= Splat(1e-30F);
  const auto safe = hn::IfThenElse(is_zero, Splat(1.0F), base);
  return hn::IfThenZeroElse(is_zero, Exponential2(exponent * Logarithm2(safe)));
}

// cos x with absolute error below 1e-6 + 2e-7 |x|; |x| ≤ 1e5. Whole turns are taken away in two parts, of which the first
// times the number of turns is exact up to a million; then 1 − 2 sin² x/2 by the series of the sine.
HWY_INLINE FloatVector Cosine(FloatVector x) {
  const FloatTag d;
  const auto turns = hn::ConvertTo(d, hn::NearestInt(x * Splat(0.159154943F)));
  const auto half = Splat(0.5F) * ((x - turns * Splat(6.28125F)) - turns * Splat(0.00193530718F));
  const auto z = half * half;
  auto sum = Splat(-1.0F / 39916800);
  sum = sum * z + Splat(1.0F / 362880);
  sum = sum * z - Splat(1.0F / 5040);
  sum = sum * z + Splat(1.0F / 120);
  sum = sum * z - Splat(1.0F / 6);
  const auto sine = half + half * z * sum;
  return Splat(1.0F) - Splat(2.0F) * (sine * sine);
}

}  // namespace laterna::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
