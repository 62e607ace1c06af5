// Area-weighted means, and texels in their stored formats.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "image/mip_rows.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "image/mip_chain.h"
#include "image/mip_rows.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::image::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// Texels x, x + 1, … of one plane, each the mean of kColumns texels of up to three rows.
template <int kColumns>
HWY_INLINE FloatVector MeanAt(const ShrinkTask& task, std::size_t plane, std::size_t x) {
  const FloatTag d;
  auto sum = Splat(0.0F);
  for (int j = 0; j < task.row_count; ++j) {
    const auto row = static_cast<std::size_t>(j);
    const float* from = task.rows[row] + plane * task.row_stride + 2 * x;
    const auto row_weight = Splat(task.row_weights[row]);
    const auto weight = [&](std::size_t k)
                            HWY_ATTR { return hn::Load(d, task.across->weights[k].data() + x) * row_weight; };
    FloatVector even, odd;
    hn::LoadInterleaved2(d, from, even, odd);
    sum = sum + weight(0) * even;
    if constexpr (kColumns > 1) sum = sum + weight(1) * odd;
    if constexpr (kColumns > 2) {
      hn::LoadInterleaved2(d, from + 2, even, odd);
      sum = sum + weight(2) * even;
    }
  }
  return sum;
}

template <int kColumns>
void ShrinkWith(const ShrinkTask& task) {
  const std::size_t stride = plane_stride(task.width);
  for (std::size_t plane = 0; plane < static_cast<std::size_t>(task.planes); ++plane) {
    for (std::size_t x = 0; x < task.width; x += kLanes) {
      hn::Store(MeanAt<kColumns>(task, plane, x), FloatTag(), task.to + plane * stride + x);
    }
  }
}

void shrink_row(const ShrinkTask& task) {
  switch (task.across->count) {
    case 1:
      return ShrinkWith<1>(task);
    case 2:
      return ShrinkWith<2>(task);
    default:
      return ShrinkWith<3>(task);
  }
}

HWY_INLINE UintVector Quantised(FloatVector value, float largest) {
  return hn::BitCast(UintTag(), hn::ConvertTo(IntTag(), Saturate(value) * Splat(largest) + Splat(0.5F)));
}

void encode_colour(const float* planes, std::size_t width, std::uint32_t* texels) {
  const FloatTag d;
  const std::size_t stride = plane_stride(width);
  const auto root = [&](std::size_t at)
                        HWY_ATTR { return hn::Sqrt(hn::Max(hn::Load(d, planes + at), Splat(0.0F))); };
  for (std::size_t x = 0; x < width; x += kLanes) {
    const auto r = Quantised(root(x), kLargestRedGreen);
    const auto g = Quantised(root(stride + x), kLargestRedGreen);
    const auto b = Quantised(root(2 * stride + x), kLargestBlue);
    hn::Store(hn::Or(hn::Or(hn::ShiftLeft<21>(r), hn::ShiftLeft<10>(g)), b), UintTag(), texels + x);
  }
}

void encode_data(const float* planes, std::size_t width, std::uint32_t* texels) {
  const FloatTag d;
  const std::size_t stride = plane_stride(width);
  const auto byte = [&](std::size_t at) HWY_ATTR { return Quantised(hn::Load(d, planes + at), 255); };
  for (std::size_t x = 0; x < width; x += kLanes) {
    const auto low = hn::Or(byte(x), hn::ShiftLeft<8>(byte(stride + x)));
    const auto high =
        hn::Or(hn::ShiftLeft<16>(byte(2 * stride + x)), hn::ShiftLeft<24>(byte(3 * stride + x)));
    hn::Store(hn::Or(low, high), UintTag(), texels + x);
  }
}

void encode_alpha(const float* plane, std::size_t width, std::uint8_t* bytes) {
  const FloatTag d;
  const hn::Rebind<std::uint8_t, FloatTag> db;
  for (std::size_t x = 0; x < width; x += kLanes) {
    const auto codes = hn::BitCast(IntTag(), Quantised(hn::Load(d, plane + x), 255));
    hn::StoreU(hn::DemoteTo(db, codes), db, bytes + x);
  }
}

}  // namespace laterna::image::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::image {
LATERNA_KERNEL_TABLE(shrink_row)
LATERNA_KERNEL_TABLE(encode_colour)
LATERNA_KERNEL_TABLE(encode_data)
LATERNA_KERNEL_TABLE(encode_alpha)
}  // namespace laterna::image
#endif
