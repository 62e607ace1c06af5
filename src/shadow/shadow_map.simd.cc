// Look-ups into depth maps.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shadow/shadow_map.simd.cc"
#include "base/simd.h"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "base/vectors-inl.h"
#include "shadow/projected_view-inl.h"
#include "shadow/shadow_map.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::shadow::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// A sample as one depth map sees it.
struct Receiver {
  FloatVector x, y;          // texels from the map's top-left corner
  FloatVector q;             // reversed depth
  FloatVector q_dx, q_dy;    // along the receiver's plane, per texel; 0 without a receiver plane
  FloatVector bias;          // in reversed depth
  FloatMask is_seen;         // in front of the light and nearer than far
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

class MapReader {
 public:
  MapReader(const ShadowMapTest& test, const BoundDepthMap& bound) : test_(test), bound_(bound) {}

  HWY_INLINE Receiver Find(const SurfaceSamples& s, std::size_t i) const {
    const FloatTag d;
    const auto x = hn::Load(d, s.x.data() + i), y = hn::Load(d, s.y.data() + i), q = hn::Load(d, s.q.data() + i);
    const auto X = Evaluate(bound_.position.x, x, y, q), Y = Evaluate(bound_.position.y, x, y, q);
    const auto W = Evaluate(bound_.position.divisor, x, y, q), h = Evaluate(bound_.homogeneous, x, y, q);
    const Vector3 normal = {hn::Load(d, s.normal_x_ws.data() + i), hn::Load(d, s.normal_y_ws.data() + i),
                            hn::Load(d, s.normal_z_ws.data() + i)};
    const raster::RasterView& view = bound_.map->view();
    const auto origin_x = Splat(static_cast<float>(view.origin_x)), origin_y = Splat(static_cast<float>(view.origin_y));
    const auto error = Splat(s.position_error + test_.bias.metres);
    const auto far = Splat(view.reversed_far);
    Receiver r;
    FloatVector plane_divisor, texel_q, error_q;
    if (bound_.is_orthographic) {
      const auto inverse = Splat(1.0F) / h;
      r.x = X * inverse + origin_x;
      r.y = Y * inverse + origin_y;
      r.q = W * inverse;
      r.is_seen = r.q >= far;
      // Points of the plane: direction(x, y) + q axis, so n·direction + q n·axis is constant.
      plane_divisor = hn::Neg(Dot(normal, Splat3(bound_.axis_ws)));
      texel_q = Splat(bound_.texel_size);
      error_q = error;
    } else {
      // Nothing behind the light is seen by it (row 58). The smallest divisor still has a finite inverse.
      const auto is_ahead = W > h * Splat(1e-6F);
      const auto inverse = Splat(1.0F) / hn::IfThenElse(is_ahead, W, h);
      r.x = X * inverse + origin_x;
      r.y = Y * inverse + origin_y;
      r.q = h * inverse;
      r.is_seen = hn::And(is_ahead, r.q >= far);
      const Vector3 from_light = Vector3{hn::Load(d, s.x_ws.data() + i), hn::Load(d, s.y_ws.data() + i),
                                         hn::Load(d, s.z_ws.data() + i)} -
                                 Splat3(bound_.eye_ws);
      plane_divisor = Dot(normal, from_light);
      // t metres at reversed depth q are t q² of reversed depth; a texel is texel_size / q metres wide.
      texel_q = Splat(bound_.texel_size) * r.q;
      error_q = error * r.q * r.q;
    }
    // A plane seen edge-on has no slope to speak of; its lit and dark sides meet in one texel.
    const auto is_edge_on = hn::Abs(plane_divisor) <= Splat(1e-9F);
    const auto inverse_divisor = Splat(1.0F) / hn::IfThenElse(is_edge_on, Splat(1.0F), plane_divisor);
    const auto slope_x = hn::IfThenZeroElse(is_edge_on, Dot(normal, Splat3(bound_.direction_x_ws)) * inverse_divisor);
    const auto slope_y = hn::IfThenZeroElse(is_edge_on, Dot(normal, Splat3(bound_.direction_y_ws)) * inverse_divisor);
    r.bias = Splat(test_.bias.texels) * texel_q + error_q +
             Splat(test_.bias.slope) * (hn::Abs(slope_x) + hn::Abs(slope_y)) + Splat(2e-6F) * hn::Abs(r.q);
    const auto zero = Splat(0.0F);
    r.q_dx = test_.bias.uses_receiver_plane ? slope_x : zero;
    r.q_dy = test_.bias.uses_receiver_plane ? slope_y : zero;
    return r;
  }

  // α of the samples of a vector.
  HWY_INLINE FloatVector Arrival(const Receiver& r) const {
    FloatVector lit;
    switch (test_.filter) {
      case ShadowFilter::nearest: lit = PercentageCloser(r, 1); break;
      case ShadowFilter::percentage_closer: lit = PercentageCloser(r, test_.kernel); break;
      default: lit = Bilinear(r); break;
    }
    return hn::IfThenElse(r.is_seen, lit, Outside());
  }

 private:
  [[nodiscard]] HWY_INLINE FloatVector Outside() const { return Splat(test_.outside_is_lit ? 1.0F : 0.0F); }

  // 1 where texel (i, j), whose centre lies (dx, dy) texels from the sample, holds nothing nearer than the receiver's
  // plane has there.
  HWY_INLINE FloatVector Tap(const Receiver& r, IntVector i, IntVector j, FloatVector dx, FloatVector dy) const {
    const FloatTag d;
    const DepthMap& map = *bound_.map;
    const auto zero = hn::Zero(IntTag());
    const auto last_i = SplatInt(map.width() - 1), last_j = SplatInt(map.height() - 1);
    const auto held_i = hn::Min(hn::Max(i, zero), last_i), held_j = hn::Min(hn::Max(j, zero), last_j);
    const auto is_inside = hn::RebindMask(d, hn::And(held_i == i, held_j == j));
    const auto stored = hn::GatherIndex(d, map.texels(), ColumnPart(held_i) + RowPart(held_j, map.tiles_x()));
    const auto tested = r.q + (r.q_dx * dx + r.q_dy * dy);
    // is_lit(), N at a time.
    const auto lit = hn::IfThenElseZero(stored <= tested + r.bias, Splat(1.0F));
    return hn::IfThenElse(is_inside, lit, Outside());
  }

  // Texel coordinates far outside would not fit an int.
  HWY_INLINE FloatVector Held(FloatVector v) const { return hn::Min(hn::Max(v, Splat(-65536.0F)), Splat(65536.0F)); }

  HWY_INLINE FloatVector Bilinear(const Receiver& r) const {
    const IntTag di;
    const auto x = Held(r.x - Splat(0.5F)), y = Held(r.y - Splat(0.5F));
    const auto floor_x = hn::Floor(x), floor_y = hn::Floor(y);
    const auto i = hn::ConvertTo(di, floor_x), j = hn::ConvertTo(di, floor_y);
    const auto one = SplatInt(1);
    const auto wx = x - floor_x, wy = y - floor_y;
    const auto left = hn::Neg(wx), right = Splat(1.0F) - wx, up = hn::Neg(wy), down = Splat(1.0F) - wy;
    const auto a = Tap(r, i, j, left, up), b = Tap(r, i + one, j, right, up);
    const auto c = Tap(r, i, j + one, left, down), e = Tap(r, i + one, j + one, right, down);
    const auto above = a + (b - a) * wx, below = c + (e - c) * wx;
    return above + (below - above) * wy;
  }

  // kernel × kernel nearest texels, all of one weight: α is a multiple of 1/kernel² (row 27).
  HWY_INLINE FloatVector PercentageCloser(const Receiver& r, int kernel) const {
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
        sum = sum + Tap(r, i + SplatInt(column), j + SplatInt(row), dx + Splat(static_cast<float>(column)),
                        dy + Splat(static_cast<float>(row)));
      }
    }
    return sum / Splat(static_cast<float>(kernel * kernel));
  }

  const ShadowMapTest& test_;
  const BoundDepthMap& bound_;
};

HWY_INLINE void LookUpOne(const ShadowMapTest& test, const SurfaceSamples& samples, std::size_t group, float* alpha) {
  const MapReader reader(test, test.maps[0]);
  for (std::size_t i = group * kGroupSize; i < (group + 1) * kGroupSize; i += kLanes) {
    hn::Store(reader.Arrival(reader.Find(samples, i)), FloatTag(), alpha + i);
  }
}

// Each sample asks the face through which the ray from the light leaves the cube.
HWY_INLINE void LookUpCube(const ShadowMapTest& test, const SurfaceSamples& samples, std::size_t group, float* alpha) {
  const FloatTag d;
  for (std::size_t i = group * kGroupSize; i < (group + 1) * kGroupSize; i += kLanes) {
    const Vector3 p = Vector3{hn::Load(d, samples.x_ws.data() + i), hn::Load(d, samples.y_ws.data() + i),
                              hn::Load(d, samples.z_ws.data() + i)} -
                      Splat3(test.maps[0].eye_ws);
    const auto ax = hn::Abs(p.x), ay = hn::Abs(p.y), az = hn::Abs(p.z);
    const auto is_x = hn::And(ax >= ay, ax >= az);
    const auto is_y = hn::AndNot(is_x, ay >= az);
    const auto is_z = hn::Not(hn::Or(is_x, is_y));
    const FloatMask axes[3] = {is_x, is_y, is_z};
    const FloatVector components[3] = {p.x, p.y, p.z};
    auto result = Splat(test.outside_is_lit ? 1.0F : 0.0F);
    for (std::size_t face = 0; face < 6; ++face) {
      const auto component = components[face / 2];
      const auto side = face % 2 == 0 ? component >= Splat(0.0F) : component < Splat(0.0F);
      const auto here = hn::And(axes[face / 2], side);
      if (hn::AllFalse(d, here)) continue;
      const MapReader reader(test, test.maps[face]);
      result = hn::IfThenElse(here, reader.Arrival(reader.Find(samples, i)), result);
    }
    hn::Store(result, d, alpha + i);
  }
}

void look_up_shadow_map(const ShadowMapTest& test, const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                        float* alpha) {
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    if (wanted[group] == 0) continue;
    if (test.maps.size() == 6) {
      LookUpCube(test, samples, group, alpha);
    } else {
      LookUpOne(test, samples, group, alpha);
    }
  }
}

}  // namespace laterna::shadow::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::shadow {
LATERNA_KERNEL_TABLE(look_up_shadow_map)
}  // namespace laterna::shadow
#endif
