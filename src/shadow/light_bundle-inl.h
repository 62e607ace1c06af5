// A batch of samples as its light sees it: a bundle of rays, and the shaft that holds them.
#if defined(LATERNA_SHADOW_LIGHT_BUNDLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADOW_LIGHT_BUNDLE_INL_H_
#undef LATERNA_SHADOW_LIGHT_BUNDLE_INL_H_
#else
#define LATERNA_SHADOW_LIGHT_BUNDLE_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

#include "base/vectors-inl.h"
#include "shadow/surface_samples.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// Rounding of single precision, ten times over: what a sum of three products and its factors' own rounding come to, and
// some to spare. And of double.
constexpr float kSingleError = 6e-7F;
constexpr double kDoubleError = 4e-15;

// Axes of the world in another order, so that light goes along +w more than along x or y: a bundle of light from a point
// is then bounded by x/w and y/w, and one of parallel light by x − w dx/dw and y − w dy/dw. Permuting rounds nothing.
struct Axes {
  int x, y, w;
  double sign;  // of w

  static Axes along(const glm::dvec3& direction) {
    const glm::dvec3 size = glm::abs(direction);
    const int w = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return {(w + 1) % 3, (w + 2) % 3, w, direction[w] < 0 ? -1.0 : 1.0};
  }
  [[nodiscard]] glm::dvec3 of(const glm::dvec3& v) const { return {v[x], v[y], sign * v[w]}; }
};

HWY_INLINE double Size(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// Samples in the light's view, x and y from the middle of the bundle. Far: how deep a triangle may lie to darken a
// sample; surely does so before `far_sure`, and cannot beyond `far_most`.
struct SampleView {
  SampleArray<float> x, y, far_sure, far_most;
};

// Some of the groups of a batch, in one view of the light.
struct Bundle {
  std::size_t count = 0;
  std::uint8_t group[kMaxGroups];
  std::uint32_t alive = 0;  // of them, a bit each: those that still have lit samples

  Axes axes;
  glm::dvec3 centre_ws;
  glm::dvec3 centre;          // from the light, in `axes`. Parallel light: zero
  double middle_x, middle_y;  // centre.x / centre.w. Parallel light: dx/dw, dy/dw
  // Of each group: middle and half of its rectangle in the light's view.
  alignas(64) float x[kMaxGroups], y[kMaxGroups], half_x[kMaxGroups], half_y[kMaxGroups], deepest[kMaxGroups];
  // Middle and half of its box, from `centre` in `axes`, and how near to its samples triangles do not count: of parallel
  // light in metres along w, else as a share of the way.
  alignas(64) float box[3][kMaxGroups], half_box[3][kMaxGroups], nearest[kMaxGroups];
  // Of all.
  float low_x, high_x, low_y, high_y, deepest_of_all, reach_x, reach_y, farthest;
  float half[3], half_of_all, nearest_of_all;
  bool is_sound;  // all samples lie before the light, and not far to the side
};

// x − k w ≤ c on one side of a shaft, ≥ c on the other.
struct Side {
  float k, c;
};
struct Shaft {
  float origin[3];  // x, y, w
  bool is_turned;   // w runs against the world's axis
  Side x_low, x_high, y_low, y_high;
  float w_low, w_high;
  float margin;  // of all of these, for rounding
};

struct Extremes {
  float low, high;
};

// Of the lanes named by `mask`, which is not 0.
HWY_INLINE Extremes ExtremesOf(const float* values, std::uint32_t mask) {
  const FloatTag d;
  auto low = Splat(3e38F), high = Splat(-3e38F);
  for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
    const auto here = MaskFromBits(mask >> k);
    const auto value = hn::Load(d, values + k);
    low = hn::Min(low, hn::IfThenElse(here, value, low));
    high = hn::Max(high, hn::IfThenElse(here, value, high));
  }
  return {hn::GetLane(hn::MinOfLanes(d, low)), hn::GetLane(hn::MaxOfLanes(d, high))};
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
