// Set-up of a cluster. Small, unclipped triangles are set up N at a time; triangles wider than kSmallTriangle pixels,
// spanning a large ratio of depths, or crossing the near plane or guard band are set up one by one, with their depth
// plane in double precision from the corners before clipping. Which of the two is chosen depends on the triangle and
// the view alone.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/triangle_setup.simd.cc"
#include "base/simd.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "raster/clip.h"
#include "raster/triangle_setup.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::raster::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, 16>;
using IntTag = hn::RebindToSigned<FloatTag>;
using FloatVector = hn::Vec<FloatTag>;
using IntVector = hn::Vec<IntTag>;
constexpr std::size_t kLanes = hn::MaxLanes(FloatTag());
constexpr std::size_t kPadding = 16;

// A cluster's vertices on the screen. Entries of vertices behind the near plane are not numbers to rely on.
struct ScreenVertices {
  alignas(64) float x[kVerticesPerCluster + kPadding];
  alignas(64) float y[kVerticesPerCluster + kPadding];
  alignas(64) float q[kVerticesPerCluster + kPadding];  // reversed depth
};

HWY_INLINE FloatVector Dot(FloatTag d, const float* row, FloatVector x, FloatVector y, FloatVector z) {
  return hn::Set(d, row[0]) * x + hn::Set(d, row[1]) * y + hn::Set(d, row[2]) * z;
}

HWY_INLINE void TransformVertices(const SetupView& setup, const TriangleClusters& geometry,
                                  const Cluster& cluster, ScreenVertices& screen) {
  const FloatTag d;
  const bool is_orthographic = setup.view->is_orthographic;
  for (std::size_t i = 0; i < cluster.vertex_count; i += kLanes) {
    const std::size_t v = cluster.first_vertex + i;
    // Relative to the eye first: the difference is exact for what is near, however far the scene is from its origin.
    const auto x = hn::LoadU(d, geometry.x_ws + v) - hn::Set(d, setup.eye_ws[0]);
    const auto y = hn::LoadU(d, geometry.y_ws + v) - hn::Set(d, setup.eye_ws[1]);
    const auto z = hn::LoadU(d, geometry.z_ws + v) - hn::Set(d, setup.eye_ws[2]);
    const auto X = Dot(d, setup.x_row, x, y, z) + hn::Set(d, setup.x_add);
    const auto Y = Dot(d, setup.y_row, x, y, z) + hn::Set(d, setup.y_add);
    const auto W = Dot(d, setup.w_row, x, y, z) + hn::Set(d, setup.w_add);
    if (is_orthographic) {
      hn::Store(X, d, screen.x + i);
      hn::Store(Y, d, screen.y + i);
      hn::Store(W, d, screen.q + i);
    } else {
      const auto q = hn::Set(d, 1.0F) / W;
      hn::Store(X * q, d, screen.x + i);
      hn::Store(Y * q, d, screen.y + i);
      hn::Store(q, d, screen.q + i);
    }
  }
}

std::uint32_t KindOf(const Cluster& cluster, const BinOptions& options) {
  if ((cluster.flags & kAlphaMask) != 0) return kMasked;
  if ((cluster.flags & kAlphaBlend) != 0) return options.blend_as_mask ? kMasked : kBlended;
  return 0;
}

// Which orientation of the snapped triangle is dropped. On screen, y downward, a front face has negative area.
struct Culling {
  bool front, back;
  Culling(const Cluster& cluster, CullFaces cull)
      : front(cull == CullFaces::front),
        back(cull == CullFaces::single_sided && (cluster.flags & kDoubleSided) == 0) {}
  // Twice a triangle's area.
  [[nodiscard]] bool Drops(std::int64_t area) const { return area == 0 || (area < 0 ? front : back); }
};

// ---------------------------------------------------------------------------------------------- one by one

// The plane q = q_0 + q_dx x + q_dy y through three pixel-homogeneous corners with right-hand sides r (1 in a
// perspective view, the corner's reversed depth in an orthographic one): (X Y W) (q_dx q_dy q_0)ᵀ = r. In double,
// from the corners as they are before clipping, it is exact to 2⁻²⁴ of the local depth everywhere on the triangle,
// also where that runs from 0.1 m to 9 km (row 24).
WidePlane PlaneThrough(const std::array<ClipVertex, 3>& v, const double* r) {
  const double c0 = v[1].y * v[2].w - v[2].y * v[1].w;
  const double c1 = v[2].y * v[0].w - v[0].y * v[2].w;
  const double c2 = v[0].y * v[1].w - v[1].y * v[0].w;
  const double determinant = v[0].x * c0 + v[1].x * c1 + v[2].x * c2;
  if (determinant == 0) return {r[0] / v[0].w, 0, 0};
  const double inverse = 1 / determinant;
  const double q_dx = (r[0] * c0 + r[1] * c1 + r[2] * c2) * inverse;
  const double q_dy =
      (r[0] * (v[2].x * v[1].w - v[1].x * v[2].w) + r[1] * (v[0].x * v[2].w - v[2].x * v[0].w) +
       r[2] * (v[1].x * v[0].w - v[0].x * v[1].w)) *
      inverse;
  const double q_0 =
      (r[0] * (v[1].x * v[2].y - v[2].x * v[1].y) + r[1] * (v[2].x * v[0].y - v[0].x * v[2].y) +
       r[2] * (v[0].x * v[1].y - v[1].x * v[0].y)) *
      inverse;
  if (!(std::isfinite(q_dx) && std::isfinite(q_dy) && std::isfinite(q_0))) return {r[0] / v[0].w, 0, 0};
  return {q_0, q_dx, q_dy};
}

ClipVertex ClipPosition(const RasterView& view, double x, double y, double z) {
  const glm::dvec3 p = glm::dvec3(x, y, z) - view.eye_ws;
  const auto dot = [&](glm::dvec3 row) { return row.x * p.x + row.y * p.y + row.z * p.z; };
  const double w = dot(view.w_row);
  if (view.is_orthographic) {
    return {dot(view.x_row) + view.x_add, dot(view.y_row) + view.y_add, 1,
            view.reversed_near - (w + view.w_add)};
  }
  return {dot(view.x_row), dot(view.y_row), w, w - view.view.projection.near};
}

std::int32_t Snap(double pixel) { return static_cast<std::int32_t>(std::nearbyint(pixel * kSubpixels)); }

struct SnappedVertex {
  std::int32_t x, y;
};

bool TouchesPixels(const Rect& pixels, const RasterView& view, int reach, const SnappedVertex* v) {
  const auto low = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    return (std::min({a, b, c}) - kSubpixels / 2 - reach + kSubpixels - 1) >> kSubpixelBits;
  };
  const auto high = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    return (std::max({a, b, c}) - kSubpixels / 2 + reach) >> kSubpixelBits;
  };
  const int x0 = std::max(low(v[0].x, v[1].x, v[2].x), pixels.x_begin - view.origin_x);
  const int x1 = std::min(high(v[0].x, v[1].x, v[2].x), pixels.x_end - 1 - view.origin_x);
  const int y0 = std::max(low(v[0].y, v[1].y, v[2].y), pixels.y_begin - view.origin_y);
  const int y1 = std::min(high(v[0].y, v[1].y, v[2].y), pixels.y_end - 1 - view.origin_y);
  return x0 <= x1 && y0 <= y1;
}

// Twice the area, positive where the corners run clockwise on the screen.
std::int64_t AreaOf(const SnappedVertex* v) {
  return std::int64_t{v[1].x - v[0].x} * (v[2].y - v[0].y) -
         std::int64_t{v[2].x - v[0].x} * (v[1].y - v[0].y);
}

void EmitWide(const SnappedVertex* v, float q_min, float q_max, TriangleId id, std::uint32_t kind,
              std::uint32_t plane, const Culling& culling, Batch& batch) {
  const std::int64_t area = AreaOf(v);
  if (culling.Drops(area)) return;
  const int b = area > 0 ? 1 : 2;
  const int c = 3 - b;
  BinnedTriangle t{};
  t.x[0] = v[0].x, t.x[1] = v[b].x, t.x[2] = v[c].x;
  t.y[0] = v[0].y, t.y[1] = v[b].y, t.y[2] = v[c].y;
  t.q_min = q_min;
  t.q_max = q_max;
  t.id = id;
  t.kind = kind | kWide;
  t.plane = plane;
  batch.triangles.push_back(t);
}

// One triangle's corners in double.
struct WideCorners {
  std::array<ClipVertex, 3> clip;
  std::array<std::uint32_t, 3> local;  // of the cluster's vertices
  double right_side[3];                // of PlaneThrough()
};

WideCorners LoadWideCorners(const SetupTask& task, TriangleId id) {
  const RasterView& view = *task.setup->view;
  const TriangleClusters& geometry = *task.geometry;
  const std::uint32_t first_vertex = geometry.clusters[task.cluster].first_vertex;
  const std::uint32_t packed = geometry.corners[id];
  WideCorners corners;
  for (std::uint32_t i = 0; i < 3; ++i) {
    corners.local[i] = packed >> (8 * i) & 255U;
    const std::uint32_t v = first_vertex + corners.local[i];
    corners.clip[i] = ClipPosition(view, geometry.x_ws[v], geometry.y_ws[v], geometry.z_ws[v]);
    corners.right_side[i] = view.is_orthographic ? view.reversed_near - corners.clip[i].near_side : 1.0;
  }
  return corners;
}

// Reversed depths that a clipped or whole triangle spans.
struct DepthSpan {
  double low = 0, high = 0;
};
DepthSpan SpanOf(const RasterView& view, std::span<const ClipVertex> vertices) {
  DepthSpan span;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double q = view.is_orthographic ? view.reversed_near - vertices[i].near_side : 1 / vertices[i].w;
    span = i == 0 ? DepthSpan{q, q} : DepthSpan{std::min(span.low, q), std::max(span.high, q)};
  }
  return span;
}

// Any triangle of a cluster that crosses the near plane or the guard band.
void SetUpClipped(const SetupTask& task, const ScreenVertices& screen, std::uint32_t triangle, Batch& batch) {
  const RasterView& view = *task.setup->view;
  const Cluster& cluster = task.geometry->clusters[task.cluster];
  const TriangleId id = task.cluster << kTriangleBits | triangle;
  const WideCorners corners = LoadWideCorners(task, id);
  const ClippedPolygon polygon = clip_triangle(corners.clip, kGuardBand);
  if (polygon.count < 3) return;

  SnappedVertex snapped[8];
  for (std::size_t i = 0; i < polygon.count; ++i) {
    if (polygon.corner[i] >= 0) {
      // The neighbours' snapped position, bit for bit.
      const std::uint32_t corner = corners.local[static_cast<std::size_t>(polygon.corner[i])];
      snapped[i] = {Snap(screen.x[corner]), Snap(screen.y[corner])};
    } else {
      const ClipVertex& v = polygon.vertices[i];
      snapped[i] = {Snap(v.x / v.w), Snap(v.y / v.w)};
    }
  }
  const DepthSpan q = SpanOf(view, std::span(polygon.vertices).first(polygon.count));
  const std::uint32_t kind = KindOf(cluster, *task.options);
  const Culling culling(cluster, task.options->cull);
  const auto plane_index = static_cast<std::uint32_t>(batch.planes.size());
  const std::size_t before = batch.triangles.size();
  for (std::size_t i = 1; i + 1 < polygon.count; ++i) {
    const SnappedVertex fan[3] = {snapped[0], snapped[i], snapped[i + 1]};
    if (!TouchesPixels(task.options->pixels, view, task.options->sample_reach, fan)) continue;
    EmitWide(fan, static_cast<float>(q.low), static_cast<float>(q.high), id, kind, plane_index, culling,
             batch);
  }
  if (batch.triangles.size() > before) {
    batch.planes.push_back(PlaneThrough(corners.clip, corners.right_side));
  }
}

// One triangle that the vector path has passed over, in a cluster that needs no clipping: what SetUpClipped() would
// make of it. That it touches pixels is known.
void SetUpWide(const SetupTask& task, const ScreenVertices& screen, std::uint32_t triangle, Batch& batch) {
  const Cluster& cluster = task.geometry->clusters[task.cluster];
  const TriangleId id = task.cluster << kTriangleBits | triangle;
  const std::uint32_t packed = task.geometry->corners[id];
  SnappedVertex snapped[3];
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t local = packed >> (8 * i) & 255U;
    snapped[i] = {Snap(screen.x[local]), Snap(screen.y[local])};
  }
  const Culling culling(cluster, task.options->cull);
  if (culling.Drops(AreaOf(snapped))) return;
  const WideCorners corners = LoadWideCorners(task, id);
  const DepthSpan q = SpanOf(*task.setup->view, corners.clip);
  EmitWide(snapped, static_cast<float>(q.low), static_cast<float>(q.high), id, KindOf(cluster, *task.options),
           static_cast<std::uint32_t>(batch.planes.size()), culling, batch);
  batch.planes.push_back(PlaneThrough(corners.clip, corners.right_side));
}

// ---------------------------------------------------------------------------------------------- N at a time

// One field of N set-up triangles, on its way from vectors to records.
struct SmallFields {
  alignas(64) std::int32_t x[3][16], y[3][16];
  alignas(64) float base_x[16], base_y[16], base_q[16], q_dx[16], q_dy[16], q_min[16], q_max[16];
};

HWY_INLINE void EmitSmall(const SmallFields& fields, std::uint64_t mask, TriangleId first_id,
                          std::uint32_t kind, Batch& batch) {
  for (; mask != 0; mask &= mask - 1) {
    const auto i = static_cast<std::size_t>(__builtin_ctzll(mask));
    BinnedTriangle& t = batch.triangles.emplace_back();
    for (int k = 0; k < 3; ++k) {
      t.x[k] = fields.x[k][i];
      t.y[k] = fields.y[k][i];
    }
    t.base_x = fields.base_x[i];
    t.base_y = fields.base_y[i];
    t.base_q = fields.base_q[i];
    t.q_dx = fields.q_dx[i];
    t.q_dy = fields.q_dy[i];
    t.q_min = fields.q_min[i];
    t.q_max = fields.q_max[i];
    t.id = first_id + static_cast<std::uint32_t>(i);
    t.kind = kind;
    t.plane = 0;
  }
}

// Bounds of sample positions that a span of snapped coordinates may touch, as pixel indices relative to the origin.
HWY_INLINE IntVector FirstPixel(IntTag di, IntVector low, int reach) {
  return hn::ShiftRight<kSubpixelBits>(low + hn::Set(di, kSubpixels / 2 - 1 - reach));
}
HWY_INLINE IntVector LastPixel(IntTag di, IntVector high, int reach) {
  return hn::ShiftRight<kSubpixelBits>(high + hn::Set(di, reach - kSubpixels / 2));
}

HWY_INLINE FloatVector Min3(FloatVector a, FloatVector b, FloatVector c) { return hn::Min(hn::Min(a, b), c); }
HWY_INLINE FloatVector Max3(FloatVector a, FloatVector b, FloatVector c) { return hn::Max(hn::Max(a, b), c); }
HWY_INLINE IntVector Min3(IntVector a, IntVector b, IntVector c) { return hn::Min(hn::Min(a, b), c); }
HWY_INLINE IntVector Max3(IntVector a, IntVector b, IntVector c) { return hn::Max(hn::Max(a, b), c); }

// N triangles of a cluster: corners in pixels from the view's origin, and snapped to 1/256 pixel.
struct Corners {
  IntVector index[3];  // of the cluster's vertices
  FloatVector x[3], y[3];
  IntVector snapped_x[3], snapped_y[3];
};

HWY_INLINE Corners LoadCorners(const SetupTask& task, const ScreenVertices& screen, std::size_t triangle) {
  const FloatTag d;
  const IntTag di;
  const auto subpixels = hn::Set(d, static_cast<float>(kSubpixels));
  const auto byte = hn::Set(di, 255);
  // The array is padded with degenerate triangles to a whole cluster.
  const auto packed = hn::Load(di, reinterpret_cast<const std::int32_t*>(task.geometry->corners + triangle));
  Corners c;
  c.index[0] = hn::And(packed, byte);
  c.index[1] = hn::And(hn::ShiftRight<8>(packed), byte);
  c.index[2] = hn::And(hn::ShiftRight<16>(packed), byte);
  for (int k = 0; k < 3; ++k) {
    c.x[k] = hn::GatherIndex(d, screen.x, c.index[k]);
    c.y[k] = hn::GatherIndex(d, screen.y, c.index[k]);
    c.snapped_x[k] = hn::NearestInt(c.x[k] * subpixels);
    c.snapped_y[k] = hn::NearestInt(c.y[k] * subpixels);
  }
  return c;
}

// The pixels of the picture, or of the band of it that is being drawn.
class PixelBounds {
 public:
  PixelBounds(const RasterView& view, const BinOptions& options)
      : x_first_(hn::Set(IntTag(), options.pixels.x_begin - view.origin_x)),
        x_last_(hn::Set(IntTag(), options.pixels.x_end - 1 - view.origin_x)),
        y_first_(hn::Set(IntTag(), options.pixels.y_begin - view.origin_y)),
        y_last_(hn::Set(IntTag(), options.pixels.y_end - 1 - view.origin_y)),
        reach_(options.sample_reach) {}

  // Whether a box of snapped coordinates may hold a sample of one of them.
  HWY_INLINE hn::Mask<IntTag> Touches(IntVector x_low, IntVector x_high, IntVector y_low,
                                      IntVector y_high) const {
    const IntTag di;
    const auto x_begin = hn::Max(FirstPixel(di, x_low, reach_), x_first_);
    const auto x_end = hn::Min(LastPixel(di, x_high, reach_), x_last_);
    const auto y_begin = hn::Max(FirstPixel(di, y_low, reach_), y_first_);
    const auto y_end = hn::Min(LastPixel(di, y_high, reach_), y_last_);
    return hn::Not(hn::Or(x_begin > x_end, y_begin > y_end));
  }

 private:
  IntVector x_first_, x_last_, y_first_, y_last_;
  int reach_;
};

// The corners so that they run clockwise, and the depth plane, from positions before snapping.
HWY_INLINE void StoreFields(const Corners& c, const FloatVector* q, hn::Mask<IntTag> swap,
                            SmallFields& fields) {
  const FloatTag d;
  const IntTag di;
  const auto ux = c.x[1] - c.x[0], uy = c.y[1] - c.y[0], uq = q[1] - q[0];
  const auto vx = c.x[2] - c.x[0], vy = c.y[2] - c.y[0], vq = q[2] - q[0];
  const auto determinant = ux * vy - vx * uy;
  // A sliver has no gradient worth the name; q_min and q_max bound it to the truth.
  const auto is_flat = hn::Abs(determinant) < hn::Set(d, 1e-9F);
  const auto inverse = hn::Set(d, 1.0F) / hn::IfThenElse(is_flat, hn::Set(d, 1.0F), determinant);
  hn::Store(hn::IfThenZeroElse(is_flat, (uq * vy - vq * uy) * inverse), d, fields.q_dx);
  hn::Store(hn::IfThenZeroElse(is_flat, (vq * ux - uq * vx) * inverse), d, fields.q_dy);
  hn::Store(c.snapped_x[0], di, fields.x[0]);
  hn::Store(hn::IfThenElse(swap, c.snapped_x[2], c.snapped_x[1]), di, fields.x[1]);
  hn::Store(hn::IfThenElse(swap, c.snapped_x[1], c.snapped_x[2]), di, fields.x[2]);
  hn::Store(c.snapped_y[0], di, fields.y[0]);
  hn::Store(hn::IfThenElse(swap, c.snapped_y[2], c.snapped_y[1]), di, fields.y[1]);
  hn::Store(hn::IfThenElse(swap, c.snapped_y[1], c.snapped_y[2]), di, fields.y[2]);
  hn::Store(c.x[0], d, fields.base_x);
  hn::Store(c.y[0], d, fields.base_y);
  hn::Store(q[0], d, fields.base_q);
  hn::Store(Min3(q[0], q[1], q[2]), d, fields.q_min);
  hn::Store(Max3(q[0], q[1], q[2]), d, fields.q_max);
}

HWY_INLINE std::uint64_t BitsOf(hn::Mask<IntTag> mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(IntTag(), mask, bits);
  return bits[0] | std::uint64_t{bits[1]} << 8U;
}

void SetUpInside(const SetupTask& task, const ScreenVertices& screen, Batch& batch) {
  const FloatTag d;
  const IntTag di;
  const RasterView& view = *task.setup->view;
  const Cluster& cluster = task.geometry->clusters[task.cluster];
  const Culling culling(cluster, task.options->cull);
  const std::uint32_t kind = KindOf(cluster, *task.options);
  const TriangleId first_id = task.cluster << kTriangleBits;
  const PixelBounds pixels(view, *task.options);
  const auto limit = hn::Set(di, kSmallTriangle * kSubpixels);
  SmallFields fields;

  for (std::uint32_t first = 0; first < cluster.triangle_count; first += kLanes) {
    const Corners c = LoadCorners(task, screen, first_id + first);
    const IntVector *x = c.snapped_x, *y = c.snapped_y;
    const auto x_low = Min3(x[0], x[1], x[2]), x_high = Max3(x[0], x[1], x[2]);
    const auto y_low = Min3(y[0], y[1], y[2]), y_high = Max3(y[0], y[1], y[2]);
    const auto touched = pixels.Touches(x_low, x_high, y_low, y_high);
    if (hn::AllFalse(di, touched)) continue;

    FloatVector q[3];
    for (int k = 0; k < 3; ++k) q[k] = hn::GatherIndex(d, screen.q, c.index[k]);
    auto is_small = hn::Not(hn::Or(x_high - x_low > limit, y_high - y_low > limit));
    if (!view.is_orthographic) {
      const auto q_min = Min3(q[0], q[1], q[2]), q_max = Max3(q[0], q[1], q[2]);
      is_small = hn::And(is_small, hn::RebindMask(di, q_max <= q_min + q_min));
    }
    // Exact where it is used: both differences fit 13 bits with sign for small triangles.
    const auto area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    auto kept = area != hn::Zero(di);
    if (culling.front) kept = hn::And(kept, area > hn::Zero(di));
    if (culling.back) kept = hn::And(kept, area < hn::Zero(di));

    for (std::uint64_t wide = BitsOf(hn::AndNot(is_small, touched)); wide != 0; wide &= wide - 1) {
      SetUpWide(task, screen, first + static_cast<std::uint32_t>(__builtin_ctzll(wide)), batch);
    }
    const auto small = hn::And(hn::And(touched, is_small), kept);
    if (hn::AllFalse(di, small)) continue;
    StoreFields(c, q, area < hn::Zero(di), fields);
    EmitSmall(fields, BitsOf(small), first_id + first, kind, batch);
  }
}

void set_up_cluster(const SetupTask& task, Batch& batch) {
  const Cluster& cluster = task.geometry->clusters[task.cluster];
  batch.statistics.triangles += cluster.triangle_count;
  ScreenVertices screen;
  TransformVertices(*task.setup, *task.geometry, cluster, screen);
  if (!task.crossing) {
    SetUpInside(task, screen, batch);
    return;
  }
  for (std::uint32_t i = 0; i < cluster.triangle_count; ++i) SetUpClipped(task, screen, i, batch);
}

}  // namespace laterna::raster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace laterna::raster {

SetupView::SetupView(const RasterView& raster_view) : view(&raster_view) {
  const RasterView& v = raster_view;
  for (int i = 0; i < 3; ++i) {
    eye_ws[i] = static_cast<float>(v.eye_ws[i]);
    x_row[i] = static_cast<float>(v.x_row[i]);
    y_row[i] = static_cast<float>(v.y_row[i]);
    w_row[i] = static_cast<float>(v.w_row[i]);
  }
  // What rounding the eye to float moved it by is put back after the product.
  const glm::dvec3 rounding = glm::dvec3(eye_ws[0], eye_ws[1], eye_ws[2]) - v.eye_ws;
  x_add = static_cast<float>(v.x_add + glm::dot(v.x_row, rounding));
  y_add = static_cast<float>(v.y_add + glm::dot(v.y_row, rounding));
  w_add = static_cast<float>(v.w_add + glm::dot(v.w_row, rounding));
}

LATERNA_KERNEL_TABLE(set_up_cluster)

}  // namespace laterna::raster
#endif
