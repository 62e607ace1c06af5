// Look-ups into depth maps.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shadow/shadow_map.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "base/vectors-inl.h"
#include "frame/surface_alpha-inl.h"
#include "frame/triangle_corners-inl.h"
#include "shadow/depth_comparison-inl.h"
#include "shadow/depth_comparison.h"
#include "shadow/projected_view-inl.h"
#include "shadow/shadow_map.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// N samples.
struct Points {
  FloatVector x, y, q;
  Vector3 position_ws, normal_ws;
};

// The same surfaces elsewhere in the pixel.
struct Slopes {
  FloatVector dq_dx, dq_dy;
  Vector3 dp_dx, dp_dy;  // along the surface's plane, per pixel
};

// Samples as one depth map sees them.
struct Receiver {
  FloatVector x, y;        // texels from the map's top-left corner
  FloatVector q;           // reversed depth
  FloatVector q_dx, q_dy;  // along the receiver's plane, per texel; 0 without a receiver plane
  FloatVector rounding;    // in reversed depth: what arithmetic may have lost
  FloatVector texel;       // the footprint of a texel, as reversed depth
  FloatMask faces_light;   // the side of the surface that is seen is the one the light falls on
  FloatMask is_seen;       // in front of the light and nearer than far
};

// Where texel column or row i of a map starts, in DepthMap's layout; the two parts of an index are added.
HWY_INLINE IntVector ColumnPart(IntVector i) {
  return hn::ShiftLeft<2 * raster::kTileBits>(hn::ShiftRight<raster::kTileBits>(i)) +
         hn::ShiftLeft<4>(hn::And(hn::ShiftRight<2>(i), SplatInt(raster::kBlocksPerSide - 1))) +
         hn::And(i, SplatInt(raster::kBlockSide - 1));
}
HWY_INLINE IntVector RowPart(IntVector j, std::int32_t tiles_x) {
  return hn::ShiftRight<raster::kTileBits>(j) * SplatInt(tiles_x * raster::kTilePixels) +
         hn::ShiftLeft<8>(hn::And(hn::ShiftRight<2>(j), SplatInt(raster::kBlocksPerSide - 1))) +
         hn::ShiftLeft<2>(hn::And(j, SplatInt(raster::kBlockSide - 1)));
}

// The four texels around a sample.
struct Quad {
  IntVector column[2], row[2];  // parts of the texels' indices
  FloatMask column_in[2], row_in[2];
  FloatVector dx[2], dy[2];        // from the sample to the texels' centres
  FloatVector weight_x, weight_y;  // of the second column and row
};

// What single precision may lose of a depth, stored and tested together, as a share of it: a little over four times
// 2⁻²³. 1 cm at 9 km is more (row 24).
constexpr float kDepthRounding = 5e-7F;

class MapReader {
 public:
  MapReader(const ShadowMapTest& test, const BoundDepthMap& bound, float position_error)
      : test_(test), bound_(bound), map_(*bound.map), position_error_(position_error) {}

  HWY_INLINE Receiver Find(const Points& p) const {
    const auto X = Evaluate(bound_.position.x, p.x, p.y, p.q), Y = Evaluate(bound_.position.y, p.x, p.y, p.q);
    const auto W = Evaluate(bound_.position.divisor, p.x, p.y, p.q),
               h = Evaluate(bound_.homogeneous, p.x, p.y, p.q);
    const raster::RasterView& view = map_.view();
    const auto origin_x = Splat(static_cast<float>(view.origin_x)),
               origin_y = Splat(static_cast<float>(view.origin_y));
    const auto error = Splat(position_error_);
    const auto far = Splat(view.reversed_far);
    Receiver r;
    FloatVector plane_divisor;
    if (bound_.is_orthographic) {
      const auto inverse = Splat(1.0F) / h;
      r.x = X * inverse + origin_x;
      r.y = Y * inverse + origin_y;
      r.q = W * inverse;
      r.is_seen = r.q >= far;
      // Points of the plane: direction(x, y) + q axis, so n·direction + q n·axis is constant.
      plane_divisor = hn::Neg(Dot(p.normal_ws, Splat3(bound_.axis_ws)));
      r.texel = Splat(bound_.texel_size);
      r.rounding = error;
    } else {
      // Nothing behind the light is seen by it (row 58). The smallest divisor still has a finite inverse.
      const auto is_ahead = W > h * Splat(1e-6F);
      const auto inverse = Splat(1.0F) / hn::IfThenElse(is_ahead, W, h);
      r.x = X * inverse + origin_x;
      r.y = Y * inverse + origin_y;
      r.q = h * inverse;
      r.is_seen = hn::And(is_ahead, r.q >= far);
      plane_divisor = Dot(p.normal_ws, p.position_ws - Splat3(bound_.eye_ws));
      // t metres at reversed depth q are t q² of reversed depth; a texel is texel_size / q metres wide.
      r.texel = Splat(bound_.texel_size) * r.q;
      r.rounding = error * r.q * r.q;
    }
    r.rounding = r.rounding + Splat(kDepthRounding) * hn::Abs(r.q);
    r.faces_light = plane_divisor < Splat(0.0F);
    // A plane seen edge-on has no slope to speak of; its lit and dark sides meet in one texel.
    const auto is_edge_on = hn::Abs(plane_divisor) <= Splat(1e-9F);
    const auto inverse_divisor = Splat(1.0F) / hn::IfThenElse(is_edge_on, Splat(1.0F), plane_divisor);
    r.q_dx =
        hn::IfThenZeroElse(is_edge_on, Dot(p.normal_ws, Splat3(bound_.direction_x_ws)) * inverse_divisor);
    r.q_dy =
        hn::IfThenZeroElse(is_edge_on, Dot(p.normal_ws, Splat3(bound_.direction_y_ws)) * inverse_divisor);
    return r;
  }

  // α of plain filters.
  HWY_INLINE FloatVector Arrival(Receiver r) const {
    // Back sides are in the shadow of their own front, if of anything: there is no self-shadowing to prevent.
    const ShadowBias& b = test_.bias;
    const auto slope = hn::Abs(r.q_dx) + hn::Abs(r.q_dy);
    const auto metres = Splat(b.metres) * (bound_.is_orthographic ? Splat(1.0F) : r.q * r.q);
    const auto bias = r.rounding + metres +
                      hn::IfThenElseZero(r.faces_light, Splat(b.texels) * r.texel + Splat(b.slope) * slope);
    if (!b.uses_receiver_plane) r.q_dx = r.q_dy = Splat(0.0F);
    FloatVector lit;
    switch (test_.filter) {
      case ShadowFilter::nearest:
        lit = PercentageCloser(r, bias, 1);
        break;
      case ShadowFilter::percentage_closer:
        lit = PercentageCloser(r, bias, test_.kernel);
        break;
      default:
        lit = Bilinear(r, bias);
        break;
    }
    return hn::IfThenElse(r.is_seen, lit, Outside());
  }

  HWY_INLINE Quad FindQuad(const Receiver& r) const {
    const FloatTag d;
    const IntTag di;
    const auto x = Held(r.x - Splat(0.5F)), y = Held(r.y - Splat(0.5F));
    const auto floor_x = hn::Floor(x), floor_y = hn::Floor(y);
    const auto i = hn::ConvertTo(di, floor_x), j = hn::ConvertTo(di, floor_y);
    const auto zero = hn::Zero(di), one = SplatInt(1);
    const auto last_i = SplatInt(map_.width() - 1), last_j = SplatInt(map_.height() - 1);
    Quad quad;
    quad.weight_x = x - floor_x;
    quad.weight_y = y - floor_y;
    for (int k = 0; k < 2; ++k) {
      const auto column = k == 0 ? i : i + one, row = k == 0 ? j : j + one;
      const auto held_column = hn::Min(hn::Max(column, zero), last_i),
                 held_row = hn::Min(hn::Max(row, zero), last_j);
      quad.column[k] = ColumnPart(held_column);
      quad.row[k] = RowPart(held_row, map_.tiles_x());
      quad.column_in[k] = hn::RebindMask(d, held_column == column);
      quad.row_in[k] = hn::RebindMask(d, held_row == row);
      quad.dx[k] = Splat(static_cast<float>(k)) - quad.weight_x;
      quad.dy[k] = Splat(static_cast<float>(k)) - quad.weight_y;
    }
    return quad;
  }

  // A texel's two sides of the comparison: the surface that the light saw there, and the receiver's plane.
  struct Depths {
    FloatVector stored, tested;
  };
  // (dx, dy): from the sample to the texel's centre.
  HWY_INLINE Depths DepthsAt(const Receiver& r, IntVector index, FloatVector dx, FloatVector dy) const {
    return {hn::GatherIndex(FloatTag(), map_.texels(), index), r.q + (r.q_dx * dx + r.q_dy * dy)};
  }

  [[nodiscard]] HWY_INLINE FloatVector Outside() const { return Splat(test_.outside_is_lit ? 1.0F : 0.0F); }
  // Where the map has anything to say. What lies outside is lit texel by texel unless told otherwise.
  [[nodiscard]] HWY_INLINE FloatMask Covers(const Receiver& r) const {
    if (test_.outside_is_lit) return r.is_seen;
    const auto zero = Splat(0.0F);
    const auto width = Splat(static_cast<float>(map_.width())),
               height = Splat(static_cast<float>(map_.height()));
    const auto is_inside = hn::And(hn::And(r.x >= zero, r.x <= width), hn::And(r.y >= zero, r.y <= height));
    return hn::And(r.is_seen, is_inside);
  }
  [[nodiscard]] const BoundDepthMap& bound() const { return bound_; }
  [[nodiscard]] const DepthMap& map() const { return map_; }

 private:
  // 1 where texel (i, j), whose centre lies (dx, dy) texels from the sample, holds nothing nearer than the receiver's
  // plane has there.
  HWY_INLINE FloatVector Tap(const Receiver& r, FloatVector bias, IntVector i, IntVector j, FloatVector dx,
                             FloatVector dy) const {
    const FloatTag d;
    const auto zero = hn::Zero(IntTag());
    const auto last_i = SplatInt(map_.width() - 1), last_j = SplatInt(map_.height() - 1);
    const auto held_i = hn::Min(hn::Max(i, zero), last_i), held_j = hn::Min(hn::Max(j, zero), last_j);
    const auto is_inside = hn::RebindMask(d, hn::And(held_i == i, held_j == j));
    const Depths depths = DepthsAt(r, ColumnPart(held_i) + RowPart(held_j, map_.tiles_x()), dx, dy);
    const auto is_lit = IsLit(depths.stored, depths.tested, bias);
    return hn::IfThenElse(is_inside, hn::IfThenElseZero(is_lit, Splat(1.0F)), Outside());
  }

  // Texel coordinates far outside would not fit an int.
  HWY_INLINE FloatVector Held(FloatVector v) const {
    return hn::Min(hn::Max(v, Splat(-65536.0F)), Splat(65536.0F));
  }

  HWY_INLINE FloatVector Bilinear(const Receiver& r, FloatVector bias) const {
    const Quad quad = FindQuad(r);
    FloatVector rows[2];
    for (int j = 0; j < 2; ++j) {
      FloatVector lit[2];
      for (int i = 0; i < 2; ++i) {
        const Depths depths = DepthsAt(r, quad.column[i] + quad.row[j], quad.dx[i], quad.dy[j]);
        const auto is_lit = IsLit(depths.stored, depths.tested, bias);
        const auto is_inside = hn::And(quad.column_in[i], quad.row_in[j]);
        lit[i] = hn::IfThenElse(is_inside, hn::IfThenElseZero(is_lit, Splat(1.0F)), Outside());
      }
      rows[j] = lit[0] + (lit[1] - lit[0]) * quad.weight_x;
    }
    return rows[0] + (rows[1] - rows[0]) * quad.weight_y;
  }

  // kernel × kernel nearest texels, all of one weight: α is a multiple of 1/kernel² (row 27).
  HWY_INLINE FloatVector PercentageCloser(const Receiver& r, FloatVector bias, int kernel) const {
    const FloatTag d;
    const IntTag di;
    const auto reach = Splat(0.5F * static_cast<float>(kernel - 1));
    // First texel of the square whose centre is nearest to the sample.
    const auto floor_x = hn::Floor(Held(r.x - reach)), floor_y = hn::Floor(Held(r.y - reach));
    const auto i = hn::ConvertTo(di, floor_x), j = hn::ConvertTo(di, floor_y);
    const auto dx = floor_x + Splat(0.5F) - r.x, dy = floor_y + Splat(0.5F) - r.y;
    auto sum = hn::Zero(d);
    for (int row = 0; row < kernel; ++row) {
      for (int column = 0; column < kernel; ++column) {
        sum = sum + Tap(r, bias, i + SplatInt(column), j + SplatInt(row),
                        dx + Splat(static_cast<float>(column)), dy + Splat(static_cast<float>(row)));
      }
    }
    return sum / Splat(static_cast<float>(kernel * kernel));
  }

  const ShadowMapTest& test_;
  const BoundDepthMap& bound_;
  const DepthMap& map_;
  float position_error_;
};

// Which map each point asks: the face of the cube through which the ray from the light leaves it.
template <class Visit>
HWY_INLINE void ForEachMap(const ShadowMapTest& test, const Vector3& position, Visit visit) {
  const FloatTag d;
  if (test.maps.size() == 1) {
    visit(test.maps[0], Splat(0.0F) == Splat(0.0F));
    return;
  }
  const Vector3 p = position - Splat3(test.maps[0].eye_ws);
  const auto ax = hn::Abs(p.x), ay = hn::Abs(p.y), az = hn::Abs(p.z);
  const auto is_x = hn::And(ax >= ay, ax >= az);
  const auto is_y = hn::AndNot(is_x, ay >= az);
  const FloatMask axes[3] = {is_x, is_y, hn::Not(hn::Or(is_x, is_y))};
  const FloatVector components[3] = {p.x, p.y, p.z};
  for (std::size_t face = 0; face < 6; ++face) {
    const auto component = components[face / 2];
    const auto side = face % 2 == 0 ? component >= Splat(0.0F) : component < Splat(0.0F);
    const auto here = hn::And(axes[face / 2], side);
    if (!hn::AllFalse(d, here)) visit(test.maps[face], here);
  }
}

// ---------------------------------------------------------------------------------------------- refinement

// What a texel saw may be the receiver's own neighbourhood if its depth is within this many texel footprints, plus
// this many texels' change along the plane, of the receiver's.
constexpr float kNearTexels = 1.0F;
constexpr float kNearSlopes = 0.5F;
// What a texel saw is not the receiver's plane if it lies this many texel footprints beyond it.
constexpr float kBeyondTexels = 0.25F;
// A triangle that the light sees smaller than this many texels may have neighbours that no texel saw.
constexpr float kSmallTexels = 2.0F;

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

// Whether triangles stand between points and the light.
struct Blocking {
  FloatMask blocks;
  FloatMask is_small;  // seen from the light, a texel hardly covers it
};

// Möller and Trumbore, Fast, minimum storage ray/triangle intersection, 1997.
HWY_INLINE Blocking TestTriangles(const ShadowMapTest& test, const BoundDepthMap& bound, const Vector3& point,
                                  IntVector ids, FloatMask wanted, FloatVector near) {
  const frame::HWY_NAMESPACE::TriangleCorners<false> corners(*test.frame, ids);
  const auto at = corners.Positions();
  const auto zero = Splat(0.0F), one = Splat(1.0F);
  // Toward the light: as far as it is, or without end.
  Vector3 ray = Splat3(bound.axis_ws);
  auto length_squared = one;
  if (!bound.is_orthographic) {
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
  const auto u = Dot(s, p) * inverse, v = Dot(ray, q) * inverse, t = Dot(v_edge, q) * inverse;
  // Edges are shared: what rounding takes from one triangle the other does not always get.
  const auto hair = Splat(-1e-6F);
  auto hit = hn::And(hn::And(u >= hair, v >= hair), u + v <= one - hair);
  hit = hn::And(hit, t * t * length_squared > near * near);
  hit = hn::And(hit, t > zero);
  if (!bound.is_orthographic) hit = hn::And(hit, t < one);
  Blocking blocking;
  blocking.blocks = hn::And(hn::AndNot(is_parallel, hit), wanted);
  // |determinant| is twice the area across the ray, times its length. A texel there is texel_size · distance wide.
  const auto side = bound.is_orthographic ? Splat(bound.texel_size) : Splat(bound.texel_size) * (one - t);
  // Orthographic: area = |determinant| / 2. Perspective: |determinant| / (2 |ray|) against (texel_size (1 − t) |ray|)².
  auto texel_area = side * side;
  if (!bound.is_orthographic) texel_area = texel_area * length_squared * hn::Sqrt(length_squared);
  blocking.is_small = hn::Abs(determinant) < Splat(2 * kSmallTexels) * texel_area;

  const frame::HWY_NAMESPACE::Weights weights = {u, v, zero, zero, zero, zero};
  const auto holes = frame::HWY_NAMESPACE::FindHoles(*test.frame, corners, weights, blocking.blocks);
  blocking.blocks = hn::AndNot(holes, blocking.blocks);
  return blocking;
}

// α at N points: 0 where a triangle that one of the four texels saw blocks the light. Where none does, texels that saw
// something far in front and too small to be sure of still weigh.
HWY_INLINE FloatVector RefinedArrival(const ShadowMapTest& test, const MapReader& reader,
                                      const Points& points, IntVector own, FloatVector near) {
  const FloatTag d;
  const Receiver r = reader.Find(points);
  const Quad quad = reader.FindQuad(r);
  const FourGaps gaps = FindGaps(reader, r, quad);
  const auto zero = Splat(0.0F), one = Splat(1.0F);
  auto blocked = zero > one;
  auto dark = zero;
  for (int k = 0; k < 4; ++k) {
    const int i = k & 1, j = k >> 1;
    const auto asked = hn::Not(gaps.is_lit[k]);
    if (hn::AllFalse(d, asked)) continue;
    const auto index = quad.column[i] + quad.row[j];
    const auto id =
        hn::GatherIndex(IntTag(), reinterpret_cast<const std::int32_t*>(reader.map().triangles()), index);
    // Texels that saw nothing are lit, and are not asked; an index is still read.
    const auto wanted = hn::AndNot(hn::RebindMask(d, id == own), asked);
    const auto safe = hn::IfThenElse(hn::RebindMask(IntTag(), asked), id, own);
    const Blocking blocking = TestTriangles(test, reader.bound(), points.position_ws, safe, wanted, near);
    blocked = hn::Or(blocked, blocking.blocks);
    const auto weight =
        (i == 0 ? one - quad.weight_x : quad.weight_x) * (j == 0 ? one - quad.weight_y : quad.weight_y);
    dark = dark + hn::IfThenElseZero(hn::And(gaps.is_far[k], blocking.is_small), weight);
  }
  const auto alpha = hn::IfThenZeroElse(blocked, one - dark);
  return hn::IfThenElse(reader.Covers(r), alpha, reader.Outside());
}

// ---------------------------------------------------------------------------------------------- samples

HWY_INLINE Points LoadPoints(const SurfaceSamples& s, std::size_t i) {
  const FloatTag d;
  return {hn::Load(d, s.x.data() + i),
          hn::Load(d, s.y.data() + i),
          hn::Load(d, s.q.data() + i),
          {hn::Load(d, s.x_ws.data() + i), hn::Load(d, s.y_ws.data() + i), hn::Load(d, s.z_ws.data() + i)},
          {hn::Load(d, s.normal_x_ws.data() + i), hn::Load(d, s.normal_y_ws.data() + i),
           hn::Load(d, s.normal_z_ws.data() + i)}};
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

// The centre and four places about it, no two in one row or column. The centre casts the deciding vote: of two opposite
// places a straight edge leaves at least one on the centre's side, so it usually has the majority anyway. Where it has
// not, because what is in the way is thinner than the pixel or the surface is seen edge-on and the places lie far
// apart on it, α stays on the centre's side of one half: α ≥ 1/2 is the hard shadow at the pixel's centre.
constexpr float kPlaces[5][2] = {
    {0, 0}, {-0.125F, -0.375F}, {0.375F, -0.125F}, {-0.375F, 0.125F}, {0.125F, 0.375F}};

// α at one of test.positions places in the pixels: the only one is the sample itself. `centre_is_lit` as far as known.
HWY_INLINE FloatVector ArrivalAt(const ShadowMapTest& test, const SurfaceSamples& s, const Points& centre,
                                 const Slopes& slopes, IntVector own, FloatMask centre_is_lit, int place) {
  Points points = centre;
  // Corners were snapped: at its rim a triangle may have been given samples that lie on its plane a little beside it.
  const auto pixel = hn::Sqrt(Dot(slopes.dp_dx, slopes.dp_dx)) + hn::Sqrt(Dot(slopes.dp_dy, slopes.dp_dy));
  auto near = Splat(2 * s.position_error) + pixel * Splat(1.0F / raster::kSubpixels);
  if (test.positions > 1) {
    const auto dx = Splat(kPlaces[place][0]), dy = Splat(kPlaces[place][1]);
    const Vector3 step = slopes.dp_dx * dx + slopes.dp_dy * dy;
    points.x = centre.x + dx;
    points.y = centre.y + dy;
    points.q = centre.q + (slopes.dq_dx * dx + slopes.dq_dy * dy);
    points.position_ws = centre.position_ws + step;
    // Beyond the end of its triangle the plane may run into the next one, no farther than the step. That must not
    // darken what is lit; where the centre is dark, what stands so near is what darkens it.
    near = near + hn::IfThenElseZero(centre_is_lit, Splat(2.0F) * hn::Sqrt(Dot(step, step)));
  }
  auto result = Splat(1.0F);
  ForEachMap(test, points.position_ws, [&](const BoundDepthMap& map, FloatMask here) HWY_ATTR {
    const MapReader reader(test, map, s.position_error);
    result = hn::IfThenElse(here, RefinedArrival(test, reader, points, own, near), result);
  });
  return result;
}

// The samples that need refinement, gathered N at a time from all groups.
class RefinementList {
 public:
  void Add(std::size_t first, FloatMask unsure, std::uint32_t wanted) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(FloatTag(), unsure, bytes);
    const std::uint32_t bits = (bytes[0] | std::uint32_t{bytes[1]} << 8U) & wanted;
    for (std::uint32_t mask = bits; mask != 0; mask &= mask - 1) {
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
      const auto any = Splat(0.0F) == Splat(0.0F);
      const auto centre = ArrivalAt(test, s, points, slopes, own, any, 0);
      auto result = centre;
      if (test.positions > 1) {
        const auto share = Splat(1.0F / static_cast<float>(test.positions));
        const auto majority = Splat(static_cast<float>(test.positions / 2 + 1)) * share;
        const auto is_lit = centre >= Splat(0.5F);
        for (int i = 1; i < test.positions; ++i) {
          result = result + ArrivalAt(test, s, points, slopes, own, is_lit, i);
        }
        result = hn::IfThenElse(is_lit, hn::Max(result * share, majority),
                                hn::Min(result * share, Splat(1.0F) - majority));
      }
      alignas(64) float values[kLanes];
      hn::Store(result, d, values);
      for (std::size_t k = 0; k < kLanes && first + k < count_; ++k) {
        alpha[static_cast<std::size_t>(indices_[first + k])] = values[k];
      }
    }
  }

 private:
  alignas(64) std::array<std::int32_t, kMaxSamples + kGroupSize> indices_{};
  std::size_t count_ = 0;
};

void look_up_shadow_map(const ShadowMapTest& test, const SurfaceSamples& samples,
                        std::span<const std::uint16_t> wanted, float* alpha) {
  RefinementList unsure;
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    if (wanted[group] == 0) continue;
    for (std::size_t k = 0; k < kGroupSize; k += kLanes) {
      const std::size_t i = group * kGroupSize + k;
      const Points points = LoadPoints(samples, i);
      auto result = Splat(test.outside_is_lit ? 1.0F : 0.0F);
      auto is_unsure = Splat(0.0F) > Splat(1.0F);
      ForEachMap(test, points.position_ws, [&](const BoundDepthMap& map, FloatMask here) HWY_ATTR {
        const MapReader reader(test, map, samples.position_error);
        if (test.filter == ShadowFilter::refined) {
          const Quick quick = QuickArrival(reader, points);
          result = hn::IfThenElse(here, quick.alpha, result);
          is_unsure = hn::Or(is_unsure, hn::And(here, quick.unsure));
        } else {
          result = hn::IfThenElse(here, reader.Arrival(reader.Find(points)), result);
        }
      });
      hn::Store(result, FloatTag(), alpha + i);
      unsure.Add(i, is_unsure, static_cast<std::uint32_t>(wanted[group]) >> k);
    }
  }
  unsure.Refine(test, samples, alpha);
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shadow {
LATERNA_KERNEL_TABLE(look_up_shadow_map)

bool is_lit(float stored, float tested, float bias) {
  return HWY_STATIC_DISPATCH(IsLit)(stored, tested, bias);
}
}  // namespace laterna::shadow
#endif
