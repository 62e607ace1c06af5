// The refined filter: where the four texels about a sample do not agree, the triangles that they saw are tested exactly, by
// rays from the sample and from places about it.
#if defined(LATERNA_SHADOW_REFINEMENT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADOW_REFINEMENT_INL_H_
#undef LATERNA_SHADOW_REFINEMENT_INL_H_
#else
#define LATERNA_SHADOW_REFINEMENT_INL_H_
#endif

#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "frame/surface_alpha-inl.h"
#include "frame/triangle_corners-inl.h"
#include "shadow/depth_comparison-inl.h"
#include "shadow/map_reader-inl.h"
#include "shadow/projected_view-inl.h"
#include "shadow/shadow_map.h"
#include "shadow/surface_samples.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// What a texel saw may be the receiver's own neighbourhood if its depth is within this many texel footprints, plus
// this many texels' change along the plane, of the receiver's.
constexpr float kNearTexels = 1.0F;
constexpr float kNearSlopes = 0.5F;
// What a texel saw is not the receiver's plane if it lies this many texel footprints beyond it.
constexpr float kBeyondTexels = 0.25F;
struct FourGaps {
  FloatMask is_lit[4];  // what the texel saw stands neither before the receiver's plane nor before the sample
  FloatMask is_far[4];  // it stands before both, and is no neighbourhood
};

HWY_INLINE FourGaps FindGaps(const MapReader& reader, const Receiver& r, const Quad& quad) {
  // A side that the light does not fall on has no neighbourhood that could shade it by mistake.
  const auto neighbourhood =
      Splat(kNearTexels) * r.texel + Splat(kNearSlopes) * (hn::Abs(r.q_dx) + hn::Abs(r.q_dy));
  const auto near = r.rounding + hn::IfThenElseZero(r.faces_light, neighbourhood);
  const auto beyond = r.rounding + Splat(kBeyondTexels) * r.texel;
  FourGaps gaps;
  for (int k = 0; k < 4; ++k) {
    const int i = k & 1, j = k >> 1;
    const auto [stored, tested] = reader.DepthsAt(r, quad.column[i] + quad.row[j], quad.dx[i], quad.dy[j]);
    const auto is_outside = hn::Not(hn::And(quad.column_in[i], quad.row_in[j]));
    // On a slope the plane may pass the texel's centre nearer to the light than what stands before the sample itself,
    // or farther than what stands behind it.
    const auto is_before_sample = hn::Not(IsLit(stored, r.q, r.rounding));
    const auto is_beyond_plane = hn::Not(IsLit(tested, stored, beyond));
    const auto shades_sample = hn::And(is_before_sample, is_beyond_plane);
    gaps.is_lit[k] = hn::Or(is_outside, hn::AndNot(shades_sample, IsLit(stored, tested, r.rounding)));
    gaps.is_far[k] = hn::AndNot(is_outside, hn::AndNot(IsLit(stored, tested, near), is_before_sample));
  }
  return gaps;
}

// α where the four texels agree from afar; `unsure` where they must be asked what they saw.
struct Quick {
  FloatVector alpha;
  FloatMask unsure;
};
HWY_INLINE Quick QuickArrival(const MapReader& reader, const Points& points) {
  const Receiver r = reader.Find(points);
  const FourGaps gaps = FindGaps(reader, r, reader.FindQuad(r));
  const auto all_lit =
      hn::And(hn::And(gaps.is_lit[0], gaps.is_lit[1]), hn::And(gaps.is_lit[2], gaps.is_lit[3]));
  const auto all_far =
      hn::And(hn::And(gaps.is_far[0], gaps.is_far[1]), hn::And(gaps.is_far[2], gaps.is_far[3]));
  const auto is_covered = reader.Covers(r);
  return {hn::IfThenElse(is_covered, hn::IfThenElseZero(all_lit, Splat(1.0F)), reader.Outside()),
          hn::AndNot(hn::Or(all_lit, all_far), is_covered)};
}

// The same surfaces elsewhere in the pixel.
struct Slopes {
  FloatVector dq_dx, dq_dy;
  Vector3 dp_dx, dp_dy;  // along the surface's plane, per pixel
};

HWY_INLINE Slopes FindSlopes(const ShadowMapTest& test, const Points& p, FloatVector dq_dx,
                             FloatVector dq_dy) {
  // The point is the homogeneous ray's first three coordinates over its fourth.
  const auto h = Evaluate(test.maps[0].homogeneous, p.x, p.y, p.q);
  const auto inverse = Splat(1.0F) / h;
  const auto slope = [&](const float* ray, FloatVector dq) HWY_ATTR {
    const Vector3 numerator = Splat3(ray) + Splat3(test.q_term) * dq;
    const auto h_slope = Splat(ray[3]) + Splat(test.q_term[3]) * dq;
    return (numerator - p.position_ws * h_slope) * inverse;
  };
  return {dq_dx, dq_dy, slope(test.ray_x, dq_dx), slope(test.ray_y, dq_dy)};
}

// ---------------------------------------------------------------------------------------------- suspects

// Triangles that the four texels about N samples saw in front of them, each once. Of samples that are not `asked` for
// the texels may not be drawn yet, and hold anything.
struct Suspects {
  static constexpr int kMost = 4;
  IntVector id[kMost];            // the sample's own triangle where it has fewer
  FloatVector far_weight[kMost];  // of the texels that saw it far in front
  FloatMask is_covered;           // the map has something to say
};

HWY_INLINE Suspects FindSuspects(const MapReader& reader, const Points& points, IntVector own,
                                 FloatMask asked) {
  const FloatTag d;
  const Receiver r = reader.Find(points);
  const Quad quad = reader.FindQuad(r);
  const FourGaps gaps = FindGaps(reader, r, quad);
  const auto one = Splat(1.0F);
  Suspects suspects;
  suspects.is_covered = reader.Covers(r);
  const auto is_drawn = hn::And(asked, suspects.is_covered);
  for (int slot = 0; slot < Suspects::kMost; ++slot) {
    suspects.id[slot] = own;
    suspects.far_weight[slot] = Splat(0.0F);
  }
  for (int k = 0; k < 4; ++k) {
    const int i = k & 1, j = k >> 1;
    if (hn::AllTrue(d, gaps.is_lit[k])) continue;
    const auto index = quad.column[i] + quad.row[j];
    const auto id =
        hn::GatherIndex(IntTag(), reinterpret_cast<const std::int32_t*>(reader.map().triangles()), index);
    const auto weight =
        (i == 0 ? one - quad.weight_x : quad.weight_x) * (j == 0 ? one - quad.weight_y : quad.weight_y);
    const auto far_weight = hn::IfThenElseZero(gaps.is_far[k], weight);
    // Texels that saw nothing are lit; their id is none.
    auto homeless = hn::AndNot(hn::Or(gaps.is_lit[k], hn::RebindMask(d, id == own)), is_drawn);
    for (int slot = 0; slot <= k; ++slot) {
      const auto known = suspects.id[slot];
      const auto fits = hn::And(homeless, hn::RebindMask(d, hn::Or(known == id, known == own)));
      suspects.id[slot] = hn::IfThenElse(hn::RebindMask(IntTag(), fits), id, known);
      suspects.far_weight[slot] = suspects.far_weight[slot] + hn::IfThenElseZero(fits, far_weight);
      homeless = hn::AndNot(fits, homeless);
    }
  }
  return suspects;
}

// ---------------------------------------------------------------------------------------------- rays

// A triangle that the light sees smaller than this many texels may have neighbours that no texel saw.
constexpr float kSmallTexels = 2.0F;

// Where rays from points toward the light meet triangles.
struct Crossing {
  FloatMask meets;
  FloatVector u, v;              // weights of the second and third corner
  FloatVector distance_squared;  // from the point
  FloatMask is_small;            // seen from the light, the triangle hardly covers a texel
};

// Möller and Trumbore, Fast, minimum storage ray/triangle intersection, 1997.
template <bool kOrthographic>
HWY_INLINE Crossing FindCrossing(const BoundDepthMap& bound, const frame::HWY_NAMESPACE::CornerVectors& at,
                                 const Vector3& point) {
  const auto zero = Splat(0.0F), one = Splat(1.0F);
  // Toward the light: as far as it is, or without end.
  Vector3 ray = Splat3(bound.axis_ws);
  auto length_squared = one;
  if constexpr (!kOrthographic) {
    ray = Splat3(bound.eye_ws) - point;
    length_squared = Dot(ray, ray);
  }
  const Vector3 u_edge = at.b - at.a, v_edge = at.c - at.a;
  const Vector3 p = Cross(ray, v_edge);
  const auto determinant = Dot(u_edge, p);
  const auto is_parallel = hn::Abs(determinant) <= Splat(1e-20F);
  const auto inverse = one / hn::IfThenElse(is_parallel, one, determinant);
  const Vector3 s = point - at.a;
  const Vector3 q = Cross(s, u_edge);
  const auto t = Dot(v_edge, q) * inverse;
  Crossing crossing;
  crossing.u = Dot(s, p) * inverse;
  crossing.v = Dot(ray, q) * inverse;
  crossing.distance_squared = t * t * length_squared;
  // Edges are shared: what rounding takes from one triangle the other does not always get.
  const auto hair = Splat(-1e-6F);
  auto meets =
      hn::And(hn::And(crossing.u >= hair, crossing.v >= hair), crossing.u + crossing.v <= one - hair);
  meets = hn::And(meets, t > zero);
  if constexpr (!kOrthographic) meets = hn::And(meets, t < one);
  crossing.meets = hn::AndNot(is_parallel, meets);
  // |determinant| is twice the area across the ray, times its length. A texel there is texel_size · distance wide.
  // Orthographic: area = |determinant| / 2. Perspective: |determinant| / (2 |ray|) against (texel_size (1 − t) |ray|)².
  const auto side = kOrthographic ? Splat(bound.texel_size) : Splat(bound.texel_size) * (one - t);
  auto texel_area = side * side;
  if constexpr (!kOrthographic) texel_area = texel_area * length_squared * hn::Sqrt(length_squared);
  crossing.is_small = hn::Abs(determinant) < Splat(2 * kSmallTexels) * texel_area;
  return crossing;
}

// ---------------------------------------------------------------------------------------------- places

// The centre and four places about it, no two in one row or column. The centre casts the deciding vote: of two opposite
// places a straight edge leaves at least one on the centre's side, so it usually has the majority anyway. Where it has
// not, because what is in the way is thinner than the pixel or the surface is seen edge-on and the places lie far
// apart on it, α stays on the centre's side of one half: α ≥ 1/2 is the hard shadow at the pixel's centre.
constexpr float kPlaces[5][2] = {
    {0, 0}, {-0.125F, -0.375F}, {0.375F, -0.125F}, {-0.375F, 0.125F}, {0.125F, 0.375F}};

constexpr int kMostPlaces = 5;

// Points of N surfaces from which rays are sent, and how near a triangle may stand without counting.
struct Places {
  Vector3 position_ws[kMostPlaces];
  FloatVector near;                 // anywhere
  FloatVector beyond[kMostPlaces];  // where the centre is lit
};

HWY_INLINE Places FindPlaces(const Points& centre, const Slopes& slopes, float position_error, int count) {
  Places places;
  // Corners were snapped: at its rim a triangle may have been given samples that lie on its plane a little beside it.
  const auto pixel = hn::Sqrt(Dot(slopes.dp_dx, slopes.dp_dx)) + hn::Sqrt(Dot(slopes.dp_dy, slopes.dp_dy));
  places.near = Splat(2 * position_error) + pixel * Splat(1.0F / raster::kSubpixels);
  places.position_ws[0] = centre.position_ws;
  places.beyond[0] = places.near;
  for (int i = 1; i < count; ++i) {
    const Vector3 step = slopes.dp_dx * Splat(kPlaces[i][0]) + slopes.dp_dy * Splat(kPlaces[i][1]);
    places.position_ws[i] = centre.position_ws + step;
    // Beyond the end of its triangle the plane may run into the next one, no farther than the step. That must not
    // darken what is lit; where the centre is dark, what stands so near is what darkens it.
    places.beyond[i] = places.near + Splat(2.0F) * hn::Sqrt(Dot(step, step));
  }
  return places;
}

// What stands between the places and the light.
struct Blocking {
  FloatMask any[kMostPlaces];     // anything
  FloatMask beyond[kMostPlaces];  // anything that counts where the centre is lit
  FloatVector dark;  // weight of texels that saw something far in front and too small to be sure of
};

template <bool kOrthographic>
HWY_INLINE Blocking TestSuspects(const ShadowMapTest& test, const BoundDepthMap& bound, const Places& places,
                                 const Suspects& suspects, IntVector own) {
  const FloatTag d;
  Blocking blocking;
  const auto zero = Splat(0.0F);
  blocking.dark = zero;
  for (int i = 0; i < test.positions; ++i) blocking.any[i] = blocking.beyond[i] = zero > zero;
  for (int slot = 0; slot < Suspects::kMost; ++slot) {
    const auto wanted = hn::Not(hn::RebindMask(d, suspects.id[slot] == own));
    if (hn::AllFalse(d, wanted)) break;
    const frame::HWY_NAMESPACE::TriangleCorners<false> corners(*test.frame, suspects.id[slot]);
    const auto at = corners.Positions();
    for (int i = 0; i < test.positions; ++i) {
      const Crossing crossing = FindCrossing<kOrthographic>(bound, at, places.position_ws[i]);
      const auto far_enough = crossing.distance_squared > places.near * places.near;
      auto blocks = hn::And(hn::And(crossing.meets, far_enough), wanted);
      const frame::HWY_NAMESPACE::Weights weights = {crossing.u, crossing.v, zero, zero, zero, zero};
      blocks = hn::AndNot(frame::HWY_NAMESPACE::FindHoles(*test.frame, corners, weights, blocks), blocks);
      const auto is_beyond = crossing.distance_squared > places.beyond[i] * places.beyond[i];
      blocking.any[i] = hn::Or(blocking.any[i], blocks);
      blocking.beyond[i] = hn::Or(blocking.beyond[i], hn::And(blocks, is_beyond));
      if (i == 0) {
        blocking.dark = blocking.dark + hn::IfThenElseZero(crossing.is_small, suspects.far_weight[slot]);
      }
    }
  }
  return blocking;
}

// α of the pixel from its places'.
HWY_INLINE FloatVector MeanArrival(const Blocking& blocking, int count) {
  const auto one = Splat(1.0F);
  const auto lit = one - blocking.dark;
  const auto centre = hn::IfThenZeroElse(blocking.any[0], lit);
  if (count == 1) return centre;
  const auto share = Splat(1.0F / static_cast<float>(count));
  const int more_than_half = count / 2 + 1;
  const auto majority = Splat(static_cast<float>(more_than_half)) * share;
  const auto is_lit = centre >= Splat(0.5F);
  auto sum = centre;
  for (int i = 1; i < count; ++i) {
    const auto blocked = hn::Or(hn::And(is_lit, blocking.beyond[i]), hn::AndNot(is_lit, blocking.any[i]));
    sum = sum + hn::IfThenZeroElse(blocked, lit);
  }
  return hn::IfThenElse(is_lit, hn::Max(sum * share, majority), hn::Min(sum * share, one - majority));
}

HWY_INLINE FloatVector RefinedArrival(const ShadowMapTest& test, const SurfaceSamples& s,
                                      const Points& points, const Slopes& slopes, IntVector own) {
  const Places places = FindPlaces(points, slopes, s.position_error, test.positions);
  auto result = Splat(1.0F);
  ForEachMap(test, points, [&](const BoundDepthMap& map, const Share& share) HWY_ATTR {
    const MapReader reader(test, map, s.position_error);
    const Suspects suspects = FindSuspects(reader, points, own, share.here);
    const Blocking blocking = map.is_orthographic ? TestSuspects<true>(test, map, places, suspects, own)
                                                  : TestSuspects<false>(test, map, places, suspects, own);
    const auto alpha = MeanArrival(blocking, test.positions);
    result = LayOver(share, hn::IfThenElse(suspects.is_covered, alpha, reader.Outside()), result);
  });
  return result;
}

// ---------------------------------------------------------------------------------------------- lists

// The samples that need refinement, gathered N at a time from all groups.
class RefinementList {
 public:
  void Add(std::size_t first, FloatMask unsure, std::uint32_t wanted) {
    for (std::uint32_t mask = BitsOf(unsure) & wanted; mask != 0; mask &= mask - 1) {
      indices_[count_++] = static_cast<std::int32_t>(first) + __builtin_ctz(mask);
    }
  }

  void Refine(const ShadowMapTest& test, const SurfaceSamples& s, float* alpha) {
    const FloatTag d;
    const IntTag di;
    if (count_ == 0) return;
    for (std::size_t i = count_; i % kLanes != 0; ++i) indices_[i] = indices_[count_ - 1];
    for (std::size_t first = 0; first < count_; first += kLanes) {
      const auto index = hn::Load(di, indices_.data() + first);
      const auto read = [&](const SampleArray<float>& values)
                            HWY_ATTR { return hn::GatherIndex(d, values.data(), index); };
      const Points points = {read(s.x),
                             read(s.y),
                             read(s.q),
                             {read(s.x_ws), read(s.y_ws), read(s.z_ws)},
                             {read(s.normal_x_ws), read(s.normal_y_ws), read(s.normal_z_ws)}};
      const Slopes slopes = FindSlopes(test, points, read(s.dq_dx), read(s.dq_dy));
      const auto own = hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(s.id.data()), index);
      alignas(64) float values[kLanes];
      hn::Store(RefinedArrival(test, s, points, slopes, own), d, values);
      for (std::size_t k = 0; k < kLanes && first + k < count_; ++k) {
        alpha[static_cast<std::size_t>(indices_[first + k])] = values[k];
      }
    }
  }

 private:
  alignas(
      64) std::array<std::int32_t, kMaxSamples + kGroupSize> indices_;  // NOLINT: filled as far as it is read
  std::size_t count_ = 0;
};

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
