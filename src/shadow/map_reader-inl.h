// Samples as a depth map sees them, its texels around them, and the plain filters.
#if defined(LATERNA_SHADOW_MAP_READER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_SHADOW_MAP_READER_INL_H_
#undef LATERNA_SHADOW_MAP_READER_INL_H_
#else
#define LATERNA_SHADOW_MAP_READER_INL_H_
#endif

#include <hwy/highway.h>

#include "base/vectors-inl.h"
#include "light/cascades.h"
#include "shadow/depth_comparison-inl.h"
#include "shadow/projected_view-inl.h"
#include "shadow/ray_length-inl.h"
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

// Samples as one depth map sees them.
struct Receiver {
  FloatVector x, y;        // texels from the map's top-left corner
  FloatVector q;           // reversed depth
  FloatVector q_dx, q_dy;  // along the receiver's plane, per texel; 0 without a receiver plane
  FloatVector rounding;    // in reversed depth: what arithmetic may have lost
  FloatVector texel;       // the footprint of a texel, as reversed depth
  FloatVector metre;       // along the ray, as reversed depth
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
               h = Evaluate(bound_.divisor, p.x, p.y, p.q);
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
      r.metre = Splat(1.0F);
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
      r.metre = r.q * r.q;
    }
    Vector3 step_x = Splat3(bound_.direction_x_ws), step_y = Splat3(bound_.direction_y_ws);
    if (bound_.is_warped) {
      const auto homogeneous = Evaluate(bound_.homogeneous, p.x, p.y, p.q);
      step_x = step_x - p.position_ws * Splat(bound_.direction_x_h);
      step_y = step_y - p.position_ws * Splat(bound_.direction_y_h);
      Unwarp(h / homogeneous, step_x, step_y, r);
    }
    r.rounding = r.rounding + Splat(kDepthRounding) * hn::Abs(r.q);
    r.faces_light = plane_divisor < Splat(0.0F);
    // A plane seen edge-on has no slope to speak of; its lit and dark sides meet in one texel.
    const auto is_edge_on = hn::Abs(plane_divisor) <= Splat(1e-9F);
    const auto inverse_divisor = Splat(1.0F) / hn::IfThenElse(is_edge_on, Splat(1.0F), plane_divisor);
    r.q_dx = hn::IfThenZeroElse(is_edge_on, Dot(p.normal_ws, step_x) * inverse_divisor);
    r.q_dy = hn::IfThenZeroElse(is_edge_on, Dot(p.normal_ws, step_y) * inverse_divisor);
    return r;
  }

  // How far behind what a texel holds a sample may lie and still be lit, as reversed depth.
  HWY_INLINE FloatVector Bias(const Receiver& r) const {
    // Back sides are in the shadow of their own front, if of anything: there is no self-shadowing to prevent.
    const ShadowBias& b = test_.bias;
    const auto slope = hn::Abs(r.q_dx) + hn::Abs(r.q_dy);
    const auto metres = Splat(b.metres) * r.metre;
    return r.rounding + metres +
           hn::IfThenElseZero(r.faces_light, Splat(b.texels) * r.texel + Splat(b.slope) * slope);
  }
  // The receiver as it is compared: a manual bias knows no plane.
  HWY_INLINE Receiver Compared(Receiver r) const {
    if (!test_.bias.uses_receiver_plane) r.q_dx = r.q_dy = Splat(0.0F);
    return r;
  }

  // α of plain filters.
  HWY_INLINE FloatVector Arrival(Receiver r) const {
    const auto bias = Bias(r);
    r = Compared(r);
    FloatVector lit;
    switch (test_.filter) {
      case ShadowFilter::nearest:
        lit = PercentageCloser(r, bias, 1);
        break;
      case ShadowFilter::percentage_closer:
        lit = PercentageCloser(r, bias, test_.kernel);
        break;
      case ShadowFilter::averaged_depths:
        lit = AveragedDepths(r, bias, test_.kernel);
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

  // The texel in which the receiver lies.
  struct NearestTexel {
    FloatVector stored, tested;
    FloatMask is_inside;
  };
  HWY_INLINE NearestTexel FindNearest(const Receiver& r) const {
    const FloatTag d;
    const IntTag di;
    const auto floor_x = hn::Floor(Held(r.x)), floor_y = hn::Floor(Held(r.y));
    const auto i = hn::ConvertTo(di, floor_x), j = hn::ConvertTo(di, floor_y);
    const auto held_i = hn::Min(hn::Max(i, hn::Zero(di)), SplatInt(map_.width() - 1)),
               held_j = hn::Min(hn::Max(j, hn::Zero(di)), SplatInt(map_.height() - 1));
    const Depths depths = DepthsAt(r, ColumnPart(held_i) + RowPart(held_j, map_.tiles_x()),
                                   floor_x + Splat(0.5F) - r.x, floor_y + Splat(0.5F) - r.y);
    return {depths.stored, depths.tested, hn::RebindMask(d, hn::And(held_i == i, held_j == j))};
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
  // 1 where a texel holds nothing nearer than the receiver, 0 where it does; with a soft edge something between where that
  // is not far nearer. (dx, dy): from the sample to the texel's centre.
  HWY_INLINE FloatVector LitShare(const Receiver& r, Depths depths, FloatVector bias, FloatVector dx,
                                  FloatVector dy) const {
    if (test_.is_radial) {
      const auto one = Splat(1.0F);
      const auto shorter = one / RayLength(map_.view(), r.x + dx, r.y + dy);
      // A receiver without a plane is compared by its own distance.
      const auto own = test_.bias.uses_receiver_plane ? shorter : one / RayLength(map_.view(), r.x, r.y);
      depths = {depths.stored * shorter, depths.tested * own};
      bias = bias * own;
    }
    const auto is_lit = IsLit(depths.stored, depths.tested, bias);
    if (test_.soft_edge <= 0) return hn::IfThenElseZero(is_lit, Splat(1.0F));
    // Smoothstep over the metres that the caster stands before the receiver.
    const auto nearer = depths.stored - (depths.tested + bias);
    const auto scale =
        bound_.is_orthographic ? r.metre : hn::Max(depths.tested * depths.stored, Splat(1e-30F));
    const auto t = Saturate(hn::Max(nearer, Splat(0.0F)) / (scale * Splat(test_.soft_edge)));
    return hn::IfThenElse(is_lit, Splat(1.0F), Splat(1.0F) - t * t * (Splat(3.0F) - (t + t)));
  }

  // What an orthographic map's numbers are in a warped one. `divisor`: the warp's fourth coordinate; a metre along the
  // light is the smaller the larger it is. `step_x`, `step_y`: of a texel at the sample, over the divisor.
  HWY_INLINE void Unwarp(FloatVector divisor, const Vector3& step_x, const Vector3& step_y,
                         Receiver& r) const {
    const auto one = Splat(1.0F);
    const auto is_ahead = divisor > Splat(1e-3F);
    r.is_seen = hn::And(r.is_seen, is_ahead);
    r.metre = one / hn::IfThenElse(is_ahead, divisor, one);
    // Square to the light. Over the divisor a length is reversed depth already.
    const Vector3 axis = Splat3(bound_.axis_ws);
    const auto across_squared = [&](const Vector3& step) HWY_ATTR {
      const auto along = Dot(step, axis);
      return Dot(step, step) - along * along;
    };
    r.texel = hn::Sqrt(hn::Max(hn::Max(across_squared(step_x), across_squared(step_y)), Splat(0.0F)));
    // An error of the sample's place moves the divisor too, and the warped corners were rounded.
    const auto nearest = Splat(map_.view().reversed_near);
    r.rounding =
        Splat(position_error_) * (one + hn::Abs(nearest - r.q)) * r.metre + Splat(kDepthRounding) * nearest;
  }

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
    return hn::IfThenElse(is_inside, LitShare(r, depths, bias, dx, dy), Outside());
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
        const auto is_inside = hn::And(quad.column_in[i], quad.row_in[j]);
        lit[i] = hn::IfThenElse(is_inside, LitShare(r, depths, bias, quad.dx[i], quad.dy[j]), Outside());
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

  // What not to do (row 101): the mean depth of what stands at an edge and of what lies behind it is the depth of nothing
  // at all, and whatever lies between the two is lit or dark by chance. What the light does not see counts as far away.
  HWY_INLINE FloatVector AveragedDepths(const Receiver& r, FloatVector bias, int kernel) const {
    const FloatTag d;
    const IntTag di;
    const auto reach = Splat(0.5F * static_cast<float>(kernel - 1));
    const auto floor_x = hn::Floor(Held(r.x - reach)), floor_y = hn::Floor(Held(r.y - reach));
    const auto i = hn::ConvertTo(di, floor_x), j = hn::ConvertTo(di, floor_y);
    const auto zero = hn::Zero(di);
    auto stored = hn::Zero(d), tested = hn::Zero(d);
    for (int row = 0; row < kernel; ++row) {
      for (int column = 0; column < kernel; ++column) {
        const auto x = i + SplatInt(column), y = j + SplatInt(row);
        const auto held_x = hn::Min(hn::Max(x, zero), SplatInt(map_.width() - 1)),
                   held_y = hn::Min(hn::Max(y, zero), SplatInt(map_.height() - 1));
        const auto is_inside = hn::RebindMask(d, hn::And(held_x == x, held_y == y));
        const auto dx = floor_x + Splat(static_cast<float>(column) + 0.5F) - r.x,
                   dy = floor_y + Splat(static_cast<float>(row) + 0.5F) - r.y;
        const Depths depths = DepthsAt(r, ColumnPart(held_x) + RowPart(held_y, map_.tiles_x()), dx, dy);
        const auto beside =
            Splat(test_.outside_is_lit ? map_.view().reversed_far : map_.view().reversed_near);
        stored = stored + Averaged(hn::IfThenElse(is_inside, depths.stored, beside));
        tested = tested + Averaged(depths.tested);
      }
    }
    const auto share = Splat(1.0F / static_cast<float>(kernel * kernel));
    const Depths mean = {Averaged(stored * share), Averaged(tested * share)};
    const auto middle = reach + Splat(0.5F);
    return LitShare(r, mean, bias, floor_x + middle - r.x, floor_y + middle - r.y);
  }
  // Reversed depth as something that is linear in metres, and back.
  HWY_INLINE FloatVector Averaged(FloatVector depth) const {
    const raster::RasterView& view = map_.view();
    if (bound_.is_orthographic) return hn::Max(depth, Splat(view.reversed_far));
    return Splat(1.0F) / hn::Max(depth, Splat(1e-20F));
  }

  const ShadowMapTest& test_;
  const BoundDepthMap& bound_;
  const DepthMap& map_;
  float position_error_;
};

// A map's part in the answer for N points.
struct Share {
  FloatMask here;       // of the points that ask it
  FloatVector weight;   // less than 1 where the map is blended over those visited before
  bool blends = false;  // whether there are such points
};

// An answer laid over those before it. What is equal stays so bit for bit.
HWY_INLINE FloatVector LayOver(const Share& share, FloatVector value, FloatVector below) {
  if (!share.blends) return hn::IfThenElse(share.here, value, below);
  const auto blended = below + (value - below) * share.weight;
  return hn::IfThenElse(share.here, hn::IfThenElse(share.weight < Splat(1.0F), blended, value), below);
}

// The face of the cube through which the ray from the light leaves it.
template <class Visit>
HWY_INLINE void ForEachFace(const ShadowMapTest& test, const Vector3& position, Visit visit) {
  const FloatTag d;
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
    if (!hn::AllFalse(d, here)) visit(test.maps[face], Share{here, Splat(1.0F), false});
  }
}

// How much of a cascade's answer counts: all inside, less and less over a band along its sides, so that no seam is seen
// where the next, coarser one takes over.
HWY_INLINE FloatVector CascadeWeight(const ShadowMapTest& test, const BoundDepthMap& bound, const Points& p) {
  const raster::RasterView& view = bound.map->view();
  const auto inverse = Splat(1.0F) / Evaluate(bound.homogeneous, p.x, p.y, p.q);
  const auto x = Evaluate(bound.position.x, p.x, p.y, p.q) * inverse +
                 Splat(static_cast<float>(view.origin_x)),
             y = Evaluate(bound.position.y, p.x, p.y, p.q) * inverse +
                 Splat(static_cast<float>(view.origin_y));
  const auto inside_x = hn::Min(x, Splat(static_cast<float>(view.width)) - x);
  const auto inside_y = hn::Min(y, Splat(static_cast<float>(view.height)) - y);
  const auto rim = Splat(static_cast<float>(light::cascade_rim(test.kernel)));
  const auto share_per_texel = Splat(1.0F / light::cascade_band(view.width, view.height));
  return Saturate((hn::Min(inside_x, inside_y) - rim) * share_per_texel);
}

// The finest cascade that holds each point, and the next coarser ones in its band. The coarsest is visited first.
template <class Visit>
HWY_INLINE void ForEachCascade(const ShadowMapTest& test, const Points& points, Visit visit) {
  const FloatTag d;
  const auto one = Splat(1.0F);
  Share shares[kMostMaps];
  auto open = Splat(0.0F) < one;  // points that nothing finer answers for alone
  std::size_t count = 0;
  for (; count < test.maps.size() && !hn::AllFalse(d, open); ++count) {
    const bool is_last = count + 1 == test.maps.size();
    const auto weight = is_last ? one : CascadeWeight(test, test.maps[count], points);
    shares[count] = {hn::And(open, weight > Splat(0.0F)), weight, true};
    open = hn::And(open, weight < one);
  }
  while (count-- > 0) {
    if (!hn::AllFalse(d, shares[count].here)) visit(test.maps[count], shares[count]);
  }
}

// Visits the maps that points ask, with each one's share.
template <class Visit>
HWY_INLINE void ForEachMap(const ShadowMapTest& test, const Points& points, Visit visit) {
  switch (test.choice) {
    case MapChoice::only:
      visit(test.maps[0], Share{Splat(0.0F) < Splat(1.0F), Splat(1.0F), false});
      break;
    case MapChoice::face:
      ForEachFace(test, points.position_ws, visit);
      break;
    case MapChoice::finest:
      ForEachCascade(test, points, visit);
      break;
  }
}

HWY_INLINE Points LoadPoints(const SurfaceSamples& s, std::size_t i) {
  const FloatTag d;
  return {hn::Load(d, s.x.data() + i),
          hn::Load(d, s.y.data() + i),
          hn::Load(d, s.q.data() + i),
          {hn::Load(d, s.x_ws.data() + i), hn::Load(d, s.y_ws.data() + i), hn::Load(d, s.z_ws.data() + i)},
          {hn::Load(d, s.normal_x_ws.data() + i), hn::Load(d, s.normal_y_ws.data() + i),
           hn::Load(d, s.normal_z_ws.data() + i)}};
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
