// The tile stage: edge functions in integers, sixteen samples of a 4 × 4 block at a time.
//
// Coverage. Corners are integers in 1/256 pixel, so an edge function is an exact integer and the top-left rule decides
// every tie: two triangles that share an edge cover each sample on it exactly once. Samples lie on a grid of whole
// pixels, so with E(X, Y) = 256 (a X + b Y) + c and c = 256 c' + r, 0 ≤ r < 256: E ≥ 0 exactly when
// a X + b Y + c' ≥ 0. The factor 256 need not be carried, and all values of a tile fit 32 bits (kGuardBand).
//
// Traversal. Small triangles visit the blocks of their bounding box. Wide ones go down the tile a row of sixteen blocks
// at a time: one comparison per edge tells which blocks of the row the triangle touches, and another which an edge
// crosses (Abrash, Rasterization on Larrabee, 2009, has two such levels; a tile this small needs one). Blocks already
// covered by something nearer are left out (Greene et al., Hierarchical Z-buffer visibility, 1993).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/tile_raster.simd.cc"
#include "base/simd.h"

#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "base/vectors-inl.h"
#include "raster/tile_raster.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::raster::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
using DoubleTag = hn::ScalableTag<double>;
constexpr std::size_t kVectors = kBlockPixels / kLanes;  // per block

alignas(64) constexpr float kLaneX[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr float kLaneY[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
alignas(64) constexpr std::int32_t kLaneXInt[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr std::int32_t kLaneYInt[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
alignas(64) constexpr double kLaneXDouble[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr double kLaneYDouble[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
// First pixels of a row of blocks.
alignas(64) constexpr double kBlockColumn[kBlocksPerSide] = {0,  4,  8,  12, 16, 20, 24, 28,
                                                             32, 36, 40, 44, 48, 52, 56, 60};

// a X + b Y + c ≥ 0 inside, X and Y whole pixels from the view's origin.
struct Edge {
  std::int32_t a, b;
  std::int64_t c;
};

HWY_INLINE void SetUpEdges(const WideTriangle& t, const TileTask& task, Edge* edges) {
  const int sample_x = kSubpixels / 2 + task.offset_x;
  const int sample_y = kSubpixels / 2 + task.offset_y;
  for (int i = 0; i < 3; ++i) {
    const int j = i == 2 ? 0 : i + 1;
    const std::int32_t a = t.y[i] - t.y[j];
    const std::int32_t b = t.x[j] - t.x[i];
    // y grows downward and the corners run clockwise: a left edge runs up (a > 0), a top edge to the right.
    const bool is_top_left = a > 0 || (a == 0 && b > 0);
    const std::int64_t c = std::int64_t{a} * (sample_x - t.x[i]) + std::int64_t{b} * (sample_y - t.y[i]);
    edges[i] = {a, b, (c - (is_top_left ? 0 : 1)) >> kSubpixelBits};
  }
}

// ---------------------------------------------------------------------------------------------- sinks

// A sink takes the covered samples of a block: `VisitVector` for one vector of lanes, which says whether any was taken,
// and for cut-outs `Passing`, what of a vector would be taken, `Takes`, the same of one sample that may have been pushed
// back, and `Write` for it. `Farthest`: the least reversed depth of a block.
HWY_INLINE float FarthestOf(const float* depth) {
  const FloatTag d;
  auto least = hn::Load(d, depth);
  for (std::size_t k = 1; k < kVectors; ++k) least = hn::Min(least, hn::Load(d, depth + k * kLanes));
  return hn::GetLane(hn::MinOfLanes(d, least));
}

class DepthSink {
 public:
  static constexpr bool kOccludes = true;
  explicit DepthSink(float* depth) : depth_(depth) {}
  static bool Takes(std::uint32_t kind) { return (kind & kBlended) == 0; }
  void Begin(TriangleId) {}

  HWY_INLINE bool VisitVector(std::size_t sample, FloatMask inside, FloatVector q) {
    const FloatTag d;
    const auto passing = Passing(sample, inside, q);
    if (hn::AllFalse(d, passing)) return false;
    hn::Store(hn::IfThenElse(passing, q, hn::Load(d, depth_ + sample)), d, depth_ + sample);
    return true;
  }
  [[nodiscard]] float Farthest(std::size_t block) const { return FarthestOf(depth_ + block); }
  HWY_INLINE FloatMask Passing(std::size_t sample, FloatMask inside, FloatVector q) const {
    return hn::And(inside, q > hn::Load(FloatTag(), depth_ + sample));
  }
  [[nodiscard]] bool Takes(std::size_t sample, float q) const { return q > depth_[sample]; }
  void Write(std::size_t sample, float q) { depth_[sample] = q; }

 private:
  float* depth_;
};

class VisibilitySink {
 public:
  static constexpr bool kOccludes = true;
  VisibilitySink(float* depth, TriangleId* ids) : depth_(depth), ids_(ids) {}
  static bool Takes(std::uint32_t kind) { return (kind & kBlended) == 0; }
  void Begin(TriangleId id) { id_ = id; }

  HWY_INLINE bool VisitVector(std::size_t sample, FloatMask inside, FloatVector q) {
    const FloatTag d;
    const IntTag di;
    const auto passing = Passing(sample, inside, q);
    if (hn::AllFalse(d, passing)) return false;
    auto* ids = reinterpret_cast<std::int32_t*>(ids_ + sample);
    const auto id = hn::Set(di, static_cast<std::int32_t>(id_));
    hn::Store(hn::IfThenElse(passing, q, hn::Load(d, depth_ + sample)), d, depth_ + sample);
    hn::Store(hn::IfThenElse(hn::RebindMask(di, passing), id, hn::Load(di, ids)), di, ids);
    return true;
  }
  [[nodiscard]] float Farthest(std::size_t block) const { return FarthestOf(depth_ + block); }
  HWY_INLINE FloatMask Passing(std::size_t sample, FloatMask inside, FloatVector q) const {
    const FloatTag d;
    const IntTag di;
    const auto old = hn::Load(d, depth_ + sample);
    const auto passing = hn::And(inside, q >= old);
    if (hn::AllFalse(d, passing)) return passing;
    const auto tied = hn::And(passing, q == old);
    if (HWY_LIKELY(hn::AllFalse(d, tied))) return passing;
    // Unsigned order, so that the background's id, all ones, loses. Flipping the sign bit of both compares so.
    const auto sign = hn::Set(di, std::int32_t{-0x7FFFFFFF - 1});
    const auto id = hn::Set(di, static_cast<std::int32_t>(id_));
    const auto old_ids = hn::Load(di, reinterpret_cast<const std::int32_t*>(ids_ + sample));
    const auto wins = hn::RebindMask(d, hn::Xor(id, sign) < hn::Xor(old_ids, sign));
    return hn::And(passing, hn::Or(q > old, wins));
  }
  [[nodiscard]] bool Takes(std::size_t sample, float q) const {
    return q > depth_[sample] || (q == depth_[sample] && id_ < ids_[sample]);
  }
  void Write(std::size_t sample, float q) {
    depth_[sample] = q;
    ids_[sample] = id_;
  }

 private:
  float* depth_;
  TriangleId* ids_;
  TriangleId id_ = kNoTriangle;
};

class FragmentSink {
 public:
  static constexpr bool kOccludes = false;
  FragmentSink(const float* depth, std::vector<Fragment>& fragments) : depth_(depth), fragments_(fragments) {}
  static bool Takes(std::uint32_t kind) { return (kind & kBlended) != 0; }
  void Begin(TriangleId id) { id_ = id; }

  HWY_INLINE bool VisitVector(std::size_t sample, FloatMask inside, FloatVector q) {
    const FloatTag d;
    const auto passing = hn::And(inside, q > hn::Load(d, depth_ + sample));
    if (hn::AllFalse(d, passing)) return false;
    alignas(64) float depths[kLanes];
    hn::Store(q, d, depths);
    for (std::uint32_t mask = BitsOf(passing); mask != 0; mask &= mask - 1) {
      const auto i = static_cast<std::size_t>(__builtin_ctz(mask));
      fragments_.push_back({static_cast<std::uint32_t>(sample + i), id_, depths[i]});
    }
    return true;
  }
  // What lies behind an opaque surface is left out by its depth alone.
  [[nodiscard]] float Farthest(std::size_t block) const { return FarthestOf(depth_ + block); }
  // Blended triangles are never cut while rasterising: their alpha weighs them in shading.
  static HWY_INLINE FloatMask Passing(std::size_t, FloatMask inside, FloatVector) { return inside; }
  static bool Takes(std::size_t, float) { return false; }
  static void Write(std::size_t, float) {}

 private:
  const float* depth_;
  std::vector<Fragment>& fragments_;
  TriangleId id_ = kNoTriangle;
};

// ---------------------------------------------------------------------------------------------- traversal

// Depth of a wide triangle, in double until the last rounding.
class WideDepth {
 public:
  WideDepth(const WideTriangle& t, double x, double y)
      : q_dy_(t.q_dy), y_(y), q_min_(t.q_min), q_max_(t.q_max) {
    const DoubleTag dd;
    const auto q_dx = hn::Set(dd, t.q_dx), q_dy = hn::Set(dd, t.q_dy);
    for (std::size_t k = 0; k < kDoubles; ++k) {
      const std::size_t i = k * hn::MaxLanes(dd);
      lane_[k] = q_dx * hn::Load(dd, kLaneXDouble + i) + q_dy * hn::Load(dd, kLaneYDouble + i);
      column_[k] = hn::Set(dd, t.q_0) + q_dx * (hn::Set(dd, x) + hn::Load(dd, kBlockColumn + i));
    }
    const double reach_x = t.q_dx * (kBlockSide - 1), reach_y = t.q_dy * (kBlockSide - 1);
    reach_high_ = static_cast<float>(std::max(reach_x, 0.0) + std::max(reach_y, 0.0));
    reach_low_ = static_cast<float>(std::min(reach_x, 0.0) + std::min(reach_y, 0.0));
  }

  // Bounds of a row of blocks: no sample that the triangle covers is nearer or farther.
  struct Bounds {
    FloatVector nearest[kVectors], farthest[kVectors];
  };
  // Row `by` pixels down the tile: keeps the depths of its blocks' first samples.
  HWY_INLINE Bounds EnterRow(int by) {
    const FloatTag d;
    const DoubleTag dd;
    const auto y_part = hn::Set(dd, q_dy_ * (y_ + by));
    hn::Vec<DoubleTag> first[kDoubles];
    for (std::size_t k = 0; k < kDoubles; ++k) {
      first[k] = column_[k] + y_part;
      hn::Store(first[k], dd, row_ + k * hn::MaxLanes(dd));
    }
    // More than all roundings.
    const auto slack = hn::Set(d, 1e-6F);
    const auto high = hn::Set(d, reach_high_), low = hn::Set(d, reach_low_);
    Bounds bounds;
    for (std::size_t k = 0; k < kVectors; ++k) {
      const auto q = Rounded(d, first + k * kDoublesPerVector);
      const auto error = (hn::Abs(q) + (high - low)) * slack;
      bounds.nearest[k] = Held(q + (high + error));
      bounds.farthest[k] = Held(q + (low - error));
    }
    return bounds;
  }

  // Vector k of the row's block number `column`.
  HWY_INLINE FloatVector At(std::size_t column, std::size_t k) const {
    const FloatTag d;
    const auto first = hn::Set(DoubleTag(), row_[column]);
    hn::Vec<DoubleTag> q[kDoublesPerVector];
    for (std::size_t i = 0; i < kDoublesPerVector; ++i) q[i] = first + lane_[k * kDoublesPerVector + i];
    return Held(Rounded(d, q));
  }

 private:
  static constexpr std::size_t kDoubles = kBlockPixels / hn::MaxLanes(DoubleTag());
  static constexpr std::size_t kDoublesPerVector = kLanes / hn::MaxLanes(DoubleTag());

  template <class D>  // a FloatTag: the branch not taken would not compile
  static HWY_INLINE hn::Vec<D> Rounded(D d, const hn::Vec<DoubleTag>* q) {
    const hn::Rebind<float, DoubleTag> part;
    if constexpr (kDoublesPerVector == 1) {
      return hn::DemoteTo(d, q[0]);
    } else {
      return Combine(d, hn::DemoteTo(part, q[1]), hn::DemoteTo(part, q[0]));
    }
  }
  [[nodiscard]] HWY_INLINE FloatVector Held(FloatVector q) const {
    const FloatTag d;
    return hn::Min(hn::Max(q, hn::Set(d, q_min_)), hn::Set(d, q_max_));
  }

  double q_dy_;
  double y_;  // of the tile's first sample
  float q_min_, q_max_;
  float reach_high_, reach_low_;         // from a block's first sample to its others
  hn::Vec<DoubleTag> lane_[kDoubles];    // from a block's first sample to each
  hn::Vec<DoubleTag> column_[kDoubles];  // q without its part in y, of the first samples of a row of blocks
  alignas(64) double row_[kBlocksPerSide];
};

// Edge functions of a wide triangle, at a row of blocks.
class WideEdges {
 public:
  WideEdges(const Edge* edges, int tile_x, int tile_y, int by) {
    const IntTag di;
    for (int i = 0; i < 3; ++i) {
      const Edge& edge = edges[i];
      // Beyond ±2³⁰ the sign is the same all over the tile, so it may be held there.
      const std::int64_t at_tile = std::int64_t{edge.a} * tile_x + std::int64_t{edge.b} * tile_y + edge.c;
      const auto e = static_cast<std::int32_t>(
          std::clamp<std::int64_t>(at_tile, -(std::int64_t{1} << 30), std::int64_t{1} << 30));
      const auto a = hn::Set(di, edge.a), b = hn::Set(di, edge.b);
      for (std::size_t k = 0; k < kVectors; ++k) {
        lane_[i][k] = a * hn::Load(di, kLaneXInt + k * kLanes) + b * hn::Load(di, kLaneYInt + k * kLanes);
        row_[i][k] = hn::Set(di, e + edge.b * by) +
                     hn::ShiftLeft<2>(a) * (hn::Iota(di, static_cast<std::int32_t>(k * kLanes)));
      }
      step_[i] = edge.b * kBlockSide;
      reach_high_[i] = (std::max(edge.a, 0) + std::max(edge.b, 0)) * (kBlockSide - 1);
      reach_low_[i] = (std::min(edge.a, 0) + std::min(edge.b, 0)) * (kBlockSide - 1);
    }
  }

  // Blocks of the row, a bit each.
  struct Row {
    std::uint32_t touched = 0;  // by the triangle
    std::uint32_t crossed = 0;  // by one of its edges
  };
  HWY_INLINE Row Enter() {
    const IntTag di;
    Row row;
    for (std::size_t k = 0; k < kVectors; ++k) {
      auto outside = hn::Zero(di), crossing = hn::Zero(di);
      for (int i = 0; i < 3; ++i) {
        hn::Store(row_[i][k], di, first_[i] + k * kLanes);
        outside = hn::Or(outside, row_[i][k] + hn::Set(di, reach_high_[i]));
        crossing = hn::Or(crossing, row_[i][k] + hn::Set(di, reach_low_[i]));
      }
      row.touched |= BitsOf(hn::Not(outside < hn::Zero(di))) << (k * kLanes);
      row.crossed |= BitsOf(crossing < hn::Zero(di)) << (k * kLanes);
    }
    return row;
  }
  HWY_INLINE void Leave() {
    const IntTag di;
    for (int i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < kVectors; ++k) row_[i][k] = row_[i][k] + hn::Set(di, step_[i]);
    }
  }

  // Vector k of the row's block number `column`.
  HWY_INLINE FloatMask Inside(std::size_t column, std::size_t k) const {
    const FloatTag d;
    const IntTag di;
    auto negative = hn::Set(di, first_[0][column]) + lane_[0][k];
    for (int i = 1; i < 3; ++i) negative = hn::Or(negative, hn::Set(di, first_[i][column]) + lane_[i][k]);
    return hn::RebindMask(d, hn::Not(negative < hn::Zero(di)));
  }

 private:
  IntVector lane_[3][kVectors];  // from a block's first sample to each
  IntVector row_[3][kVectors];   // at the first samples of a row's blocks
  std::int32_t step_[3];         // to the next row
  std::int32_t reach_high_[3], reach_low_[3];
  alignas(64) std::int32_t first_[3][kBlocksPerSide];
};

template <class Sink>
class TileRaster {
 public:
  TileRaster(const TileTask& task, Sink sink)
      : task_(task),
        sink_(sink),
        tile_x_(task.tile_x * kTileSide - task.view->origin_x),
        tile_y_(task.tile_y * kTileSide - task.view->origin_y),
        offset_x_(static_cast<float>(task.offset_x) / kSubpixels),
        offset_y_(static_cast<float>(task.offset_y) / kSubpixels) {
    std::fill_n(farthest_, kBlocks, task.view->reversed_far);
    // What is drawn over stays as it is.
    if (!Sink::kOccludes) LookHowFar();
  }

  void DrawAll() {
    for (const bool with_holes : {false, true}) {
      for (const Batch& batch : task_.batches) {
        DrawEach<WideTriangle>(batch.wide, batch.wide_by_tile, with_holes,
                               [&](const WideTriangle& t) HWY_ATTR { DrawWide(t); });
        DrawEach<SmallTriangle>(batch.small, batch.small_by_tile, with_holes,
                                [&](const SmallTriangle& t) HWY_ATTR { DrawSmall(t); });
      }
    }
  }

 private:
  static constexpr std::size_t kBlocks = std::size_t{kBlocksPerSide} * kBlocksPerSide;
  static constexpr std::size_t kPrefetched = 12;  // triangles
  // Looking at all of a tile's samples costs as much as a few dozen triangles.
  static constexpr std::size_t kDrawnBeforeLook = 128;

  template <class Triangle, class Draw>
  HWY_INLINE void DrawEach(std::span<const Triangle> triangles, const TileLists& by_tile, bool with_holes,
                           Draw draw) {
    const TileLists::List list = by_tile.in_tile(task_.tile_x, task_.tile_y, with_holes);
    const std::span<const std::uint32_t> here = list.triangles;
    if (here.empty()) return;
    if (Sink::kOccludes && drawn_ >= kDrawnBeforeLook) LookHowFar();
    if (list.nearest < FarthestOfAll()) return;
    drawn_ += here.size();
    // Records were written by another pass, perhaps by another processor: they come from afar.
    for (std::size_t i = 0; i < std::min(kPrefetched, here.size()); ++i) hwy::Prefetch(&triangles[here[i]]);
    for (std::size_t i = 0; i < here.size(); ++i) {
      if (i + kPrefetched < here.size()) hwy::Prefetch(&triangles[here[i + kPrefetched]]);
      const Triangle& t = triangles[here[i]];
      if (!Sink::Takes(t.kind)) continue;
      sink_.Begin(t.id);
      draw(t);
      if (HWY_UNLIKELY(asked_.count != 0)) Cut(t.id);
    }
  }

  // Small triangles side by side hide what is behind them, but none does so by itself.
  HWY_NOINLINE void LookHowFar() {
    for (std::size_t block = 0; block < kBlocks; ++block) {
      farthest_[block] = sink_.Farthest(block * kBlockPixels);
    }
    drawn_ = 0;
  }

  [[nodiscard]] HWY_INLINE float FarthestOfAll() const {
    const FloatTag d;
    auto least = hn::Load(d, farthest_);
    for (std::size_t i = kLanes; i < kBlocks; i += kLanes) least = hn::Min(least, hn::Load(d, farthest_ + i));
    return hn::GetLane(hn::MinOfLanes(d, least));
  }

  // Whether the alpha cut must be asked about triangles of this kind.
  [[nodiscard]] bool IsCut(std::uint32_t kind) const { return (kind & kMasked) != 0 && task_.cut != nullptr; }

  // Pixels of the tile whose sample the bounding box may hold.
  [[nodiscard]] Rect BoxOf(const WideTriangle& t) const {
    const PixelSpan x = pixels_between(t.x, task_.offset_x, task_.offset_x),
                    y = pixels_between(t.y, task_.offset_y, task_.offset_y);
    return overlap({x.begin - tile_x_, y.begin - tile_y_, x.end - tile_x_, y.end - tile_y_},
                   {0, 0, kTileSide, kTileSide});
  }

  // The edge functions over the first block of a small triangle, and their change from block to block, in pixels. All
  // are whole numbers below 2²⁴ in magnitude: exact in float.
  struct SmallEdges {
    FloatVector at[3][kVectors], dx[3], dy[3];
  };

  // (x, y): from the triangle's first pixel to the block's, in pixels.
  HWY_INLINE SmallEdges EdgesOf(const SmallTriangle& t, int x, int y) const {
    const FloatTag d;
    SmallEdges edges;
    float dx[3] = {t.edge_dx[0], t.edge_dx[1], -(t.edge_dx[0] + t.edge_dx[1])};
    float dy[3] = {t.edge_dy[0], t.edge_dy[1], -(t.edge_dy[0] + t.edge_dy[1])};
    for (int i = 0; i < 3; ++i) {
      const int shift = static_cast<int>(dx[i]) * task_.offset_x + static_cast<int>(dy[i]) * task_.offset_y;
      const float at = static_cast<float>((t.edge[i] + shift) >> kSubpixelBits) +
                       (dx[i] * static_cast<float>(x) + dy[i] * static_cast<float>(y));
      const auto dx_lanes = hn::Set(d, dx[i]), dy_lanes = hn::Set(d, dy[i]);
      for (std::size_t k = 0; k < kVectors; ++k) {
        edges.at[i][k] = hn::Set(d, at) + (dx_lanes * hn::Load(d, kLaneX + k * kLanes) +
                                           dy_lanes * hn::Load(d, kLaneY + k * kLanes));
      }
      edges.dx[i] = dx_lanes * hn::Set(d, kBlockSide);
      edges.dy[i] = dy_lanes * hn::Set(d, kBlockSide);
    }
    return edges;
  }

  void DrawSmall(const SmallTriangle& t) {
    const FloatTag d;
    const int x = t.x - tile_x_, y = t.y - tile_y_;  // in the tile
    const int x_first = std::max(x, 0) & ~3, x_end = std::min(x + t.columns, kTileSide);
    const int y_first = std::max(y, 0) & ~3, y_end = std::min(y + t.rows, kTileSide);
    const bool is_in_one_block = x_end - x_first <= kBlockSide && y_end - y_first <= kBlockSide;
    if (is_in_one_block && t.q_max < farthest_[BlockAt(x_first, y_first)]) return;
    SmallEdges edges = EdgesOf(t, x_first - x, y_first - y);
    FloatVector lane_q[kVectors];
    for (std::size_t k = 0; k < kVectors; ++k) {
      lane_q[k] = hn::Set(d, t.q_dx) * hn::Load(d, kLaneX + k * kLanes) +
                  hn::Set(d, t.q_dy) * hn::Load(d, kLaneY + k * kLanes);
    }
    const auto q_min = hn::Set(d, t.q_min), q_max = hn::Set(d, t.q_max);
    const bool is_cut = IsCut(t.kind);
    for (int by = y_first; by < y_end; by += kBlockSide) {
      FloatVector e[3][kVectors];
      for (int i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < kVectors; ++k) {
          e[i][k] = edges.at[i][k];
          edges.at[i][k] = edges.at[i][k] + edges.dy[i];
        }
      }
      const float q_row = t.q + t.q_dy * (static_cast<float>(by - y) + offset_y_);
      for (int bx = x_first; bx < x_end; bx += kBlockSide) {
        const std::size_t block = BlockAt(bx, by);
        if (t.q_max >= farthest_[block]) {
          const float q = q_row + t.q_dx * (static_cast<float>(bx - x) + offset_x_);
          const auto inside = [&](std::size_t k) HWY_ATTR {
            return hn::Min(hn::Min(e[0][k], e[1][k]), e[2][k]) >= hn::Zero(d);
          };
          const auto depth = [&](std::size_t k) HWY_ATTR {
            return hn::Min(hn::Max(hn::Set(d, q) + lane_q[k], q_min), q_max);
          };
          VisitBlock(block, bx, by, t.id, is_cut, inside, depth);
        }
        for (int i = 0; i < 3; ++i) {
          for (std::size_t k = 0; k < kVectors; ++k) e[i][k] = e[i][k] + edges.dx[i];
        }
      }
    }
  }

  void DrawWide(const WideTriangle& t) {
    const Rect box = BoxOf(t);
    if (box.is_empty()) return;
    Edge edges[3];
    SetUpEdges(t, task_, edges);
    const int by_first = box.y_begin & ~3;
    WideEdges wide_edges(edges, tile_x_, tile_y_, by_first);
    WideDepth depth(t, tile_x_ + 0.5 + offset_x_, tile_y_ + 0.5 + offset_y_);
    const std::uint32_t columns = (2U << ((box.x_end - 1) >> 2)) - (1U << (box.x_begin >> 2));
    for (int by = by_first; by < box.y_end; by += kBlockSide) {
      const WideEdges::Row row = wide_edges.Enter();
      if ((row.touched & columns) != 0) {
        DrawRow(t, by, wide_edges, {row.touched & columns, row.crossed}, depth);
      }
      wide_edges.Leave();
    }
  }

  void DrawRow(const WideTriangle& t, int by, const WideEdges& edges, const WideEdges::Row& row,
               WideDepth& depth) {
    const FloatTag d;
    const std::size_t first = BlockAt(0, by);
    const WideDepth::Bounds bounds = depth.EnterRow(by);
    const bool is_cut = IsCut(t.kind);
    std::uint32_t hidden = 0;
    for (std::size_t k = 0; k < kVectors; ++k) {
      const auto farthest = hn::Load(d, farthest_ + first + k * kLanes);
      hidden |= BitsOf(bounds.nearest[k] < farthest) << (k * kLanes);
    }
    const std::uint32_t drawn = row.touched & ~hidden;
    for (std::uint32_t mask = drawn; mask != 0; mask &= mask - 1) {
      const auto column = static_cast<std::size_t>(__builtin_ctz(mask));
      const bool is_crossed = (row.crossed >> column & 1U) != 0;
      const auto inside = [&](std::size_t k) HWY_ATTR {
        return is_crossed ? edges.Inside(column, k)
                          : hn::RebindMask(d, hn::MaskFromVec(hn::Set(IntTag(), -1)));
      };
      const auto q = [&](std::size_t k) HWY_ATTR { return depth.At(column, k); };
      VisitBlock(first + column, static_cast<int>(column) * kBlockSide, by, t.id, is_cut, inside, q);
    }
    if (!Sink::kOccludes || is_cut) return;
    for (std::size_t k = 0; k < kVectors; ++k) {
      const auto whole = MaskFromBits((drawn & ~row.crossed) >> (k * kLanes));
      float* farthest = farthest_ + first + k * kLanes;
      const auto old = hn::Load(d, farthest);
      hn::Store(hn::IfThenElse(whole, hn::Max(old, bounds.farthest[k]), old), d, farthest);
    }
  }

  static std::size_t BlockAt(int bx, int by) {
    return static_cast<std::size_t>((by >> 2) * kBlocksPerSide + (bx >> 2));
  }

  template <class Inside, class Depth>
  HWY_INLINE void VisitBlock(std::size_t block, int bx, int by, TriangleId id, bool is_cut,
                             const Inside& inside, const Depth& depth) {
    const FloatTag d;
    if (HWY_UNLIKELY(is_cut)) {
      VisitCutBlock(block * kBlockPixels, bx, by, id, inside, depth);
      return;
    }
    bool is_covered = false, is_taken = false;
    for (std::size_t k = 0; k < kVectors; ++k) {
      const auto covered = inside(k);
      if (hn::AllFalse(d, covered)) continue;
      is_covered = true;
      is_taken |= sink_.VisitVector(block * kBlockPixels + k * kLanes, covered, depth(k));
    }
    // In vain: what hides this triangle may hide the next.
    if (is_covered && !is_taken) farthest_[block] = sink_.Farthest(block * kBlockPixels);
  }

  // Puts the block's samples that would be taken on the list: the cut is asked about a triangle's samples all at once.
  template <class Inside, class Depth>
  HWY_NOINLINE void VisitCutBlock(std::size_t block, int bx, int by, TriangleId id, const Inside& inside,
                                  const Depth& depth) {
    const FloatTag d;
    if (asked_.count > CutSamples::kMost - kBlockPixels) Cut(id);
    const float x = static_cast<float>(tile_x_ + bx) + (0.5F + offset_x_),
                y = static_cast<float>(tile_y_ + by) + (0.5F + offset_y_);
    for (std::size_t k = 0; k < kVectors; ++k) {
      const auto covered = inside(k);
      if (hn::AllFalse(d, covered)) continue;
      const auto q = depth(k);
      alignas(64) float depths[kLanes];
      hn::Store(q, d, depths);
      std::uint32_t mask = BitsOf(sink_.Passing(block + k * kLanes, covered, q));
      for (; mask != 0; mask &= mask - 1) {
        const auto lane = static_cast<std::size_t>(__builtin_ctz(mask));
        const std::size_t i = k * kLanes + lane;
        asked_.x[asked_.count] = x + kLaneX[i];
        asked_.y[asked_.count] = y + kLaneY[i];
        asked_.reversed_depth[asked_.count] = depths[lane];
        asked_samples_[asked_.count++] = static_cast<std::uint32_t>(block + i);
      }
    }
  }

  // Draws what the cut keeps of the list.
  HWY_NOINLINE void Cut(TriangleId id) {
    for (std::size_t i = asked_.count; i < asked_.groups() * 16; ++i) {
      asked_.x[i] = asked_.x[0];
      asked_.y[i] = asked_.y[0];
      asked_.reversed_depth[i] = asked_.reversed_depth[0];
    }
    std::array<std::uint16_t, CutSamples::kMost / 16> kept;
    task_.cut->keep(id, asked_, kept.data());
    for (std::size_t i = 0; i < asked_.count; ++i) {
      if ((kept[i / 16] >> (i % 16) & 1U) == 0) continue;
      if (!sink_.Takes(asked_samples_[i], asked_.reversed_depth[i])) continue;
      sink_.Write(asked_samples_[i], asked_.reversed_depth[i]);
    }
    asked_.count = 0;
  }

  const TileTask& task_;
  Sink sink_;
  std::size_t drawn_ = 0;                // triangles since farthest_ was found from the samples
  int tile_x_, tile_y_;                  // first pixel of the tile, from the view's origin
  float offset_x_, offset_y_;            // of the sample from its pixel's centre
  alignas(64) float farthest_[kBlocks];  // every sample of the block is at least this near
  CutSamples asked_;                     // of the triangle that is being drawn, if it is cut
  std::array<std::uint32_t, CutSamples::kMost> asked_samples_;  // where they lie in the tile
};

void rasterise_depth(const TileTask& task, float* depth) {
  TileRaster<DepthSink>(task, DepthSink(depth)).DrawAll();
}

void rasterise_visibility(const TileTask& task, float* depth, TriangleId* ids) {
  TileRaster<VisibilitySink>(task, VisibilitySink(depth, ids)).DrawAll();
}

void rasterise_fragments(const TileTask& task, const float* depth, std::vector<Fragment>& fragments) {
  TileRaster<FragmentSink>(task, FragmentSink(depth, fragments)).DrawAll();
}

}  // namespace laterna::raster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::raster {

LATERNA_KERNEL_TABLE(rasterise_depth)
LATERNA_KERNEL_TABLE(rasterise_visibility)
LATERNA_KERNEL_TABLE(rasterise_fragments)

}  // namespace laterna::raster
#endif
