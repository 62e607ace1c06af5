// Means of an environment over lobes.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "image/prefilter.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "base/vectors-inl.h"
#include "image/octahedral_lookup-inl.h"
#include "image/prefilter.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::image::HWY_NAMESPACE {

// Two directions square to a unit vector and to each other (Duff et al. 2017, Building an orthonormal basis, revisited).
HWY_INLINE void FindTangents(const Vector3& n, Vector3& t, Vector3& s) {
  const auto one = Splat(1.0F);
  const auto sign = hn::CopySign(one, n.z);
  const auto a = Splat(-1.0F) / (sign + n.z);
  const auto b = n.x * n.y * a;
  t = {one + sign * n.x * n.x * a, sign * b, Splat(0.0F) - sign * n.x};
  s = {b, sign + n.y * n.y * a, Splat(0.0F) - n.y};
}

void prefilter_row(const OctahedralLevels& source, std::span<const LobeSample> lobe, std::size_t to, int y,
                   OctahedralLevels& out) {
  const FloatTag d;
  const int side = out.levels[to].side;
  const float step = 2.0F / static_cast<float>(side);
  const auto b = Splat((static_cast<float>(y) + 0.5F) * step - 1.0F);
  alignas(64) float ramp[kLanes];
  for (std::size_t i = 0; i < kLanes; ++i) ramp[i] = static_cast<float>(i);
  for (int x = 0; x < side; x += static_cast<int>(kLanes)) {
    const auto column = hn::Load(d, ramp) + Splat(static_cast<float>(x) + 0.5F);
    const auto a = hn::Min(column * Splat(step) - Splat(1.0F), Splat(1.0F));
    const Vector3 normal = DirectionOf({a, b});
    Vector3 t, s;
    FindTangents(normal, t, s);
    Vector3 sum = {Splat(0.0F), Splat(0.0F), Splat(0.0F)};
    for (const LobeSample& sample : lobe) {
      const Vector3 direction = t * Splat(sample.x) + s * Splat(sample.y) + normal * Splat(sample.z);
      const OctahedralPoint point = OctahedralPointOf(direction);
      Vector3 light = LookUpOctahedral(source, sample.level, point);
      if (sample.blend > 0) {
        const Vector3 next = LookUpOctahedral(source, sample.level + 1, point);
        light = light + (next - light) * Splat(sample.blend);
      }
      sum = sum + light * Splat(sample.weight);
    }
    alignas(64) float r[kLanes], g[kLanes], blue[kLanes];
    hn::Store(sum.x, d, r);
    hn::Store(sum.y, d, g);
    hn::Store(sum.z, d, blue);
    const auto count = std::min<std::size_t>(kLanes, static_cast<std::size_t>(side - x));
    const std::size_t first = out.index(to, x, y);
    std::copy_n(r, count, out.r.data() + first);
    std::copy_n(g, count, out.g.data() + first);
    std::copy_n(blue, count, out.b.data() + first);
  }
}

}  // namespace laterna::image::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::image {
LATERNA_KERNEL_TABLE(prefilter_row)
}  // namespace laterna::image
#endif
