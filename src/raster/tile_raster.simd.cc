// The tile stage: edge functions in integers, sixteen samples of a 4 × 4 block at a time.
//
// Coverage. Corners are integers in 1/256 pixel, so an edge function is an exact integer and the top-left rule decides
// every tie: two triangles that share an edge cover each sample on it exactly once. Samples lie on a grid of whole
// pixels, so with E(X, Y) = 256 (a X + b Y) + c and c = 256 c' + r, 0 ≤ r < 256: E ≥ 0 exactly when
// a X + b Y + c' ≥ 0. The factor 256 need not be carried, and all values of a tile fit 32 bits (kGuardBand).
//
// Traversal. Small triangles visit the blocks of their bounding box. Wide ones descend 64 → 16 → 4 pixels, sixteen
// cells a step, leaving out cells outside an edge and edges that a cell lies wholly inside of (Abrash, Rasterization
// on Larrabee, 2009). Cells already covered by something nearer are left out as a whole (Greene et al., Hierarchical
// Z-buffer visibility, 1993).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/tile_raster.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "raster/tile_raster.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::raster::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 16>;
using IntTag = hn::RebindToSigned<FloatTag>;
using DoubleTag = hn::ScalableTag<double>;
using FloatVector = hn::Vec<FloatTag>;
using IntVector = hn::Vec<IntTag>;
using FloatMask = hn::Mask<FloatTag>;
constexpr std::size_t kLanes = hn::MaxLanes(FloatTag());
constexpr std::size_t kVectors = kBlockPixels / kLanes;  // per block

alignas(64) constexpr float kLaneX[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr float kLaneY[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
alignas(64) constexpr std::int32_t kLaneXInt[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) constexpr std::int32_t kLaneYInt[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

// a X + b Y + c ≥ 0 inside, X and Y whole pixels from the view's origin.
struct Edge {
  std::int32_t a, b;
  std::int64_t c;
};

HWY_INLINE void SetUpEdges(const BinnedTriangle& t, const TileTask& task, Edge* edges) {
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

// A sink takes the covered samples of a block: `VisitVector` for one vector of lanes, and for cut-outs `Passing` and
// `Write` with a bit per sample.
class DepthSink {
 public:
  static constexpr bool kOccludes = true;
  explicit DepthSink(float* depth) : depth_(depth) {}
  static bool Takes(std::uint32_t kind) { return (kind & kBlended) == 0; }
  void Begin(TriangleId) {}

  HWY_INLINE void VisitVector(std::size_t sample, FloatMask inside, FloatVector q) {
    const FloatTag d;
    const auto old = hn::Load(d, depth_ + sample);
    hn::Store(hn::IfThenElse(hn::And(inside, q > old), q, old), d, depth_ + sample);
  }
  std::uint32_t Passing(std::size_t block, const float* q, std::uint32_t mask) const {
    std::uint32_t passing = 0;
    for (std::size_t i = 0; i < kBlockPixels; ++i) passing |= std::uint32_t{q[i] > depth_[block + i]} << i;
    return passing & mask;
  }
  void Write(std::size_t block, const float* q, std::uint32_t mask) {
    for (std::size_t i = 0; i < kBlockPixels; ++i) {
      if ((mask >> i & 1U) != 0) depth_[block + i] = q[i];
    }
  }

 private:
  float* depth_;
};

class VisibilitySink {
 public:
  static constexpr bool kOccludes = true;
  VisibilitySink(float* depth, TriangleId* ids) : depth_(depth), ids_(ids) {}
  static bool Takes(std::uint32_t kind) { return (kind & kBlended) == 0; }
  void Begin(TriangleId id) { id_ = id; }

  HWY_INLINE void VisitVector(std::size_t sample, FloatMask inside, FloatVector q) {
    const FloatTag d;
    const IntTag di;
    auto* ids = reinterpret_cast<std::int32_t*>(ids_ + sample);
    const auto old = hn::Load(d, depth_ + sample);
    auto passing = hn::And(inside, q >= old);
    if (hn::AllFalse(d, passing)) return;
    const auto old_ids = hn::Load(di, ids);
    const auto id = hn::Set(di, static_cast<std::int32_t>(id_));
    const auto tied = hn::And(passing, q == old);
    if (HWY_UNLIKELY(!hn::AllFalse(d, tied))) {
      // Unsigned order, so that the background's id, all ones, loses. Flipping the sign bit of both compares so.
      const auto sign = hn::Set(di, std::int32_t{-0x7FFFFFFF - 1});
      const auto wins = hn::RebindMask(d, hn::Xor(id, sign) < hn::Xor(old_ids, sign));
      passing = hn::And(passing, hn::Or(q > old, wins));
    }
    hn::Store(hn::IfThenElse(passing, q, old), d, depth_ + sample);
    hn::Store(hn::IfThenElse(hn::RebindMask(di, passing), id, old_ids), di, ids);
  }
  std::uint32_t Passing(std::size_t block, const float* q, std::uint32_t mask) const {
    std::uint32_t passing = 0;
    for (std::size_t i = 0; i < kBlockPixels; ++i) {
      const float old = depth_[block + i];
      const bool passes = q[i] > old || (q[i] == old && id_ < ids_[block + i]);
      passing |= std::uint32_t{passes} << i;
    }
    return passing & mask;
  }
  void Write(std::size_t block, const float* q, std::uint32_t mask) {
    for (std::size_t i = 0; i < kBlockPixels; ++i) {
      if ((mask >> i & 1U) == 0) continue;
      depth_[block + i] = q[i];
      ids_[block + i] = id_;
    }
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

  HWY_INLINE void VisitVector(std::size_t sample, FloatMask inside, FloatVector q) {
    const FloatTag d;
    const auto passing = hn::And(inside, q > hn::Load(d, depth_ + sample));
    if (hn::AllFalse(d, passing)) return;
    alignas(64) float depths[kLanes];
    hn::Store(q, d, depths);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, passing, bits);
    for (std::uint32_t mask = bits[0] | std::uint32_t{bits[1]} << 8U; mask != 0; mask &= mask - 1) {
      const auto i = static_cast<std::size_t>(__builtin_ctz(mask));
      fragments_.push_back({static_cast<std::uint32_t>(sample + i), id_, depths[i]});
    }
  }
  // Blended triangles are never cut while rasterising: their alpha weighs them in shading.
  static std::uint32_t Passing(std::size_t, const float*, std::uint32_t mask) { return mask; }
  static void Write(std::size_t, const float*, std::uint32_t) {}

 private:
  const float* depth_;
  std::vector<Fragment>& fragments_;
  TriangleId id_ = kNoTriangle;
};

// ---------------------------------------------------------------------------------------------- traversal

template <class Sink>
class TileRaster {
 public:
  TileRaster(const TileTask& task, Sink sink)
      : task_(task),
        sink_(sink),
        tile_x_(task.tile_x * kTileSide - task.view->origin_x),
        tile_y_(task.tile_y * kTileSide - task.view->origin_y),
        sample_x_(0.5 + task.offset_x / double{kSubpixels}),
        sample_y_(0.5 + task.offset_y / double{kSubpixels}) {
    std::fill_n(covered_, 16, task.view->reversed_far);
  }

  void DrawAll() {
    for (const Batch& batch : task_.batches) {
      for (const std::uint32_t i : batch.in_tile(task_.tile_x, task_.tile_y)) {
        const BinnedTriangle& t = batch.triangles[i];
        if (!Sink::Takes(t.kind)) continue;
        sink_.Begin(t.id);
        if ((t.kind & kWide) != 0) {
          DrawWide(t, batch.planes[t.plane]);
        } else {
          DrawSmall(t);
        }
      }
    }
  }

 private:
  // Whether the alpha cut must be asked about this triangle.
  [[nodiscard]] bool IsCut(const BinnedTriangle& t) const {
    return (t.kind & kMasked) != 0 && task_.cut != nullptr;
  }

  void DrawSmall(const BinnedTriangle& t) {
    const FloatTag d;
    // First and last pixel of the bounding box whose sample may be covered, within the tile.
    const auto first = [](const std::int32_t* v, int offset, int tile) {
      return std::max(((std::min({v[0], v[1], v[2]}) + kSubpixels / 2 - 1 - offset) >> kSubpixelBits) - tile,
                      0);
    };
    const auto last = [](const std::int32_t* v, int offset, int tile) {
      return std::min(((std::max({v[0], v[1], v[2]}) - kSubpixels / 2 - offset) >> kSubpixelBits) - tile,
                      kTileSide - 1);
    };
    const int x0 = first(t.x, task_.offset_x, tile_x_), x1 = last(t.x, task_.offset_x, tile_x_);
    const int y0 = first(t.y, task_.offset_y, tile_y_), y1 = last(t.y, task_.offset_y, tile_y_);
    if (x0 > x1 || y0 > y1) return;

    Edge edges[3];
    SetUpEdges(t, task_, edges);
    FloatVector lane_e[3][kVectors];
    FloatVector lane_q[kVectors];
    for (std::size_t k = 0; k < kVectors; ++k) {
      const auto lane_x = hn::Load(d, kLaneX + k * kLanes), lane_y = hn::Load(d, kLaneY + k * kLanes);
      for (int i = 0; i < 3; ++i) {
        lane_e[i][k] = hn::Set(d, static_cast<float>(edges[i].a)) * lane_x +
                       hn::Set(d, static_cast<float>(edges[i].b)) * lane_y;
      }
      lane_q[k] = hn::Set(d, t.q_dx) * lane_x + hn::Set(d, t.q_dy) * lane_y;
    }
    const auto q_min = hn::Set(d, t.q_min), q_max = hn::Set(d, t.q_max);
    const bool is_cut = IsCut(t);
    for (int by = y0 & ~3; by <= y1; by += kBlockSide) {
      for (int bx = x0 & ~3; bx <= x1; bx += kBlockSide) {
        if (t.q_max < covered_[(by >> 4) * 4 + (bx >> 4)]) continue;
        // Below 2²⁴ in magnitude for a small triangle near its bounding box: exact in float.
        float e[3];
        for (int i = 0; i < 3; ++i) {
          e[i] = static_cast<float>(std::int64_t{edges[i].a} * (tile_x_ + bx) +
                                    std::int64_t{edges[i].b} * (tile_y_ + by) + edges[i].c);
        }
        const float q =
            t.base_q +
            t.q_dx * (static_cast<float>(tile_x_ + bx) + static_cast<float>(sample_x_) - t.base_x) +
            t.q_dy * (static_cast<float>(tile_y_ + by) + static_cast<float>(sample_y_) - t.base_y);
        const auto inside = [&](std::size_t k) HWY_ATTR {
          const auto lowest =
              hn::Min(hn::Min(hn::Set(d, e[0]) + lane_e[0][k], hn::Set(d, e[1]) + lane_e[1][k]),
                      hn::Set(d, e[2]) + lane_e[2][k]);
          return lowest >= hn::Zero(d);
        };
        const auto depth = [&](std::size_t k)
                               HWY_ATTR { return hn::Min(hn::Max(hn::Set(d, q) + lane_q[k], q_min), q_max); };
        VisitBlock(BlockStart(bx, by), bx, by, t.id, is_cut, inside, depth);
      }
    }
  }

  struct WideEdges {
    std::int32_t a[3], b[3], e[3];  // e at the tile's first sample, saturated
    IntVector lane[3][kVectors];    // a X + b Y over a 4 × 4 grid
  };

  void DrawWide(const BinnedTriangle& t, const WidePlane& plane) {
    const IntTag di;
    Edge edges[3];
    SetUpEdges(t, task_, edges);
    WideEdges w;
    for (int i = 0; i < 3; ++i) {
      w.a[i] = edges[i].a;
      w.b[i] = edges[i].b;
      // Beyond ±2³⁰ the sign is the same all over the tile, so it may be held there.
      const std::int64_t e =
          std::int64_t{edges[i].a} * tile_x_ + std::int64_t{edges[i].b} * tile_y_ + edges[i].c;
      w.e[i] = static_cast<std::int32_t>(
          std::clamp<std::int64_t>(e, -(std::int64_t{1} << 30), std::int64_t{1} << 30));
      for (std::size_t k = 0; k < kVectors; ++k) {
        w.lane[i][k] = hn::Set(di, w.a[i]) * hn::Load(di, kLaneXInt + k * kLanes) +
                       hn::Set(di, w.b[i]) * hn::Load(di, kLaneYInt + k * kLanes);
      }
    }
    WideDepth depth(t, plane);
    const Cells cells = FindCells<4>(w, w.e, 7U);
    for (std::uint32_t mask = cells.touched; mask != 0; mask &= mask - 1) {
      const int cell = __builtin_ctz(mask);
      const std::uint32_t crossing = (cells.crossing[0] >> cell & 1U) |
                                     (cells.crossing[1] >> cell & 1U) << 1U |
                                     (cells.crossing[2] >> cell & 1U) << 2U;
      DrawCell(t, w, depth, cell, crossing);
    }
  }

  // Which of the sixteen cells of 2^kShift pixels an origin's 4 × 4 grid touch the triangle, and which edges cross them.
  struct Cells {
    std::uint32_t touched, crossing[3];
  };
  template <int kShift>
  HWY_INLINE Cells FindCells(const WideEdges& w, const std::int32_t* e, std::uint32_t edges) const {
    const IntTag di;
    constexpr int kReach = (1 << kShift) - 1;
    Cells cells = {0xFFFFU, {0, 0, 0}};
    for (std::uint32_t i = 0; i < 3; ++i) {
      if ((edges >> i & 1U) == 0) continue;
      const auto high = hn::Set(di, e[i] + (std::max(w.a[i], 0) + std::max(w.b[i], 0)) * kReach);
      const auto low = hn::Set(di, e[i] + (std::min(w.a[i], 0) + std::min(w.b[i], 0)) * kReach);
      std::uint32_t outside = 0;
      for (std::size_t k = 0; k < kVectors; ++k) {
        const auto lane = hn::ShiftLeft<kShift>(w.lane[i][k]);
        outside |= MaskBits(high + lane < hn::Zero(di)) << (k * kLanes);
        cells.crossing[i] |= MaskBits(low + lane < hn::Zero(di)) << (k * kLanes);
      }
      cells.touched &= ~outside;
    }
    return cells;
  }

  static HWY_INLINE std::uint32_t MaskBits(hn::Mask<IntTag> mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(IntTag(), mask, bits);
    return bits[0] | std::uint32_t{bits[1]} << 8U;
  }

  // Depth of a wide triangle, in double until the last rounding.
  struct WideDepth {
    WideDepth(const BinnedTriangle& t, const WidePlane& p) : plane(p), q_min(t.q_min), q_max(t.q_max) {
      const DoubleTag dd;
      alignas(64) double offsets[kBlockPixels];
      for (std::size_t i = 0; i < kBlockPixels; ++i)
        offsets[i] = p.q_dx * kLaneXInt[i] + p.q_dy * kLaneYInt[i];
      for (std::size_t k = 0; k < kBlockPixels / hn::Lanes(dd); ++k)
        lane[k] = hn::Load(dd, offsets + k * hn::Lanes(dd));
    }
    [[nodiscard]] double At(double x, double y) const { return plane.q_0 + plane.q_dx * x + plane.q_dy * y; }
    // The block whose first sample is at (x, y).
    HWY_INLINE void Evaluate(double x, double y, float* q) const {
      const DoubleTag dd;
      const hn::Rebind<float, DoubleTag> df;
      const auto base = hn::Set(dd, At(x, y));
      for (std::size_t k = 0; k < kBlockPixels / hn::Lanes(dd); ++k) {
        hn::Store(hn::DemoteTo(df, base + lane[k]), df, q + k * hn::Lanes(dd));
      }
    }
    WidePlane plane;
    float q_min, q_max;
    hn::Vec<DoubleTag> lane[kBlockPixels / hn::MaxLanes(DoubleTag())];
  };

  // Draws what the triangle covers of a 16 × 16 cell. `crossing`: edges that may pass through it, a bit each.
  void DrawCell(const BinnedTriangle& t, const WideEdges& w, const WideDepth& depth, int cell,
                std::uint32_t crossing) {
    const int cell_x = (cell & 3) * 16;
    const int cell_y = (cell >> 2) * 16;
    const auto [nearest, farthest] = DepthRange(depth, cell_x, cell_y);
    if (nearest < covered_[cell]) return;
    std::int32_t e[3];
    for (int i = 0; i < 3; ++i) e[i] = w.e[i] + w.a[i] * cell_x + w.b[i] * cell_y;
    const bool is_cut = IsCut(t);
    const Cells blocks = FindCells<2>(w, e, crossing);
    for (std::uint32_t mask = blocks.touched; mask != 0; mask &= mask - 1) {
      const int block = __builtin_ctz(mask);
      const int bx = (block & 3) * kBlockSide;
      const int by = (block >> 2) * kBlockSide;
      std::uint32_t crossed = 0;
      for (std::uint32_t i = 0; i < 3; ++i) crossed |= (blocks.crossing[i] >> block & 1U) << i;
      DrawWideBlock(t, w, depth, cell_x + bx, cell_y + by, crossed, is_cut);
    }
    if (Sink::kOccludes && crossing == 0 && !is_cut) covered_[cell] = std::max(covered_[cell], farthest);
  }

  // Bounds of the reversed depth over a cell's samples, widened by more than all roundings.
  [[nodiscard]] std::pair<float, float> DepthRange(const WideDepth& depth, int cell_x, int cell_y) const {
    const double x = tile_x_ + cell_x + sample_x_;
    const double y = tile_y_ + cell_y + sample_y_;
    const double corner = depth.At(x, y);
    const double reach_x = depth.plane.q_dx * 15;
    const double reach_y = depth.plane.q_dy * 15;
    const double high = corner + std::max(reach_x, 0.0) + std::max(reach_y, 0.0);
    const double low = corner + std::min(reach_x, 0.0) + std::min(reach_y, 0.0);
    constexpr double kSlack = 1e-6;
    const double q_min = depth.q_min, q_max = depth.q_max;
    return {static_cast<float>(std::clamp(high, q_min, q_max) * (1 + kSlack)),
            static_cast<float>(std::clamp(low, q_min, q_max) * (1 - kSlack))};
  }

  HWY_INLINE void DrawWideBlock(const BinnedTriangle& t, const WideEdges& w, const WideDepth& wide_depth,
                                int bx, int by, std::uint32_t crossed, bool is_cut) {
    const FloatTag d;
    const IntTag di;
    alignas(64) float q[kBlockPixels];
    wide_depth.Evaluate(tile_x_ + bx + sample_x_, tile_y_ + by + sample_y_, q);
    const auto q_min = hn::Set(d, t.q_min), q_max = hn::Set(d, t.q_max);
    const auto depth = [&](std::size_t k)
                           HWY_ATTR { return hn::Min(hn::Max(hn::Load(d, q + k * kLanes), q_min), q_max); };
    std::int32_t e[3];
    for (int i = 0; i < 3; ++i) e[i] = w.e[i] + w.a[i] * bx + w.b[i] * by;
    const auto inside = [&](std::size_t k) HWY_ATTR {
      auto negative = hn::Zero(di);
      for (int i = 0; i < 3; ++i) {
        if ((crossed >> i & 1U) != 0) negative = hn::Or(negative, hn::Set(di, e[i]) + w.lane[i][k]);
      }
      return hn::RebindMask(d, hn::Not(negative < hn::Zero(di)));
    };
    VisitBlock(BlockStart(bx, by), bx, by, t.id, is_cut, inside, depth);
  }

  static std::size_t BlockStart(int bx, int by) {
    return static_cast<std::size_t>(((by >> 2) * kBlocksPerSide + (bx >> 2)) * kBlockPixels);
  }

  template <class Inside, class Depth>
  HWY_INLINE void VisitBlock(std::size_t block, int bx, int by, TriangleId id, bool is_cut,
                             const Inside& inside, const Depth& depth) {
    const FloatTag d;
    if (HWY_UNLIKELY(is_cut)) {
      VisitCutBlock(block, bx, by, id, inside, depth);
      return;
    }
    for (std::size_t k = 0; k < kVectors; ++k) {
      const auto covered = inside(k);
      if (hn::AllFalse(d, covered)) continue;
      sink_.VisitVector(block + k * kLanes, covered, depth(k));
    }
  }

  template <class Inside, class Depth>
  HWY_NOINLINE void VisitCutBlock(std::size_t block, int bx, int by, TriangleId id, const Inside& inside,
                                  const Depth& depth) {
    const FloatTag d;
    alignas(64) float q[kBlockPixels];
    std::uint32_t mask = 0;
    for (std::size_t k = 0; k < kVectors; ++k) {
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d, inside(k), bits);
      mask |= (bits[0] | std::uint32_t{bits[1]} << 8U) << (k * kLanes);
      hn::Store(depth(k), d, q + k * kLanes);
    }
    mask = sink_.Passing(block, q, mask);
    if (mask == 0) return;
    const BlockSamples samples = {static_cast<float>(tile_x_ + bx + sample_x_),
                                  static_cast<float>(tile_y_ + by + sample_y_), q};
    sink_.Write(block, q, task_.cut->keep(id, samples, mask));
  }

  const TileTask& task_;
  Sink sink_;
  int tile_x_, tile_y_;         // first pixel of the tile, from the view's origin
  double sample_x_, sample_y_;  // of the sample within its pixel
  float covered_[16];           // every sample of the 16 × 16 cell is at least this near
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
