// The irregular z-buffer (Johnson et al. 2005, The irregular z-buffer; Aila and Laine 2004, Alias-free shadow maps)
// turned round: samples are not sorted into bins of the light's view, for they come in groups that are small there
// already. A batch of groups is one bundle of light. Triangles stream through it out of a tree: those that meet the
// bundle's shaft are held against the rectangles of all its groups at once, and then against the 16 samples of each
// group that they may darken. That last answer is one of signs, found in single precision with a bound on its error, and
// in double where the bound says that it may be wrong.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shadow/exact_shadow.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/vectors-inl.h"
#include "frame/surface_alpha.h"
#include "raster/triangle_bins.h"
#include "shadow/exact_shadow.h"
#include "shadow/nearest_blocker.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

static_assert(kTreeWidth == kGroupSize && kMaxGroups == kGroupSize);

// Rounding of single precision, ten times over: what a sum of three products and its factors' own rounding come to, and
// some to spare. And of double.
constexpr float kSingleError = 6e-7F;
constexpr double kDoubleError = 4e-15;

// ---------------------------------------------------------------------------------------------- axes

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

// ---------------------------------------------------------------------------------------------- a bundle

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

// ---------------------------------------------------------------------------------------------- one triangle

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

// ---------------------------------------------------------------------------------------------- a packet

// A packet's triangles, roughly: what is needed to pass by those that darken no group of a bundle. Bounds on errors are in
// it already.
struct RoughTriangles {
  // Edge functions as in EdgeFunctions, each negative only where it surely is.
  alignas(64) float x[3][kTreeWidth], y[3][kTreeWidth], c[3][kTreeWidth];
  // A point beyond the plane as the light sees it has normal · point ≥ plane; and how steeply light meets it.
  alignas(64) float normal[3][kTreeWidth], plane[kTreeWidth], facing[kTreeWidth];
};

// Rounding of single precision in a product of three differences, summed up, with sizes for lengths: 66 roundings of the
// largest product, and some to spare.
constexpr float kRoughError = 6e-6F;

HWY_INLINE FloatVector Size(const Vector3& v) {
  return hn::Max(hn::Max(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
}
HWY_INLINE Vector3 Abs3(const Vector3& v) { return {hn::Abs(v.x), hn::Abs(v.y), hn::Abs(v.z)}; }
HWY_INLINE Vector3 IfThenTurned(FloatMask turned, const Vector3& v) {
  const auto zero = Splat(0.0F);
  return {hn::IfThenElse(turned, zero - v.x, v.x), hn::IfThenElse(turned, zero - v.y, v.y),
          hn::IfThenElse(turned, zero - v.z, v.z)};
}

// Sets up lanes k and on; `corner` from the bundle's middle, in its axes. Returns those that may darken some of the bundle.
template <bool kParallel>
HWY_INLINE std::uint32_t SetUpRough(const Bundle& bundle, const Vector3* corner, std::size_t k,
                                    RoughTriangles& out) {
  const FloatTag d;
  const auto zero = Splat(0.0F);
  const Vector3 m = {Splat(static_cast<float>(bundle.centre.x)), Splat(static_cast<float>(bundle.centre.y)),
                     Splat(static_cast<float>(bundle.centre.z))};
  const auto slope_x = Splat(static_cast<float>(bundle.middle_x)),
             slope_y = Splat(static_cast<float>(bundle.middle_y));
  const auto reach = Splat(bundle.reach_x + bundle.reach_y);
  const Vector3 side[3] = {corner[2] - corner[1], corner[0] - corner[2], corner[1] - corner[0]};

  // The plane. Each component with an error of its own: of surfaces along the axes, most are nought.
  const Vector3 normal = Cross(side[1], side[2]);
  const Vector3 s = Abs3(side[1]), t = Abs3(side[2]);
  const Vector3 wrong = {s.y * t.z + s.z * t.y, s.z * t.x + s.x * t.z, s.x * t.y + s.y * t.x};
  const Vector3 at = corner[0];
  const auto few = Splat(kSingleError);
  FloatVector facing, doubt;
  if constexpr (kParallel) {
    facing = normal.x * slope_x + normal.y * slope_y + normal.z;
    doubt = few * (wrong.x + wrong.y + wrong.z);
  } else {
    const Vector3 from_light = at + m;
    facing = Dot(normal, from_light);
    doubt = few * Dot(wrong, Abs3(at) + Abs3(m));
  }
  const auto is_turned = facing < zero;
  const auto is_edge_on = hn::Abs(facing) <= doubt;
  const Vector3 outward = IfThenTurned(is_turned, normal);
  const auto room = Splat(bundle.half_of_all);
  const Vector3 size = Abs3(at);
  const auto plane_doubt =
      few * (Dot(wrong, {size.x + room, size.y + room, size.z + room}) + Dot(Abs3(normal), size));
  const auto plane = Dot(outward, at) - plane_doubt;
  const auto sure_facing = hn::Max(hn::Abs(facing) - doubt, zero);
  const auto most = hn::Abs(normal.x) * Splat(bundle.half[0]) + hn::Abs(normal.y) * Splat(bundle.half[1]) +
                    hn::Abs(normal.z) * Splat(bundle.half[2]);
  auto may = most >= plane + sure_facing * Splat(bundle.nearest_of_all);

  // The edges.
  for (int edge = 0; edge < 3; ++edge) {
    const Vector3& from = corner[(edge + 1) % 3];
    const Vector3& to = corner[(edge + 2) % 3];
    FloatVector x, y, c, bound;
    if constexpr (kParallel) {
      const auto from_x = from.x - slope_x * from.z, from_y = from.y - slope_y * from.z;
      const auto to_x = to.x - slope_x * to.z, to_y = to.y - slope_y * to.z;
      x = from_y - to_y;
      y = to_x - from_x;
      c = from_x * to_y - from_y * to_x;
      bound = Splat(kRoughError) * (Size(from) + reach) * (Size(to) + reach);
    } else {
      const Vector3 p = from + m;
      x = p.y * side[edge].z - p.z * side[edge].y;
      y = p.z * side[edge].x - p.x * side[edge].z;
      const auto per_depth = Splat(static_cast<float>(1 / bundle.centre.z));
      c = Dot(m, Cross(from, to)) * per_depth;
      bound = Splat(kRoughError) *
              (Size(p) * Size(side[edge]) * reach + Size(m) * Size(from) * Size(to) * per_depth);
    }
    x = hn::IfThenElse(is_turned, zero - x, x);
    y = hn::IfThenElse(is_turned, zero - y, y);
    c = hn::IfThenElse(is_turned, zero - c, c) + bound;
    // Which way round it is cannot be told: nothing is outside.
    c = hn::IfThenElse(is_edge_on, Splat(3e38F), c);
    x = hn::IfThenZeroElse(is_edge_on, x);
    y = hn::IfThenZeroElse(is_edge_on, y);
    hn::Store(x, d, out.x[edge] + k);
    hn::Store(y, d, out.y[edge] + k);
    hn::Store(c, d, out.c[edge] + k);
    const auto highest = hn::Max(x * Splat(bundle.low_x), x * Splat(bundle.high_x)) +
                         hn::Max(y * Splat(bundle.low_y), y * Splat(bundle.high_y)) + c;
    may = hn::And(may, highest >= zero);
  }
  hn::Store(outward.x, d, out.normal[0] + k);
  hn::Store(outward.y, d, out.normal[1] + k);
  hn::Store(outward.z, d, out.normal[2] + k);
  hn::Store(hn::IfThenElse(is_edge_on, Splat(-3e38F), plane), d, out.plane + k);
  hn::Store(hn::IfThenElse(is_edge_on, zero, sure_facing), d, out.facing + k);
  return BitsOf(hn::Or(may, is_edge_on));
}

// Groups that the triangle may darken, a bit each.
HWY_INLINE std::uint32_t GroupsBehind(const Bundle& bundle, const RoughTriangles& t, std::size_t lane) {
  const FloatTag d;
  std::uint32_t bits = 0;
  for (std::size_t g = 0; g < bundle.count; g += kLanes) {
    const auto along = [&](const float* values, float factor)
                           HWY_ATTR { return Splat(factor) * hn::Load(d, values + g); };
    auto may = along(bundle.box[0], t.normal[0][lane]) + along(bundle.box[1], t.normal[1][lane]) +
                   along(bundle.box[2], t.normal[2][lane]) +
                   along(bundle.half_box[0], std::abs(t.normal[0][lane])) +
                   along(bundle.half_box[1], std::abs(t.normal[1][lane])) +
                   along(bundle.half_box[2], std::abs(t.normal[2][lane])) >=
               Splat(t.plane[lane]) + along(bundle.nearest, t.facing[lane]);
    for (int edge = 0; edge < 3; ++edge) {
      const float x = t.x[edge][lane], y = t.y[edge][lane];
      const auto highest = along(bundle.x, x) + along(bundle.y, y) + along(bundle.half_x, std::abs(x)) +
                           along(bundle.half_y, std::abs(y)) + Splat(t.c[edge][lane]);
      may = hn::And(may, highest >= Splat(0.0F));
    }
    bits |= BitsOf(may) << g;
  }
  return bits;
}

// The same for one group and all triangles.
HWY_INLINE std::uint32_t TrianglesBefore(const Bundle& bundle, std::size_t group, const RoughTriangles& t) {
  const FloatTag d;
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < kTreeWidth; k += kLanes) {
    auto most = Splat(0.0F);
    for (int axis = 0; axis < 3; ++axis) {
      const auto normal = hn::Load(d, t.normal[axis] + k);
      most = most + (normal * Splat(bundle.box[axis][group]) +
                     hn::Abs(normal) * Splat(bundle.half_box[axis][group]));
    }
    auto may = most >= hn::Load(d, t.plane + k) + hn::Load(d, t.facing + k) * Splat(bundle.nearest[group]);
    for (int edge = 0; edge < 3; ++edge) {
      const auto x = hn::Load(d, t.x[edge] + k), y = hn::Load(d, t.y[edge] + k);
      const auto highest =
          x * Splat(bundle.x[group]) + y * Splat(bundle.y[group]) +
          (hn::Abs(x) * Splat(bundle.half_x[group]) + hn::Abs(y) * Splat(bundle.half_y[group])) +
          hn::Load(d, t.c[edge] + k);
      may = hn::And(may, highest >= Splat(0.0F));
    }
    bits |= BitsOf(may) << k;
  }
  return bits;
}

// The 16 samples of a group that do not lie beside the triangle, nor on it as their own.
HWY_INLINE std::uint32_t SamplesBehind(const SampleView& view, const TriangleId* ids, std::size_t first,
                                       const RoughTriangles& t, std::size_t lane, TriangleId id) {
  const FloatTag d;
  const IntTag di;
  std::uint32_t bits = 0;
  const auto own = SplatInt(static_cast<std::int32_t>(id));
  for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
    const std::size_t i = first + k;
    const auto x = hn::Load(d, view.x.data() + i), y = hn::Load(d, view.y.data() + i);
    const auto side = [&](int edge) HWY_ATTR {
      return Splat(t.x[edge][lane]) * x + Splat(t.y[edge][lane]) * y + Splat(t.c[edge][lane]);
    };
    const auto least = hn::Min(hn::Min(side(0), side(1)), side(2));
    const auto sample_ids = hn::Load(di, reinterpret_cast<const std::int32_t*>(ids + i));
    bits |= BitsOf(hn::AndNot(hn::RebindMask(d, sample_ids == own), least >= Splat(0.0F))) << k;
  }
  return bits;
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

// ---------------------------------------------------------------------------------------------- what darkened last

// Packets that darkened what a thread asked about just before: its next samples are probably their neighbours, and what is
// dark soon needs no more looking. A guess only, which cannot be seen in any answer.
struct RecentPackets {
  static constexpr std::size_t kMost = 4, kLights = 16;
  std::array<std::uint32_t, kMost> packets;

  static RecentPackets& of(std::size_t light) {
    thread_local std::array<RecentPackets, kLights> recent{};
    return recent[light % kLights];
  }

  [[nodiscard]] bool contains(std::uint32_t index) const {
    return std::find(packets.begin(), packets.end(), index) != packets.end();
  }
  // The latest first.
  void note(std::uint32_t index) {
    auto place = std::find(packets.begin(), packets.end() - 1, index);
    std::rotate(packets.begin(), place, place + 1);
    packets[0] = index;
  }
};

// ---------------------------------------------------------------------------------------------- the batch

template <bool kParallel>
class BatchTest {
 public:
  /// With `panes`, triangles darken nothing: where they are crossed is noted.
  BatchTest(const ExactShadowTest& test, const SurfaceSamples& samples, std::span<std::uint16_t> lit,
            std::vector<PaneCrossing>* panes)
      : test_(test), samples_(samples), lit_(lit), panes_(panes) {}

  void Run() {
    Bundle bundle;
    for (std::size_t group = 0; group < samples_.group_count; ++group) {
      if (lit_[group] != 0) bundle.group[bundle.count++] = static_cast<std::uint8_t>(group);
    }
    if (bundle.count > 0) Darken(bundle);
  }

 private:
  void Darken(Bundle& bundle) {
    Place(bundle);
    if (!bundle.is_sound) {
      DarkenApart(bundle);
      return;
    }
    if (bundle.count > 1 && IsScattered(bundle)) {
      Bundle parts[2];
      const bool is_wide = bundle.high_x - bundle.low_x >= bundle.high_y - bundle.low_y;
      const float* places = is_wide ? bundle.x : bundle.y;
      const float middle =
          is_wide ? 0.5F * (bundle.low_x + bundle.high_x) : 0.5F * (bundle.low_y + bundle.high_y);
      for (std::size_t i = 0; i < bundle.count; ++i) {
        Bundle& part = parts[places[i] < middle ? 0 : 1];
        part.group[part.count++] = bundle.group[i];
      }
      if (parts[0].count > 0 && parts[1].count > 0) {
        Darken(parts[0]);
        Darken(parts[1]);
        return;
      }
    }
    Stream(bundle);
  }

  // The groups fill little of the bundle.
  [[nodiscard]] static bool IsScattered(const Bundle& bundle) {
    float filled = 0;
    for (std::size_t i = 0; i < bundle.count; ++i) filled += bundle.half_x[i] * bundle.half_y[i];
    return (bundle.high_x - bundle.low_x) * (bundle.high_y - bundle.low_y) > 4 * kSpread * filled;
  }
  static constexpr float kSpread = 4;

  // Around the light, where no one view shows all: group by group, and then sample by sample.
  void DarkenApart(const Bundle& bundle) {
    for (std::size_t i = 0; i < bundle.count; ++i) {
      const std::size_t group = bundle.group[i];
      Bundle single;
      single.count = 1;
      single.group[0] = bundle.group[i];
      if (bundle.count > 1) {
        Darken(single);
        continue;
      }
      const std::uint32_t all = lit_[group];
      if ((all & (all - 1)) == 0) return;  // a sample at the light itself, which is lit
      std::uint32_t still_lit = 0;
      for (std::uint32_t left = all; left != 0; left &= left - 1) {
        lit_[group] = static_cast<std::uint16_t>(left & (~left + 1));
        single.count = 1;
        Darken(single);
        still_lit |= lit_[group];
      }
      lit_[group] = static_cast<std::uint16_t>(still_lit);
    }
  }

  // ------------------------------------------------------------------------------------------ placing

  void Place(Bundle& bundle) {
    const float* coordinates[3] = {samples_.x_ws.data(), samples_.y_ws.data(), samples_.z_ws.data()};
    Extremes bounds[3][kMaxGroups];
    for (int k = 0; k < 3; ++k) {
      Extremes all = {3e38F, -3e38F};
      for (std::size_t i = 0; i < bundle.count; ++i) {
        const std::size_t group = bundle.group[i];
        bounds[k][i] = ExtremesOf(coordinates[k] + group * kGroupSize, lit_[group]);
        all = {std::min(all.low, bounds[k][i].low), std::max(all.high, bounds[k][i].high)};
      }
      // In single precision, so that differences from it round only once.
      const float middle = 0.5F * all.low + 0.5F * all.high;
      bundle.centre_ws[k] = middle;
      bundle.half[k] = std::max(all.high - middle, middle - all.low);
    }
    if constexpr (kParallel) {
      bundle.axes = Axes::along(test_.light.forward_ws);
      const glm::dvec3 along = bundle.axes.of(test_.light.forward_ws);
      bundle.centre = glm::dvec3(0);
      bundle.middle_x = along.x / along.z, bundle.middle_y = along.y / along.z;
    } else {
      const glm::dvec3 from_light = bundle.centre_ws - test_.light.position_ws;
      bundle.axes = Axes::along(from_light);
      bundle.centre = bundle.axes.of(from_light);
      bundle.is_sound = bundle.centre.z > 0;
      if (!bundle.is_sound) return;
      bundle.middle_x = bundle.centre.x / bundle.centre.z,
      bundle.middle_y = bundle.centre.y / bundle.centre.z;
    }
    bundle.alive = (1U << bundle.count) - 1;
    PlaceBoxes(bundle, bounds);
    PlaceGroups(bundle);
  }

  static void PlaceBoxes(Bundle& bundle, const Extremes bounds[3][kMaxGroups]) {
    const int order[3] = {bundle.axes.x, bundle.axes.y, bundle.axes.w};
    const glm::vec3 half(bundle.half[0], bundle.half[1], bundle.half[2]);
    bundle.half_of_all = 0;
    for (int k = 0; k < 3; ++k) {
      const Extremes* along = bounds[order[k]];
      const auto centre = static_cast<float>(bundle.centre_ws[order[k]]);
      const float sign = k == 2 ? static_cast<float>(bundle.axes.sign) : 1.0F;
      bundle.half[k] = 1.00001F * half[order[k]];
      bundle.half_of_all = std::max(bundle.half_of_all, bundle.half[k]);
      for (std::size_t i = 0; i < kMaxGroups; ++i) {
        const bool is_used = i < bundle.count;
        const float low = is_used ? along[i].low - centre : 0, high = is_used ? along[i].high - centre : 0;
        bundle.box[k][i] = sign * 0.5F * (low + high);
        bundle.half_box[k][i] = 0.500001F * (high - low) + 2e-7F * (std::abs(low) + std::abs(high));
      }
    }
  }

  void PlaceGroups(Bundle& bundle) {
    constexpr float kWidest = 8;
    Extremes all_x = {3e38F, -3e38F}, all_y = all_x, all_w = all_x;
    bundle.nearest_of_all = 3e38F;
    for (std::size_t i = 0; i < bundle.count; ++i) {
      const std::size_t group = bundle.group[i];
      PlaceSamples(bundle, group * kGroupSize);
      const Extremes x = ExtremesOf(view_.x.data() + group * kGroupSize, lit_[group]);
      const Extremes y = ExtremesOf(view_.y.data() + group * kGroupSize, lit_[group]);
      const Extremes w = ExtremesOf(w_.data(), lit_[group]);
      bundle.x[i] = 0.5F * (x.low + x.high), bundle.y[i] = 0.5F * (y.low + y.high);
      // Half and a little, for the rounding of the middle.
      bundle.half_x[i] = 0.500001F * (x.high - x.low) + 1e-7F * std::abs(bundle.x[i]);
      bundle.half_y[i] = 0.500001F * (y.high - y.low) + 1e-7F * std::abs(bundle.y[i]);
      bundle.deepest[i] = w.high;
      const float nearest = ExtremesOf(near_.data(), lit_[group]).low;
      bundle.nearest[i] = kParallel ? nearest : nearest / w.high;
      bundle.nearest_of_all = std::min(bundle.nearest_of_all, bundle.nearest[i]);
      all_x = {std::min(all_x.low, x.low), std::max(all_x.high, x.high)};
      all_y = {std::min(all_y.low, y.low), std::max(all_y.high, y.high)};
      all_w = {std::min(all_w.low, w.low), std::max(all_w.high, w.high)};
    }
    for (std::size_t i = bundle.count; i < kMaxGroups; ++i) {
      bundle.x[i] = bundle.y[i] = bundle.half_x[i] = bundle.half_y[i] = bundle.nearest[i] = 0;
      bundle.deepest[i] = 0;
    }
    bundle.low_x = all_x.low, bundle.high_x = all_x.high, bundle.low_y = all_y.low,
    bundle.high_y = all_y.high;
    bundle.reach_x = 1.001F * std::max(std::abs(all_x.low), std::abs(all_x.high));
    bundle.reach_y = 1.001F * std::max(std::abs(all_y.low), std::abs(all_y.high));
    bundle.farthest = 1.001F * std::max(std::abs(all_w.low), std::abs(all_w.high));
    bundle.deepest_of_all = all_w.high;
    // Written so that what is no number is not sound either.
    bundle.is_sound = kParallel || (all_w.low > 0 && all_x.low > -kWidest && all_x.high < kWidest &&
                                    all_y.low > -kWidest && all_y.high < kWidest);
  }

  // A group's samples in the light's view. Loops over 16 lanes, which compilers make vectors of.
  void PlaceSamples(const Bundle& bundle, std::size_t first) {
    const float* coordinates[3] = {samples_.x_ws.data() + first, samples_.y_ws.data() + first,
                                   samples_.z_ws.data() + first};
    const float* xs = coordinates[bundle.axes.x];
    const float* ys = coordinates[bundle.axes.y];
    const float* ws = coordinates[bundle.axes.w];
    const glm::dvec3 origin_ws = kParallel ? bundle.centre_ws : test_.light.position_ws;
    const double origin_x = origin_ws[bundle.axes.x], origin_y = origin_ws[bundle.axes.y],
                 origin_w = origin_ws[bundle.axes.w];
    const double sign = bundle.axes.sign, middle_x = bundle.middle_x, middle_y = bundle.middle_y;
    float* x_out = view_.x.data() + first;
    float* y_out = view_.y.data() + first;
    float* w_out = w_.data();
    for (std::size_t i = 0; i < kGroupSize; ++i) {
      const double x = xs[i] - origin_x, y = ys[i] - origin_y, w = sign * (ws[i] - origin_w);
      if constexpr (kParallel) {
        x_out[i] = static_cast<float>(x - middle_x * w);
        y_out[i] = static_cast<float>(y - middle_y * w);
      } else {
        const double inverse = 1 / w;
        x_out[i] = static_cast<float>(x * inverse - middle_x);
        y_out[i] = static_cast<float>(y * inverse - middle_y);
      }
      w_out[i] = static_cast<float>(w);
    }
    FindDepths(bundle, first);
  }

  // nearest_blocker() in single precision, with what it may be wrong by, taken off the samples' depth.
  void FindDepths(const Bundle& bundle, std::size_t first) {
    const FloatTag d;
    const raster::RasterView::Ray& ray = samples_.ray;
    const auto splat = [](double value) HWY_ATTR { return Splat(static_cast<float>(value)); };
    for (std::size_t i = first; i < first + kGroupSize; i += kLanes) {
      const auto load = [&](const SampleArray<float>& values)
                            HWY_ATTR { return hn::Load(d, values.data() + i); };
      const Vector3 p = {load(samples_.x_ws), load(samples_.y_ws), load(samples_.z_ws)};
      const auto h = splat(ray.ray_0.w) + splat(ray.ray_x.w) * load(samples_.x) +
                     splat(ray.ray_y.w) * load(samples_.y) + splat(ray.q_term.w) * load(samples_.q);
      const auto reach = hn::Abs(p.x) + hn::Abs(p.y) + hn::Abs(p.z);
      auto pixel = Splat(0.0F), doubt = Splat(0.0F);
      const auto add_side = [&](const glm::dvec4& along, FloatVector dq) HWY_ATTR {
        const auto step_w = splat(along.w) + splat(ray.q_term.w) * dq;
        const Vector3 step = {splat(along.x) + splat(ray.q_term.x) * dq,
                              splat(along.y) + splat(ray.q_term.y) * dq,
                              splat(along.z) + splat(ray.q_term.z) * dq};
        const Vector3 side = step - p * step_w;
        pixel = pixel + hn::Sqrt(Dot(side, side));
        doubt = doubt + hn::Abs(step.x) + hn::Abs(step.y) + hn::Abs(step.z) + hn::Abs(step_w) * reach;
      };
      add_side(ray.ray_x, load(samples_.dq_dx));
      add_side(ray.ray_y, load(samples_.dq_dy));
      const auto per_subpixel = Splat(1.0F / raster::kSubpixels) / h;
      const auto near = Splat(2 * samples_.position_error) + pixel * per_subpixel;
      const auto wrong = near * Splat(1e-4F) + doubt * per_subpixel * Splat(kSingleError);
      // Along w: what is along the way to the light.
      FloatVector share;
      if constexpr (kParallel) {
        share = splat(std::abs(test_.light.forward_ws[bundle.axes.w]));
      } else {
        const auto x = load(view_.x) + splat(bundle.middle_x), y = load(view_.y) + splat(bundle.middle_y);
        share = Splat(1.0F) / hn::Sqrt(x * x + y * y + Splat(1.0F));
      }
      const auto w = hn::Load(d, w_.data() + (i - first));
      const auto least = hn::Max(near - wrong, Splat(0.0F));
      hn::Store(w - (near + wrong) * share, d, view_.far_sure.data() + i);
      const auto least_along = least * share * Splat(1 - 1e-6F);
      hn::Store(least_along, d, near_.data() + (i - first));
      hn::Store(w - least_along, d, view_.far_most.data() + i);
    }
  }

  // ------------------------------------------------------------------------------------------ streaming

  [[nodiscard]] Shaft ShaftOf(const Bundle& bundle) const {
    const Axes& axes = bundle.axes;
    const glm::dvec3 origin_ws = kParallel ? bundle.centre_ws : test_.light.position_ws;
    const glm::dvec3 origin = {origin_ws[axes.x], origin_ws[axes.y], origin_ws[axes.w]};
    // What rounding does to x − k w, with the origin's own: of numbers no larger than this. |k| ≤ 9.
    const double extent = 2 * (static_cast<double>(test_.tree->extent()) + Size(origin_ws));
    const double slope = kParallel ? 1.0
                                   : 1 + std::max(std::abs(bundle.middle_x) + bundle.reach_x,
                                                  std::abs(bundle.middle_y) + bundle.reach_y);
    const auto margin = static_cast<float>(kSingleError * extent * (1 + slope));
    Shaft shaft;
    for (int k = 0; k < 3; ++k) shaft.origin[k] = static_cast<float>(origin[k]);
    shaft.is_turned = axes.sign < 0;
    const auto middle_x = static_cast<float>(bundle.middle_x), middle_y = static_cast<float>(bundle.middle_y);
    if constexpr (kParallel) {
      shaft.x_low = {middle_x, bundle.low_x - margin}, shaft.x_high = {middle_x, bundle.high_x + margin};
      shaft.y_low = {middle_y, bundle.low_y - margin}, shaft.y_high = {middle_y, bundle.high_y + margin};
      shaft.w_low = -3e38F;
    } else {
      shaft.x_low = {middle_x + bundle.low_x, -margin}, shaft.x_high = {middle_x + bundle.high_x, margin};
      shaft.y_low = {middle_y + bundle.low_y, -margin}, shaft.y_high = {middle_y + bundle.high_y, margin};
      shaft.w_low = -margin;
    }
    shaft.w_high = bundle.deepest_of_all + margin;
    shaft.margin = margin;
    return shaft;
  }

  // Children of a node whose boxes meet the shaft.
  static std::uint32_t ChildrenIn(const Shaft& shaft, const Axes& axes, const CasterNode& node) {
    const FloatTag d;
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < kTreeWidth; k += kLanes) {
      const auto low_x = hn::Load(d, node.low[axes.x] + k) - Splat(shaft.origin[0]);
      const auto high_x = hn::Load(d, node.high[axes.x] + k) - Splat(shaft.origin[0]);
      const auto low_y = hn::Load(d, node.low[axes.y] + k) - Splat(shaft.origin[1]);
      const auto high_y = hn::Load(d, node.high[axes.y] + k) - Splat(shaft.origin[1]);
      auto low_w = hn::Load(d, node.low[axes.w] + k) - Splat(shaft.origin[2]);
      auto high_w = hn::Load(d, node.high[axes.w] + k) - Splat(shaft.origin[2]);
      if (shaft.is_turned) {
        const auto turned = Splat(0.0F) - low_w;
        low_w = Splat(0.0F) - high_w;
        high_w = turned;
      }
      const auto least = [&](FloatVector low, const Side& side) HWY_ATTR {
        return low - Splat(side.k) * (side.k > 0 ? high_w : low_w) <= Splat(side.c);
      };
      const auto most = [&](FloatVector high, const Side& side) HWY_ATTR {
        return high - Splat(side.k) * (side.k > 0 ? low_w : high_w) >= Splat(side.c);
      };
      auto meets = hn::And(low_w <= Splat(shaft.w_high), high_w >= Splat(shaft.w_low));
      meets = hn::And(meets, hn::And(least(low_x, shaft.x_high), most(high_x, shaft.x_low)));
      meets = hn::And(meets, hn::And(least(low_y, shaft.y_high), most(high_y, shaft.y_low)));
      bits |= BitsOf(meets) << k;
    }
    return bits;
  }

  // Groups that what is in a box may darken.
  static std::uint32_t GroupsBehindBox(const Shaft& shaft, const Bundle& bundle, const CasterNode& node,
                                       std::size_t child) {
    const FloatTag d;
    const Axes& axes = bundle.axes;
    const float low_x = node.low[axes.x][child] - shaft.origin[0],
                high_x = node.high[axes.x][child] - shaft.origin[0];
    const float low_y = node.low[axes.y][child] - shaft.origin[1],
                high_y = node.high[axes.y][child] - shaft.origin[1];
    float low_w = node.low[axes.w][child] - shaft.origin[2],
          high_w = node.high[axes.w][child] - shaft.origin[2];
    if (shaft.is_turned) {
      std::swap(low_w, high_w);
      low_w = -low_w, high_w = -high_w;
    }
    const auto margin = Splat(shaft.margin);
    const auto meets = [&](float low, float high, float middle, const float* at, const float* half,
                           std::size_t g) HWY_ATTR {
      const auto place = hn::Load(d, at + g), reach = hn::Load(d, half + g);
      if constexpr (kParallel) {
        const float slid[2] = {middle * low_w, middle * high_w};
        return hn::And(Splat(low - std::max(slid[0], slid[1])) <= place + reach + margin,
                       Splat(high - std::min(slid[0], slid[1])) >= place - reach - margin);
      } else {
        const auto k_low = Splat(middle) + (place - reach), k_high = Splat(middle) + (place + reach);
        const auto w_low = Splat(low_w), w_high = Splat(high_w);
        return hn::And(Splat(low) - hn::Max(k_high * w_low, k_high * w_high) <= margin,
                       Splat(high) - hn::Min(k_low * w_low, k_low * w_high) >= Splat(-shaft.margin));
      }
    };
    std::uint32_t bits = 0;
    for (std::size_t g = 0; g < bundle.count; g += kLanes) {
      auto may = Splat(low_w) <= hn::Load(d, bundle.deepest + g) + margin;
      may =
          hn::And(may, meets(low_x, high_x, static_cast<float>(bundle.middle_x), bundle.x, bundle.half_x, g));
      may =
          hn::And(may, meets(low_y, high_y, static_cast<float>(bundle.middle_y), bundle.y, bundle.half_y, g));
      bits |= BitsOf(may) << g;
    }
    return bits & bundle.alive;
  }

  // Triangles of a packet that may darken some of the bundle, set up in rough_.
  std::uint32_t TrianglesIn(const Bundle& bundle, const CasterPacket& packet) {
    const FloatTag d;
    const Axes& axes = bundle.axes;
    const auto origin_x = Splat(static_cast<float>(bundle.centre_ws[axes.x])),
               origin_y = Splat(static_cast<float>(bundle.centre_ws[axes.y])),
               origin_w = Splat(static_cast<float>(bundle.centre_ws[axes.w])),
               sign = Splat(static_cast<float>(axes.sign));
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < packet.count; k += kLanes) {
      Vector3 corner[3];
      for (int i = 0; i < 3; ++i) {
        const auto& at = packet.corner[i];
        corner[i] = {hn::Load(d, at[axes.x] + k) - origin_x, hn::Load(d, at[axes.y] + k) - origin_y,
                     (hn::Load(d, at[axes.w] + k) - origin_w) * sign};
      }
      bits |= SetUpRough<kParallel>(bundle, corner, k, rough_) << k;
    }
    return bits & ((1U << packet.count) - 1);
  }

  void Stream(Bundle& bundle) {
    const Shaft shaft = ShaftOf(bundle);
    RecentPackets& recent = RecentPackets::of(test_.number);
    const RecentPackets first = recent;
    for (const std::uint32_t index : first.packets) {
      // Through panes nothing is dark soon, and each is looked for once.
      if (panes_ == nullptr && index < test_.tree->packet_count()) {
        StreamPacket(bundle, index, bundle.alive, recent);
      }
    }
    if (bundle.alive == 0) return;
    std::uint32_t ahead[kMostNodesAhead];
    std::size_t count = 0;
    ahead[count++] = 0;
    while (count > 0) {
      const CasterNode& node = test_.tree->nodes()[ahead[--count]];
      for (std::uint32_t left = ChildrenIn(shaft, bundle.axes, node); left != 0; left &= left - 1) {
        const auto place = static_cast<std::size_t>(__builtin_ctz(left));
        const std::uint32_t child = node.child[place];
        if ((child & kIsPacket) == 0) {
          ahead[count++] = child;
        } else if (const std::uint32_t index = child & ~kIsPacket;
                   panes_ != nullptr || !first.contains(index)) {
          const std::uint32_t groups = GroupsBehindBox(shaft, bundle, node, place);
          if (groups == 0) continue;
          StreamPacket(bundle, index, groups, recent);
          if (bundle.alive == 0) return;
        }
      }
    }
  }

  // Of `groups`. Whichever are fewer, triangles or groups, are taken one by one, and the others 16 at a time.
  void StreamPacket(Bundle& bundle, std::uint32_t index, std::uint32_t groups, RecentPackets& recent) {
    const CasterPacket& packet = test_.tree->packets()[index];
    const std::uint32_t triangles = TrianglesIn(bundle, packet);
    bool has_darkened = false;
    if (__builtin_popcount(groups) < __builtin_popcount(triangles)) {
      for (; groups != 0; groups &= groups - 1) {
        const auto slot = static_cast<std::size_t>(__builtin_ctz(groups));
        for (std::uint32_t left = TrianglesBefore(bundle, slot, rough_) & triangles; left != 0;
             left &= left - 1) {
          has_darkened |= DarkenBy(bundle, packet, static_cast<std::size_t>(__builtin_ctz(left)), 1U << slot);
        }
      }
    } else {
      for (std::uint32_t left = triangles; left != 0; left &= left - 1) {
        const auto lane = static_cast<std::size_t>(__builtin_ctz(left));
        has_darkened |= DarkenBy(bundle, packet, lane, GroupsBehind(bundle, rough_, lane) & groups);
      }
    }
    if (has_darkened) recent.note(index);
  }

  // Returns whether it darkens any sample.
  bool DarkenBy(Bundle& bundle, const CasterPacket& packet, std::size_t lane, std::uint32_t groups) {
    const TriangleId id = packet.id[lane];
    bool is_set_up = false;
    Candidate candidate;
    bool has_darkened = false;
    for (groups &= bundle.alive; groups != 0; groups &= groups - 1) {
      const int slot = __builtin_ctz(groups);
      const std::size_t group = bundle.group[slot];
      const std::size_t first = group * kGroupSize;
      const std::uint32_t behind =
          SamplesBehind(view_, samples_.id.data(), first, rough_, lane, id) & lit_[group];
      if (behind == 0) continue;
      if (!is_set_up && !SetUp(bundle, packet, lane, candidate)) return false;
      is_set_up = true;
      const std::uint32_t dark = DarkSamples(candidate, first, behind);
      has_darkened |= dark != 0;
      lit_[group] = static_cast<std::uint16_t>(lit_[group] & ~dark);
      if (lit_[group] == 0) bundle.alive &= ~(1U << slot);
    }
    return has_darkened;
  }

  // A triangle that some sample may lie behind.
  struct Candidate {
    TriangleId id;
    CornersOfTriangle at;
    EdgeFunctions edges;
    bool needs_double;
  };

  // False where the light sees it edge-on.
  bool SetUp(const Bundle& bundle, const CasterPacket& packet, std::size_t lane, Candidate& candidate) const {
    const auto corner_ws = [&](int k) HWY_ATTR {
      return glm::vec3(packet.corner[k][0][lane], packet.corner[k][1][lane], packet.corner[k][2][lane]);
    };
    candidate.id = packet.id[lane];
    candidate.at = {corner_ws(0), corner_ws(1), corner_ws(2)};
    candidate.needs_double = panes_ != nullptr || HasHoles(candidate.id) || MayBeBeforeLight(candidate.at);
    const auto from_middle = [&](const glm::vec3& p)
                                 HWY_ATTR { return bundle.axes.of(glm::dvec3(p) - bundle.centre_ws); };
    const Corners corners = {from_middle(candidate.at.a), from_middle(candidate.at.b),
                             from_middle(candidate.at.c)};
    return kParallel ? SetUpParallel(bundle, corners, candidate.edges)
                     : SetUpPerspective(bundle, corners, candidate.edges);
  }

  // Those of the group's samples in `asked` that it darkens.
  [[nodiscard]] std::uint32_t DarkSamples(const Candidate& candidate, std::size_t first,
                                          std::uint32_t asked) const {
    Verdict verdict = TestSamples(view_, first, candidate.edges);
    if (candidate.needs_double) verdict.sure = 0;
    verdict.possible &= asked;
    std::uint32_t dark = verdict.possible & verdict.sure;
    for (std::uint32_t left = verdict.possible & ~verdict.sure; left != 0; left &= left - 1) {
      const int i = __builtin_ctz(left);
      if (IsDarkened(first + static_cast<std::size_t>(i), candidate.at, candidate.id)) dark |= 1U << i;
    }
    return dark;
  }

  // ------------------------------------------------------------------------------------------ what is decided in double

  [[nodiscard]] bool HasHoles(TriangleId id) const {
    return (test_.frame->clusters[cluster_of(id)].flags & kAlphaMask) != 0;
  }

  // Whether some of it may lie before the light's near plane.
  [[nodiscard]] bool MayBeBeforeLight(const CornersOfTriangle& t) const {
    const LightRays& light = test_.light;
    if (!light.has_near) return false;
    const auto along = [&](const glm::vec3& p)
                           HWY_ATTR { return glm::dot(glm::dvec3(p) - light.position_ws, light.forward_ws); };
    return std::min({along(t.a), along(t.b), along(t.c)}) <
           light.near * (1 + 1e-9) + 1e-9 * test_.tree->extent();
  }

  [[nodiscard]] bool IsDarkened(std::size_t i, const CornersOfTriangle& triangle, TriangleId id) const {
    const glm::vec3 position(samples_.x_ws[i], samples_.y_ws[i], samples_.z_ws[i]);
    const OnEdge on_edge = panes_ == nullptr ? OnEdge::of_both : OnEdge::of_one;
    const Crossing crossing =
        find_crossing(test_.light, position, nearest_blocker(samples_, i), triangle, on_edge);
    if (!crossing.blocks) return false;
    if (panes_ != nullptr) {
      panes_->push_back({static_cast<std::uint32_t>(i), id, crossing.b, crossing.c});
      return false;
    }
    if (!HasHoles(id)) return true;
    const frame::Surface& surface = test_.frame->surfaces[test_.frame->clusters[cluster_of(id)].material];
    return !(frame::alpha_at(*test_.frame, id, crossing.b, crossing.c) < surface.alpha_cutoff);
  }

  const ExactShadowTest& test_;
  const SurfaceSamples& samples_;
  std::span<std::uint16_t> lit_;
  std::vector<PaneCrossing>* panes_;
  SampleView view_;
  alignas(64) std::array<float, kGroupSize> w_, near_;  // of the group being placed
  RoughTriangles rough_;
};

void Run(const ExactShadowTest& test, const SurfaceSamples& samples, std::span<std::uint16_t> lit,
         std::vector<PaneCrossing>* panes) {
  if (test.tree->is_empty()) return;
  if (test.light.is_parallel) {
    BatchTest<true>(test, samples, lit, panes).Run();
  } else {
    BatchTest<false>(test, samples, lit, panes).Run();
  }
}

void keep_lit(const ExactShadowTest& test, const SurfaceSamples& samples, std::span<std::uint16_t> lit) {
  Run(test, samples, lit, nullptr);
}

void find_panes(const ExactShadowTest& test, const SurfaceSamples& samples,
                std::span<const std::uint16_t> wanted, std::vector<PaneCrossing>& crossings) {
  std::array<std::uint16_t, kMaxGroups> lit{};
  std::copy(wanted.begin(), wanted.end(), lit.begin());
  Run(test, samples, std::span(lit).first(wanted.size()), &crossings);
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shadow {
LATERNA_KERNEL_TABLE(keep_lit)
LATERNA_KERNEL_TABLE(find_panes)
}  // namespace laterna::shadow
#endif
