// The refined filter: where the four texels about a sample do not agree, the triangles that they saw are tested exactly, by
// rays from the sample and from places about it.
#if defined(LATERNA_SHADOW_REFINEMENT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADOW_REFINEMENT_INL_H_
#undef LATERNA_SHADOW_REFINEMENT_INL_H_
#else
#define LATERNA_SHADOW_REFINEMENT_INL_H_
#endif

#include <hwy/highway.h>

#include "base/record_gather-inl.h"
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
  FloatMask is_far[4];  // it stands before both, and is the neighbourhood of neither
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
    // Where the light only grazes the plane, that runs far from the sample within a texel.
    const auto is_near = hn::Or(IsLit(stored, tested, near), IsLit(stored, r.q, near));
    gaps.is_far[k] = hn::Not(hn::Or(is_outside, is_near));
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

// Light grazes a surface where the cosine between its normal and the light is less than this.
constexpr float kGrazingCosine = 0.01F;
// Nearer than this many texel footprints a ray that grazes a surface may still be leaving it.
constexpr float kBesideTexels = 1.0F;

// Where rays from points toward the light meet triangles.
struct Crossing {
  FloatMask meets;
  FloatMask is_apart;            // the points lie off the triangles' planes
  FloatMask is_parallel;         // to the triangle: the weights mean nothing
  FloatMask is_behind;           // the triangle's plane is met on the way from the light, not toward it
  FloatVector u, v;              // weights of the second and third corner
  FloatVector distance_squared;  // from the point
  FloatMask is_small;            // seen from the light, the triangle hardly covers a texel
};

// Rays toward the light against N triangles. Möller and Trumbore, Fast, minimum storage ray/triangle intersection, 1997.
template <bool kOrthographic>
class RayTest {
 public:
  HWY_INLINE RayTest(const BoundDepthMap& bound, const frame::HWY_NAMESPACE::CornerVectors& at)
      : bound_(bound), a_(at.a), u_edge_(at.b - at.a), v_edge_(at.c - at.a) {
    const Vector3 normal = Cross(u_edge_, v_edge_);
    normal_length_ = hn::Sqrt(Dot(normal, normal));
    if constexpr (kOrthographic) parallel_ = FindBundle(Splat3(bound.axis_ws), Splat(1.0F));
  }

  // `error`: of the points' places. Less far from a triangle's plane a point may lie on it, for all that is known; a ray
  // along that plane would meet the triangle anywhere.
  HWY_INLINE Crossing From(const Vector3& point, float error, FloatMask is_grazing) const {
    const auto zero = Splat(0.0F), one = Splat(1.0F);
    // Toward the light: as far as it is, or without end.
    Bundle rays;
    if constexpr (kOrthographic) {
      rays = parallel_;
    } else {
      const Vector3 ray = Splat3(bound_.eye_ws) - point;
      rays = FindBundle(ray, Dot(ray, ray));
    }
    const Vector3 s = point - a_;
    const Vector3 q = Cross(s, u_edge_);
    const auto volume = Dot(v_edge_, q);
    const auto t = volume * rays.inverse;
    Crossing crossing;
    crossing.is_parallel = rays.is_parallel;
    crossing.is_behind = hn::AndNot(rays.is_parallel, t <= zero);
    crossing.is_apart = hn::Abs(volume) > Splat(error) * normal_length_;
    crossing.u = Dot(s, rays.p) * rays.inverse;
    crossing.v = Dot(rays.direction, q) * rays.inverse;
    crossing.distance_squared = t * t * rays.length_squared;
    // Edges are shared: what rounding takes from one triangle the other does not always get.
    auto hair = Splat(-1e-6F);
    // But a ray along its own surface must not be stopped by the edge over which it leaves it.
    const auto beside = Splat(kBesideTexels * bound_.texel_size);
    const auto is_beside = crossing.distance_squared < beside * beside * rays.length_squared;
    hair = hn::IfThenElse(hn::And(is_grazing, is_beside), Splat(1e-5F), hair);
    auto meets =
        hn::And(hn::And(crossing.u >= hair, crossing.v >= hair), crossing.u + crossing.v <= one - hair);
    meets = hn::And(meets, t > zero);
    if constexpr (!kOrthographic) meets = hn::And(meets, t < one);
    crossing.meets = hn::AndNot(rays.is_parallel, meets);
    // |determinant| is twice the area across the ray, times its length. A texel there is texel_size · distance wide.
    // Orthographic: area = |determinant| / 2. Perspective: |determinant| / (2 |ray|) against (texel_size (1 − t) |ray|)².
    const auto side = kOrthographic ? Splat(bound_.texel_size) : Splat(bound_.texel_size) * (one - t);
    auto texel_area = side * side;
    if constexpr (!kOrthographic)
      texel_area = texel_area * rays.length_squared * hn::Sqrt(rays.length_squared);
    crossing.is_small = hn::Abs(rays.determinant) < Splat(2 * kSmallTexels) * texel_area;
    return crossing;
  }

 private:
  // What depends on the rays' direction alone.
  struct Bundle {
    Vector3 direction;
    FloatVector length_squared;
    Vector3 p;
    FloatVector determinant, inverse;
    FloatMask is_parallel;
  };
  HWY_INLINE Bundle FindBundle(const Vector3& direction, FloatVector length_squared) const {
    const auto one = Splat(1.0F);
    Bundle rays;
    rays.direction = direction;
    rays.length_squared = length_squared;
    rays.p = Cross(direction, v_edge_);
    rays.determinant = Dot(u_edge_, rays.p);
    rays.is_parallel = hn::Abs(rays.determinant) <= Splat(1e-20F);
    rays.inverse = one / hn::IfThenElse(rays.is_parallel, one, rays.determinant);
    return rays;
  }

  const BoundDepthMap& bound_;
  Vector3 a_, u_edge_, v_edge_;
  FloatVector normal_length_;
  Bundle parallel_{};  // orthographic
};

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
  float error;                      // of the positions
  FloatMask is_grazing;             // the light of this map hardly falls on the surface
  FloatVector near;                 // anywhere
  FloatVector beyond[kMostPlaces];  // where the centre is lit
};

HWY_INLINE Places FindPlaces(const Points& centre, const Slopes& slopes, float position_error, int count) {
  Places places;
  // Corners were snapped: at its rim a triangle may have been given samples that lie on its plane a little beside it.
  const auto pixel = hn::Sqrt(Dot(slopes.dp_dx, slopes.dp_dx)) + hn::Sqrt(Dot(slopes.dp_dy, slopes.dp_dy));
  places.error = position_error;
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

// From a suspect that the ray misses, so many steps are made at most. Where triangles are so much smaller than texels
// that these do not lead to the ray, what the texels saw decides.
constexpr int kMostSteps = 8;

// N walks over surfaces, each from a suspect toward the ray: from triangle to triangle, always across the edge beyond
// which the ray passes the plane.
class Walk {
 public:
  Walk(const ShadowMapTest& test, IntVector start, IntVector own, FloatMask wanted)
      : neighbours_(*test.neighbours), own_(own), id_(start), from_(start), walks_(wanted) {}

  [[nodiscard]] IntVector id() const { return id_; }
  [[nodiscard]] FloatMask walks() const { return walks_; }
  // Walks that ended where the surface does not go on toward the ray, or at the ray.
  [[nodiscard]] FloatMask is_settled() const { return is_settled_; }
  // Of those, the ones that came to the sample's own triangle.
  [[nodiscard]] FloatMask is_home() const { return is_home_; }

  // Goes on from the present triangles, which the rays meet at `crossing`; false: none does.
  HWY_INLINE bool Step(const Crossing& crossing, FloatMask is_blocked) {
    const FloatTag d;
    const auto zero = Splat(0.0F);
    walks_ = hn::AndNot(hn::Or(is_blocked, crossing.is_parallel), walks_);
    if (hn::AllFalse(d, walks_)) return false;
    const Edges edges = FindEdges();
    // Beyond edge k the corner opposite to it has a negative weight.
    const FloatVector weights[3] = {hn::IfThenElse(edges.is_mirrored, crossing.u, crossing.v),
                                    Splat(1.0F) - crossing.u - crossing.v,
                                    hn::IfThenElse(edges.is_mirrored, crossing.v, crossing.u)};
    auto lowest = zero;
    auto next = id_;
    auto is_open = zero > zero;
    for (int k = 0; k < 3; ++k) {
      const auto is_beyond = weights[k] < zero;
      const auto leads_nowhere = SameTriangle(edges.across[k], id_);
      is_open = hn::Or(is_open, hn::And(is_beyond, leads_nowhere));
      // Where the surface folds back, the way on is the way back.
      const auto leads_back = SameTriangle(edges.across[k], from_);
      const auto is_better = hn::AndNot(hn::Or(leads_nowhere, leads_back), weights[k] < lowest);
      lowest = hn::IfThenElse(is_better, weights[k], lowest);
      next = hn::IfThenElse(hn::RebindMask(IntTag(), is_better), edges.across[k], next);
    }
    const auto has_next = lowest < zero;
    const auto arrives_home = hn::And(has_next, SameTriangle(next, own_));
    is_home_ = hn::Or(is_home_, hn::And(walks_, arrives_home));
    const auto ends_well = hn::Or(arrives_home, hn::AndNot(hn::Or(has_next, is_open), walks_));
    is_settled_ = hn::Or(is_settled_, hn::And(walks_, ends_well));
    walks_ = hn::AndNot(arrives_home, hn::And(walks_, has_next));
    from_ = id_;
    id_ = hn::IfThenElse(hn::RebindMask(IntTag(), walks_), next, id_);
    return !hn::AllFalse(d, walks_);
  }

 private:
  struct Edges {
    IntVector across[3];  // the triangle itself where there is none
    FloatMask is_mirrored;
  };

  static FloatMask SameTriangle(IntVector a, IntVector b) { return hn::RebindMask(FloatTag(), a == b); }

  HWY_INLINE Edges FindEdges() const {
    const IntTag di;
    const auto cluster = hn::BitCast(di, hn::ShiftRight<kTriangleBits>(hn::BitCast(UintTag(), id_)));
    const auto source = hn::GatherIndex(di, neighbours_.sources.data(), cluster);
    const auto in_cluster = hn::And(id_, SplatInt(kTrianglesPerCluster - 1));
    const auto triangle = hn::ShiftLeft<kTriangleBits>(hn::ShiftRight<1>(source)) + in_cluster;
    const auto steps = GatherRecords(neighbours_.meshes->steps.data(), triangle);
    const auto is_mirrored = hn::RebindMask(FloatTag(), hn::And(source, SplatInt(1)) != hn::Zero(di));
    return {{id_ + steps.x, id_ + steps.y, id_ + steps.z}, is_mirrored};
  }

  const frame::TriangleNeighbours& neighbours_;
  IntVector own_, id_, from_;
  FloatMask walks_;
  FloatMask is_settled_ = Splat(0.0F) > Splat(0.0F);
  FloatMask is_home_ = is_settled_;
};

// Adds triangles that stand between the light and places [first, end); returns how the ray of the first meets them.
template <bool kOrthographic>
HWY_INLINE Crossing TestTriangles(const ShadowMapTest& test, const BoundDepthMap& bound, const Places& places,
                                  int first, int end, IntVector id, FloatMask wanted, Blocking& blocking) {
  const FloatTag d;
  const auto zero = Splat(0.0F);
  const frame::HWY_NAMESPACE::TriangleCorners<false> corners(*test.frame, id);
  const RayTest<kOrthographic> rays(bound, corners.Positions());
  Crossing of_first;
  for (int i = first; i < end; ++i) {
    const Crossing crossing = rays.From(places.position_ws[i], places.error, places.is_grazing);
    if (i == first) of_first = crossing;
    const auto far_enough = crossing.distance_squared > places.near * places.near;
    auto blocks = hn::And(hn::And(crossing.meets, hn::And(crossing.is_apart, far_enough)), wanted);
    if (hn::AllFalse(d, blocks)) continue;
    const frame::HWY_NAMESPACE::Weights weights = {crossing.u, crossing.v, zero, zero, zero, zero};
    blocks = hn::AndNot(frame::HWY_NAMESPACE::FindHoles(*test.frame, corners, weights, blocks), blocks);
    const auto is_beyond = crossing.distance_squared > places.beyond[i] * places.beyond[i];
    blocking.any[i] = hn::Or(blocking.any[i], blocks);
    blocking.beyond[i] = hn::Or(blocking.beyond[i], hn::And(blocks, is_beyond));
  }
  return of_first;
}

// Looks on from suspects that the centre's ray missed at `crossing`. The other places are tested with the triangle where
// the walk ends: what blocks the centre, or comes nearest to it. Returns which walks were settled.
template <bool kOrthographic>
HWY_INLINE FloatMask TestBeyondSuspects(const ShadowMapTest& test, const BoundDepthMap& bound,
                                        const Places& places, Walk walk, Crossing crossing,
                                        Blocking& blocking) {
  const FloatTag d;
  auto has_walked = Splat(0.0F) > Splat(0.0F);
  for (int step = 0; step < kMostSteps && walk.Step(crossing, blocking.any[0]); ++step) {
    has_walked = hn::Or(has_walked, walk.walks());
    crossing = TestTriangles<kOrthographic>(test, bound, places, 0, 1, walk.id(), walk.walks(), blocking);
  }
  if (test.positions > 1 && !hn::AllFalse(d, has_walked)) {
    TestTriangles<kOrthographic>(test, bound, places, 1, test.positions, walk.id(), has_walked, blocking);
  }
  return walk.is_settled();
}

template <bool kOrthographic>
HWY_INLINE Blocking TestSuspects(const ShadowMapTest& test, const BoundDepthMap& bound, const Places& places,
                                 const Suspects& suspects, IntVector own) {
  const FloatTag d;
  Blocking blocking;
  const auto zero = Splat(0.0F);
  blocking.dark = zero;
  for (int i = 0; i < test.positions; ++i) blocking.any[i] = blocking.beyond[i] = zero > zero;
  for (int slot = 0; slot < Suspects::kMost; ++slot) {
    const IntVector id = suspects.id[slot];
    const auto wanted = hn::Not(hn::RebindMask(d, id == own));
    if (hn::AllFalse(d, wanted)) break;
    const Crossing crossing =
        TestTriangles<kOrthographic>(test, bound, places, 0, test.positions, id, wanted, blocking);
    auto is_settled = hn::Not(crossing.is_small);
    if (test.neighbours != nullptr) {
      const Walk walk(test, id, own, wanted);
      is_settled = hn::Or(is_settled,
                          TestBeyondSuspects<kOrthographic>(test, bound, places, walk, crossing, blocking));
    }
    blocking.dark = blocking.dark + hn::IfThenZeroElse(is_settled, suspects.far_weight[slot]);
  }
  return blocking;
}

// Samples that a first look tells to be lit, as it does most: the centre's ray passes beside every suspect, and what lies next
// to that on the surface toward the ray is the sample's own triangle; or it leaves the suspect, which no texel saw far in
// front, behind: the light falls on a fold from within.
template <bool kOrthographic>
HWY_INLINE FloatMask AreLeftBehind(const ShadowMapTest& test, const BoundDepthMap& bound,
                                   const Points& points, float position_error, const Suspects& suspects,
                                   IntVector own) {
  const FloatTag d;
  const auto none = Splat(0.0F) > Splat(0.0F);
  auto are_left = suspects.is_covered;
  for (int slot = 0; slot < Suspects::kMost; ++slot) {
    const IntVector id = suspects.id[slot];
    const auto wanted = hn::AndNot(hn::RebindMask(d, id == own), are_left);
    if (hn::AllFalse(d, wanted)) break;
    const frame::HWY_NAMESPACE::TriangleCorners<false> corners(*test.frame, id);
    const Crossing crossing =
        RayTest<kOrthographic>(bound, corners.Positions()).From(points.position_ws, position_error, none);
    auto is_left = hn::And(crossing.is_behind, suspects.far_weight[slot] == Splat(0.0F));
    if (test.neighbours != nullptr) {
      Walk walk(test, id, own, wanted);
      walk.Step(crossing, none);
      is_left = hn::Or(is_left, walk.is_home());
    }
    are_left = hn::AndNot(hn::AndNot(is_left, wanted), are_left);
  }
  return are_left;
}

// α of the pixel from its places'. A side that the light does not fall on is darkened by the body whose side it is. Where
// that is finely cut, rays from other places leave it through triangles that the centre's walk has not met: where its
// centre is dark, such a side is.
HWY_INLINE FloatVector MeanArrival(const Blocking& blocking, FloatMask faces_light, int count) {
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
  const auto mean =
      hn::IfThenElse(is_lit, hn::Max(sum * share, majority), hn::Min(sum * share, one - majority));
  return hn::IfThenElse(hn::Or(faces_light, is_lit), mean, centre);
}

// How the light of a map falls on surfaces.
struct Incidence {
  FloatMask is_grazing;   // along them
  FloatMask faces_light;  // on the side that is seen
};
HWY_INLINE Incidence FindIncidence(const BoundDepthMap& bound, const Points& points) {
  Vector3 ray = Splat3(bound.axis_ws);
  if (!bound.is_orthographic) ray = Splat3(bound.eye_ws) - points.position_ws;
  const auto limit = Splat(kGrazingCosine) * hn::Sqrt(Dot(ray, ray));
  const auto along_normal = Dot(points.normal_ws, ray);
  return {hn::Abs(along_normal) < limit, along_normal > Splat(0.0F)};
}

HWY_INLINE FloatVector RefinedArrival(const ShadowMapTest& test, const SurfaceSamples& s,
                                      const Points& points, const Slopes& slopes, IntVector own) {
  Places places = FindPlaces(points, slopes, s.position_error, test.positions);
  auto result = Splat(1.0F);
  ForEachMap(test, points, [&](const BoundDepthMap& map, const Share& share) HWY_ATTR {
    const MapReader reader(test, map, s.position_error);
    const Suspects suspects = FindSuspects(reader, points, own, share.here);
    const Incidence incidence = FindIncidence(map, points);
    places.is_grazing = incidence.is_grazing;
    const Blocking blocking = map.is_orthographic ? TestSuspects<true>(test, map, places, suspects, own)
                                                  : TestSuspects<false>(test, map, places, suspects, own);
    const auto alpha = MeanArrival(blocking, incidence.faces_light, test.positions);
    result = LayOver(share, hn::IfThenElse(suspects.is_covered, alpha, reader.Outside()), result);
  });
  return result;
}

// Samples that are lit for all that a first look at every map tells.
HWY_INLINE FloatMask AreLitAtFirstLook(const ShadowMapTest& test, const SurfaceSamples& s,
                                       const Points& points, IntVector own) {
  auto are_lit = Splat(0.0F) <= Splat(0.0F);
  ForEachMap(test, points, [&](const BoundDepthMap& map, const Share& share) HWY_ATTR {
    const Suspects suspects = FindSuspects(MapReader(test, map, s.position_error), points, own, share.here);
    const auto are_left = map.is_orthographic
                              ? AreLeftBehind<true>(test, map, points, s.position_error, suspects, own)
                              : AreLeftBehind<false>(test, map, points, s.position_error, suspects, own);
    are_lit = hn::AndNot(hn::AndNot(are_left, share.here), are_lit);
  });
  return are_lit;
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
    LeaveLit(test, s, alpha);
    const FloatTag d;
    ForEachVector([&](std::size_t first, IntVector index) HWY_ATTR {
      const Points points = PointsAt(s, index);
      const Slopes slopes = FindSlopes(test, points, At(s.dq_dx, index), At(s.dq_dy, index));
      alignas(64) float values[kLanes];
      hn::Store(RefinedArrival(test, s, points, slopes, OwnAt(s, index)), d, values);
      for (std::size_t k = 0; k < kLanes && first + k < count_; ++k) {
        alpha[static_cast<std::size_t>(indices_[first + k])] = values[k];
      }
    });
  }

 private:
  // Those that a first look tells to be lit leave the list: what remains fills whole vectors.
  void LeaveLit(const ShadowMapTest& test, const SurfaceSamples& s, float* alpha) {
    std::size_t left = 0;
    ForEachVector([&](std::size_t first, IntVector index) HWY_ATTR {
      const std::uint32_t lit = BitsOf(AreLitAtFirstLook(test, s, PointsAt(s, index), OwnAt(s, index)));
      for (std::size_t k = 0; k < kLanes && first + k < count_; ++k) {
        const std::int32_t sample = indices_[first + k];
        if ((lit >> k & 1U) != 0) {
          alpha[static_cast<std::size_t>(sample)] = 1;
        } else {
          indices_[left++] = sample;
        }
      }
    });
    count_ = left;
  }

  template <class Visit>
  HWY_INLINE void ForEachVector(const Visit& visit) {
    if (count_ == 0) return;
    for (std::size_t i = count_; i % kLanes != 0; ++i) indices_[i] = indices_[count_ - 1];
    for (std::size_t first = 0; first < count_; first += kLanes)
      visit(first, hn::Load(IntTag(), indices_.data() + first));
  }

  static HWY_INLINE FloatVector At(const SampleArray<float>& values, IntVector index) {
    return hn::GatherIndex(FloatTag(), values.data(), index);
  }
  static HWY_INLINE IntVector OwnAt(const SurfaceSamples& s, IntVector index) {
    return hn::GatherIndex(IntTag(), reinterpret_cast<const std::int32_t*>(s.id.data()), index);
  }
  static HWY_INLINE Points PointsAt(const SurfaceSamples& s, IntVector index) {
    return {At(s.x, index),
            At(s.y, index),
            At(s.q, index),
            {At(s.x_ws, index), At(s.y_ws, index), At(s.z_ws, index)},
            {At(s.normal_x_ws, index), At(s.normal_y_ws, index), At(s.normal_z_ws, index)}};
  }

  alignas(
      64) std::array<std::int32_t, kMaxSamples + kGroupSize> indices_;  // NOLINT: filled as far as it is read
  std::size_t count_ = 0;
};

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
