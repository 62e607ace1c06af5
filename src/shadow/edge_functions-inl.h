// One triangle set up in double precision, and the samples of a group held against it with a bound on every error.
#if defined(LATERNA_SHADOW_EDGE_FUNCTIONS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADOW_EDGE_FUNCTIONS_INL_H_
#undef LATERNA_SHADOW_EDGE_FUNCTIONS_INL_H_
#else
#define LATERNA_SHADOW_EDGE_FUNCTIONS_INL_H_
#endif

#include <hwy/highway.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "shadow/light_bundle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// What says whether a triangle stands between the light and a sample at (x, y): the signs of three linear functions, one
// for each edge, and its depth there, a quotient of two. Each has a bound on its error.
struct EdgeFunctions {
  float x[3], y[3], c[3], bound[3];
  float numerator_x, numerator_y, numerator_c;
  float denominator_x, denominator_y, denominator_c;
  float depth_bound;
};

struct Corners {
  glm::dvec3 a, b, c;  // from the bundle's middle, in its axes
};

// Perspective light at L, samples P, the bundle's middle M: the edge function of ab is the volume of L, P, A, B over P's
// w, det(P − L, A − L, B − L) / w. At M it is found as det(M − L, A − M, B − M), which stays exact where the light is far
// away. The triangle's depth is det(A − L, B − L, C − L) over the sum of the three. False where it is seen edge-on.
HWY_INLINE bool SetUpPerspective(const Bundle& bundle, const Corners& r, EdgeFunctions& f) {
  const glm::dvec3& m = bundle.centre;
  const glm::dvec3 side[3] = {r.c - r.b, r.a - r.c, r.b - r.a};
  const glm::dvec3 from[3] = {r.b, r.c, r.a}, to[3] = {r.c, r.a, r.b};
  const glm::dvec3 a = r.a + m;
  const double volume = -glm::dot(a, glm::cross(side[2], side[1]));
  const double volume_error = kDoubleError * Size(a) * Size(side[1]) * Size(side[2]);
  if (!(std::abs(volume) > volume_error)) return false;
  const double turn = volume < 0 ? -1 : 1;
  const double per_depth = turn / m.z;
  const double reach_x = bundle.reach_x, reach_y = bundle.reach_y;
  double sum_x = 0, sum_y = 0, sum_c = 0, sum_bound = 0;
  for (int k = 0; k < 3; ++k) {
    const glm::dvec3 p = from[k] + m;
    const double x = turn * (p.y * side[k].z - p.z * side[k].y);
    const double y = turn * (p.z * side[k].x - p.x * side[k].z);
    const double c = per_depth * glm::dot(m, glm::cross(from[k], to[k]));
    const double bound = kSingleError * (std::abs(x) * reach_x + std::abs(y) * reach_y + std::abs(c)) +
                         kDoubleError * (Size(p) * Size(side[k]) * (reach_x + reach_y + 1) +
                                         Size(m) * Size(from[k]) * Size(to[k]) * std::abs(per_depth));
    f.x[k] = static_cast<float>(x), f.y[k] = static_cast<float>(y), f.c[k] = static_cast<float>(c);
    f.bound[k] = static_cast<float>(bound);
    sum_x += x, sum_y += y, sum_c += c, sum_bound += bound;
  }
  f.numerator_x = f.numerator_y = 0;
  f.numerator_c = static_cast<float>(turn * volume);
  f.denominator_x = static_cast<float>(sum_x), f.denominator_y = static_cast<float>(sum_y);
  f.denominator_c = static_cast<float>(sum_c);
  f.depth_bound = static_cast<float>(kSingleError * std::abs(volume) + volume_error +
                                     2 * static_cast<double>(bundle.farthest) * sum_bound);
  return true;
}

// Parallel light: edge functions are areas in the plane across w, into which corners are slid along the light. Depth is
// the mean of the corners', weighted by them, over the whole area.
HWY_INLINE bool SetUpParallel(const Bundle& bundle, const Corners& r, EdgeFunctions& f) {
  const auto slide = [&](const glm::dvec3& p) HWY_ATTR {
    return glm::dvec3(p.x - bundle.middle_x * p.z, p.y - bundle.middle_y * p.z, p.z);
  };
  const glm::dvec3 corner[3] = {slide(r.a), slide(r.b), slide(r.c)};
  const glm::dvec3 ab = corner[1] - corner[0], ac = corner[2] - corner[0];
  const double area = ab.x * ac.y - ab.y * ac.x;
  if (!(std::abs(area) > kDoubleError * Size(ab) * Size(ac))) return false;
  const double turn = area < 0 ? -1 : 1;
  const double reach_x = bundle.reach_x, reach_y = bundle.reach_y;
  const double reach = reach_x + reach_y;
  double sum_x = 0, sum_y = 0, sum_c = 0, sum_bound = 0;
  for (int k = 0; k < 3; ++k) {
    const glm::dvec3& from = corner[(k + 1) % 3];
    const glm::dvec3& to = corner[(k + 2) % 3];
    const double x = turn * (from.y - to.y), y = turn * (to.x - from.x);
    const double c = turn * (from.x * to.y - from.y * to.x);
    const double bound = kSingleError * (std::abs(x) * reach_x + std::abs(y) * reach_y + std::abs(c)) +
                         kDoubleError * (Size(from) + reach) * (Size(to) + reach);
    f.x[k] = static_cast<float>(x), f.y[k] = static_cast<float>(y), f.c[k] = static_cast<float>(c);
    f.bound[k] = static_cast<float>(bound);
    const double depth = corner[k].z;
    sum_x += x * depth, sum_y += y * depth, sum_c += c * depth, sum_bound += bound * std::abs(depth);
  }
  f.numerator_x = static_cast<float>(sum_x), f.numerator_y = static_cast<float>(sum_y);
  f.numerator_c = static_cast<float>(sum_c);
  f.denominator_x = f.denominator_y = 0;
  f.denominator_c = static_cast<float>(turn * area);
  f.depth_bound = static_cast<float>(2 * sum_bound +
                                     kSingleError * static_cast<double>(bundle.farthest) * std::abs(area));
  return true;
}

struct Verdict {
  std::uint32_t possible = 0, sure = 0;
};

// The 16 samples of a group: which the triangle may darken if it is not their own, and which it then surely does.
HWY_INLINE Verdict TestSamples(const SampleView& view, std::size_t first, const EdgeFunctions& f) {
  const FloatTag d;
  Verdict verdict;
  for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
    const std::size_t i = first + k;
    const auto x = hn::Load(d, view.x.data() + i), y = hn::Load(d, view.y.data() + i);
    const auto at = [&](float along_x, float along_y, float constant)
                        HWY_ATTR { return Splat(along_x) * x + Splat(along_y) * y + Splat(constant); };
    auto is_outside = Splat(0.0F) > Splat(1.0F);
    auto is_inside = hn::Not(is_outside);
    for (int edge = 0; edge < 3; ++edge) {
      const auto value = at(f.x[edge], f.y[edge], f.c[edge]);
      is_outside = hn::Or(is_outside, value < Splat(-f.bound[edge]));
      is_inside = hn::And(is_inside, value > Splat(f.bound[edge]));
    }
    const auto numerator = at(f.numerator_x, f.numerator_y, f.numerator_c);
    const auto denominator = at(f.denominator_x, f.denominator_y, f.denominator_c);
    const auto bound = Splat(f.depth_bound);
    is_outside = hn::Or(is_outside, numerator - bound > hn::Load(d, view.far_most.data() + i) * denominator);
    is_inside = hn::And(is_inside, numerator + bound < hn::Load(d, view.far_sure.data() + i) * denominator);
    verdict.possible |= BitsOf(hn::Not(is_outside)) << k;
    verdict.sure |= BitsOf(is_inside) << k;
  }
  return verdict;
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
