// Rays through the heights of a relief, N at a time.
#if defined(LATERNA_FRAME_RELIEF_RAY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef LATERNA_FRAME_RELIEF_RAY_INL_H_
#undef LATERNA_FRAME_RELIEF_RAY_INL_H_
#else
#define LATERNA_FRAME_RELIEF_RAY_INL_H_
#endif

#include <hwy/highway.h>

#include <limits>

#include "base/vectors-inl.h"
#include "frame/frame.h"
#include "frame/relief_field.h"
#include "frame/triangle_corners-inl.h"
#include "laterna/relief.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::frame::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary

// Nodes of the pyramid that a ray visits at most. A ray at 60° meets some dozens; one that has not met the relief after so many
// ends where it is, above it.
constexpr int kMostReliefSteps = 2048;
// Ways of rays over the lattice are held to this, and what lies beyond the ends of one that is clamped: twice the widest.
constexpr float kMostLattice = 2.0F * static_cast<float>(kMaxReliefSamples);
// Other coordinates are held to this, far beyond where they are told apart: what is left of them fits an integer.
constexpr float kMostRepeated = 1e15F;

// Coordinates on the lattice.
struct LatticePoint {
  FloatVector x, y;
};

// At depth t, from 0 in the polygon's plane to 1, the ray is at start + step · t.
struct ReliefRay {
  LatticePoint start, step;
};

// What the surfaces' triangles say of the relief: lattice coordinates at the corners, each a sum over the mesh's two.
struct ReliefCoordinates {
  CornerValues x, y;

  HWY_INLINE LatticePoint At(FloatVector b, FloatVector c) const {
    return {x.a + ((x.b - x.a) * b + (x.c - x.a) * c), y.a + ((y.b - y.a) * b + (y.c - y.a) * c)};
  }
  // Of a change of the weights.
  HWY_INLINE LatticePoint Change(FloatVector b, FloatVector c) const {
    return {(x.b - x.a) * b + (x.c - x.a) * c, (y.b - y.a) * b + (y.c - y.a) * c};
  }
};

template <bool kUniform>
HWY_INLINE ReliefCoordinates FindReliefCoordinates(const Frame& frame, const ReliefBinding& relief,
                                                   const TriangleCorners<kUniform>& corners) {
  const auto set = static_cast<std::size_t>(relief.uv_set);
  const auto zero = Splat(0.0F);
  const auto stream = corners.StreamAt(kUvField + set);
  CornerValues u = {zero, zero, zero}, v = u;
  if (!stream.IsMissing()) {
    const CornerPairs uv = corners.At(frame.uvs[set].data(), stream.first);
    u = uv.x, v = uv.y;
  }
  const std::array<float, 6>& m = relief.uv_from_mesh_uv;
  const auto row = [&](std::size_t r, const ReliefField::Axis& axis) HWY_ATTR {
    const auto at = [&](FloatVector a, FloatVector b) HWY_ATTR {
      const auto mapped =
          (Splat(m[r]) * stream.OrElse(a, zero) + Splat(m[r + 1]) * stream.OrElse(b, zero)) + Splat(m[r + 2]);
      return mapped * Splat(axis.scale) + Splat(axis.offset);
    };
    return CornerValues{at(u.a, v.a), at(u.b, v.b), at(u.c, v.c)};
  };
  return {row(0, relief.field->x), row(3, relief.field->y)};
}

HWY_INLINE FloatVector HeldTo(float most, FloatVector v) {
  return hn::Min(hn::Max(v, Splat(-most)), Splat(most));
}

// Cells after which the lattice comes again.
HWY_INLINE FloatVector PeriodOf(const ReliefField::Axis& axis) {
  return Splat(static_cast<float>(axis.wrap == Wrap::mirror ? 2 * (axis.cells - 1) : axis.cells));
}

// A coordinate of the first repetition where the lattice is the same, so that far from the picture nothing is lost but what
// texture coordinates themselves lose there.
HWY_INLINE FloatVector OnLattice(const ReliefField::Axis& axis, FloatVector v) {
  if (axis.wrap == Wrap::clamp) return HeldTo(kMostLattice, v);
  const auto period = PeriodOf(axis);
  const auto held = HeldTo(kMostRepeated, v);
  return held - hn::Floor(held / period) * period;
}

HWY_INLINE IntVector FloorToInt(FloatVector v) { return hn::ConvertTo(IntTag(), hn::Floor(v)); }
HWY_INLINE FloatVector ToFloat(IntVector v) { return hn::ConvertTo(FloatTag(), v); }

// Where a lattice coordinate lies: in `cell`, within 0 … cells − 1, of a repetition.
struct LatticePlace {
  FloatVector tile;  // corner 0 of the repetition, in lattice coordinates
  FloatVector way;   // 1; −1 in repetitions whose cells count down
  IntVector cell;

  // A lattice coordinate, counted from corner 0 the way that cells count.
  [[nodiscard]] HWY_INLINE FloatVector Within(const ReliefField::Axis& axis, FloatVector p) const {
    return axis.wrap == Wrap::mirror ? (p - tile) * way : p - tile;
  }
};
HWY_INLINE LatticePlace PlaceOn(const ReliefField::Axis& axis, FloatVector p) {
  const IntTag di;
  const auto one = Splat(1.0F);
  LatticePlace place = {Splat(0.0F), one, hn::Zero(di)};
  if (axis.wrap != Wrap::clamp) place.tile = hn::Floor(p / PeriodOf(axis)) * PeriodOf(axis);
  if (axis.wrap == Wrap::mirror) {
    // Cell `cells` is the one before the last, seen from behind.
    const auto cells = Splat(static_cast<float>(axis.cells));
    const auto is_back = p - place.tile >= cells;
    place.tile = hn::IfThenElse(is_back, place.tile + (Splat(2.0F) * cells - one), place.tile);
    place.way = hn::IfThenElse(is_back, Splat(-1.0F), one);
  }
  place.cell = hn::Min(hn::Max(FloorToInt(place.Within(axis, p)), hn::Zero(di)), SplatInt(axis.cells - 1));
  return place;
}

// One direction of a ray's way from node to node.
struct AxisWalk {
  FloatVector start, step, inverse_step;
  FloatMask is_forward, is_still;  // forward: toward higher cells
  LatticePlace place;
  const ReliefField::Axis* axis;

  HWY_INLINE AxisWalk(const ReliefField::Axis& of_axis, FloatVector from, FloatVector by)
      : start(OnLattice(of_axis, from)), step(HeldTo(kMostLattice, by)), axis(&of_axis) {
    is_still = hn::Abs(step) < Splat(1e-12F);
    inverse_step = Splat(1.0F) / hn::IfThenElse(is_still, Splat(1.0F), step);
    place = PlaceOn(of_axis, start);
    is_forward = StepWithin() > Splat(0.0F);
  }

  // Counted as cells count: where the ray is, and its step.
  [[nodiscard]] HWY_INLINE FloatVector Within(FloatVector t) const {
    return place.Within(*axis, start + step * t);
  }
  [[nodiscard]] HWY_INLINE FloatVector StepWithin() const {
    return axis->wrap == Wrap::mirror ? step * place.way : step;
  }

  // Cells of the node of a level that holds the present cell: `low` inclusive, `high` exclusive.
  struct Node {
    IntVector low, high;
  };
  [[nodiscard]] HWY_INLINE Node NodeAt(IntVector level) const {
    const auto size = hn::Shl(SplatInt(1), level);
    const auto low = hn::And(place.cell, hn::Neg(size));
    return {low, hn::Min(low + size, SplatInt(axis->cells))};
  }

  // The depth at which the ray leaves the node.
  [[nodiscard]] HWY_INLINE FloatVector ExitOf(const Node& node) const {
    const auto endless = Splat(std::numeric_limits<float>::infinity());
    const auto side = hn::IfThenElse(is_forward, ToFloat(node.high), ToFloat(node.low));
    const auto border = (axis->wrap == Wrap::mirror ? side * place.way : side) + place.tile;
    auto is_endless = is_still;
    if (axis->wrap == Wrap::clamp) {
      const auto at_low = hn::RebindMask(FloatTag(), node.low == hn::Zero(IntTag()));
      const auto at_high = hn::RebindMask(FloatTag(), node.high == SplatInt(axis->cells));
      is_endless = hn::Or(is_endless, hn::Or(hn::And(is_forward, at_high), hn::AndNot(is_forward, at_low)));
    }
    return hn::IfThenElse(is_endless, endless, (border - start) * inverse_step);
  }

  // Moves to the cell beyond the node where `leaves`, to the cell at depth t within it elsewhere. Returns whether what lies
  // beyond has another parent.
  HWY_INLINE IntMask Move(FloatMask leaves, const Node& node, IntVector level, FloatVector t) {
    const IntTag di;
    const auto out = hn::RebindMask(di, leaves), ahead = hn::RebindMask(di, is_forward);
    const auto one = SplatInt(1);
    const auto inside = hn::Min(hn::Max(FloorToInt(Within(t)), node.low), node.high - one);
    auto beyond = hn::IfThenElse(ahead, node.high, node.low - one);
    const auto border = hn::IfThenElse(ahead, node.high, node.low);
    const auto parent = hn::Shl(SplatInt(2), level) - one;
    auto new_parent = hn::And(border, parent) == hn::Zero(di);
    if (axis->wrap != Wrap::clamp) {
      const auto after = hn::And(out, beyond == SplatInt(axis->cells));
      const auto before = hn::And(out, beyond < hn::Zero(di));
      beyond = axis->wrap == Wrap::repeat ? Repeated(after, before, beyond) : Folded(after, before, beyond);
      new_parent = hn::Or(new_parent, hn::Or(after, before));
    }
    place.cell = hn::IfThenElse(out, beyond, inside);
    return hn::And(out, new_parent);
  }

 private:
  // The cell beyond the last or before the first, in the next repetition, which becomes the place's.
  HWY_INLINE IntVector Repeated(IntMask after, IntMask before, IntVector beyond) {
    const auto side = Splat(static_cast<float>(axis->cells));
    place.tile = hn::IfThenElse(hn::RebindMask(FloatTag(), after), place.tile + side, place.tile);
    place.tile = hn::IfThenElse(hn::RebindMask(FloatTag(), before), place.tile - side, place.tile);
    return hn::IfThenElse(after, hn::Zero(IntTag()),
                          hn::IfThenElse(before, SplatInt(axis->cells - 1), beyond));
  }
  // Folded in the middle of the outermost cells, which the ray has crossed, it comes to the one within, the other way round.
  HWY_INLINE IntVector Folded(IntMask after, IntMask before, IntVector beyond) {
    const auto past_end = hn::RebindMask(FloatTag(), after), past_start = hn::RebindMask(FloatTag(), before);
    const auto last = Splat(static_cast<float>(2 * axis->cells - 1));
    place.tile = hn::IfThenElse(past_end, place.tile + last * place.way, place.tile);
    place.tile = hn::IfThenElse(past_start, place.tile + place.way, place.tile);
    const auto turns = hn::Or(past_end, past_start);
    place.way = hn::IfThenElse(turns, hn::Neg(place.way), place.way);
    is_forward = StepWithin() > Splat(0.0F);
    return hn::IfThenElse(after, SplatInt(axis->cells - 2), hn::IfThenElse(before, SplatInt(1), beyond));
  }
};

// The corners of a cell.
struct CellDepths {
  FloatVector at_00, at_10, at_01, at_11;
};
HWY_INLINE CellDepths DepthsOf(const ReliefField& field, IntVector x, IntVector y) {
  const FloatTag d;
  const auto row = SplatInt(field.x.cells + 1);
  const auto i = y * row + x;
  const float* corners = field.corners.data();
  return {hn::GatherIndex(d, corners, i), hn::GatherIndex(d, corners, i + SplatInt(1)),
          hn::GatherIndex(d, corners, i + row), hn::GatherIndex(d, corners, i + row + SplatInt(1))};
}

// The depth of the relief at points of the lattice.
HWY_INLINE FloatVector ReliefDepthAt(const ReliefField& field, const LatticePoint& p) {
  const auto px = OnLattice(field.x, p.x), py = OnLattice(field.y, p.y);
  const LatticePlace x = PlaceOn(field.x, px), y = PlaceOn(field.y, py);
  const CellDepths c = DepthsOf(field, x.cell, y.cell);
  const auto fx = Saturate(x.Within(field.x, px) - ToFloat(x.cell)),
             fy = Saturate(y.Within(field.y, py) - ToFloat(y.cell));
  const auto above = c.at_00 + (c.at_10 - c.at_00) * fx, below = c.at_01 + (c.at_11 - c.at_01) * fx;
  return above + (below - above) * fy;
}

// Where a ray first meets the surface over one cell, from depth t to t_exit: the depth of the surface along it is a parabola, so
// that this is exact to rounding, which is what refining an interval tends to.
struct CellCrossing {
  FloatVector t;
  FloatMask is_met;
};
HWY_INLINE CellCrossing CrossCell(const ReliefField& field, const AxisWalk& x, const AxisWalk& y,
                                  FloatVector t, FloatVector t_exit) {
  const auto zero = Splat(0.0F), one = Splat(1.0F), two = Splat(2.0F), four = Splat(4.0F);
  const CellDepths cell = DepthsOf(field, x.place.cell, y.place.cell);
  const auto fx = x.Within(t) - ToFloat(x.place.cell), fy = y.Within(t) - ToFloat(y.place.cell);
  const auto step_x = x.StepWithin(), step_y = y.StepWithin();
  const auto along_x = cell.at_10 - cell.at_00, along_y = cell.at_01 - cell.at_00;
  const auto twist = (cell.at_11 - cell.at_10) - along_y;
  const auto depth = cell.at_00 + (fx * along_x + fy * (along_y + fx * twist));
  // Gap between ray and surface at t + s: a s² + b s + c, less than 0 where the ray is above.
  const auto a = hn::Neg(twist * (step_x * step_y));
  const auto b = one - ((step_x * along_x + step_y * along_y) + twist * (fx * step_y + fy * step_x));
  const auto c = t - depth;
  const auto under = b * b - four * (a * c);
  const auto root = hn::Sqrt(hn::Max(under, zero));
  // Its smaller positive root, without cancellation: by −2c / (b + √) where b > 0; elsewhere there is one only where a > 0.
  const auto falls = b > zero;
  const auto numerator = hn::IfThenElse(falls, hn::Neg(two * c), root - b);
  const auto denominator = hn::IfThenElse(falls, b + root, two * a);
  const auto is_real = hn::And(under >= zero, denominator > zero);
  const auto s = numerator / hn::IfThenElse(is_real, denominator, one);
  const auto is_below = c >= zero;
  const auto met = t + hn::IfThenElse(is_below, zero, s);
  return {met, hn::Or(is_below, hn::And(is_real, met <= t_exit))};
}

// The depth at which each ray first meets the relief. What it has not met before `t_end` it does not meet: t_end is then what
// comes back, or less where kMostReliefSteps did not suffice. Only lanes of `asked` are traced.
HWY_INLINE FloatVector TraceRelief(const ReliefField& field, const ReliefRay& ray, FloatVector t_end,
                                   FloatMask asked) {
  const FloatTag d;
  const IntTag di;
  AxisWalk x(field.x, ray.start.x, ray.step.x), y(field.y, ray.start.y, ray.step.y);
  const auto one = SplatInt(1), top = SplatInt(field.levels - 1);
  auto level = top;
  auto t = Splat(0.0F);
  auto walks = hn::And(asked, t < t_end);
  for (int step = 0; step < kMostReliefSteps && !hn::AllFalse(d, walks); ++step) {
    const AxisWalk::Node node_x = x.NodeAt(level), node_y = y.NodeAt(level);
    const auto index = hn::GatherIndex(di, field.first.data(), level) +
                       hn::GatherIndex(di, field.width.data(), level) * hn::Shr(y.place.cell, level) +
                       hn::Shr(x.place.cell, level);
    const auto least = hn::GatherIndex(d, field.least.data(), index);
    const auto exit_x = x.ExitOf(node_x), exit_y = y.ExitOf(node_y);
    const auto exit = hn::Min(hn::Max(hn::Min(exit_x, exit_y), t), t_end);
    const auto dips = exit >= least;  // to where the node may hold something
    const auto is_cell = hn::RebindMask(d, level == hn::Zero(di));
    const auto in_cell = hn::And(walks, hn::And(dips, is_cell));
    auto meets = hn::AndNot(walks, walks);
    if (!hn::AllFalse(d, in_cell)) {
      const CellCrossing crossing = CrossCell(field, x, y, t, exit);
      meets = hn::And(in_cell, crossing.is_met);
      t = hn::IfThenElse(meets, crossing.t, t);
    }
    walks = hn::AndNot(meets, walks);
    const auto descends = hn::And(walks, hn::AndNot(is_cell, dips));
    const auto leaves = hn::AndNot(descends, walks);
    t = hn::IfThenElse(descends, hn::Max(t, least), hn::IfThenElse(leaves, exit, t));
    const auto leaves_x = hn::And(leaves, exit_x <= exit_y), leaves_y = hn::AndNot(exit_x <= exit_y, leaves);
    const auto rises_x = x.Move(leaves_x, node_x, level, t), rises_y = y.Move(leaves_y, node_y, level, t);
    const auto rises = hn::And(hn::Or(rises_x, rises_y), level < top);
    level =
        hn::IfThenElse(hn::RebindMask(di, descends), level - one, hn::IfThenElse(rises, level + one, level));
    walks = hn::And(walks, t < t_end);
  }
  return t;
}

}  // namespace laterna::frame::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
