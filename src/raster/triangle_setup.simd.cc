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
#include <cstddef>
#include <cstring>
#include <glm/geometric.hpp>

#include "base/stopwatch.h"
#include "base/vectors-inl.h"
#include "raster/clip.h"
#include "raster/triangle_setup.h"

HWY_BEFORE_NAMESPACE();
namespace laterna::raster::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using namespace laterna::HWY_NAMESPACE;  // NOLINT: the vector vocabulary
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
    FloatVector x, y, z;
    hn::LoadInterleaved3(d, &geometry.positions_ws[v].x, x, y, z);
    x = x - hn::Set(d, setup.eye_ws[0]);
    y = y - hn::Set(d, setup.eye_ws[1]);
    z = z - hn::Set(d, setup.eye_ws[2]);
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
  if ((cluster.flags & options.cut_flags) != 0) return kMasked;
  if ((cluster.flags & kAlphaBlend) != 0) return kBlended;
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

// q(x, y) = q_0 + q_dx x + q_dy y.
struct Plane {
  double q_0, q_dx, q_dy;
};

// The plane q = q_0 + q_dx x + q_dy y through three pixel-homogeneous corners with right-hand sides r (1 in a
// perspective view, the corner's reversed depth in an orthographic one): (X Y W) (q_dx q_dy q_0)ᵀ = r. In double,
// from the corners as they are before clipping, it is exact to 2⁻²⁴ of the local depth everywhere on the triangle,
// also where that runs from 0.1 m to 9 km (row 24).
Plane PlaneThrough(const std::array<ClipVertex, 3>& v, const double* r) {
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
  const std::int32_t x[3] = {v[0].x, v[1].x, v[2].x}, y[3] = {v[0].y, v[1].y, v[2].y};
  const Rect wanted = {pixels.x_begin - view.origin_x, pixels.y_begin - view.origin_y,
                       pixels.x_end - view.origin_x, pixels.y_end - view.origin_y};
  return !overlap(pixels_of(x, y, reach), wanted).is_empty();
}

// Twice the area, positive where the corners run clockwise on the screen.
std::int64_t AreaOf(const SnappedVertex* v) {
  return std::int64_t{v[1].x - v[0].x} * (v[2].y - v[0].y) -
         std::int64_t{v[2].x - v[0].x} * (v[1].y - v[0].y);
}

// What the parts of one triangle have in common.
struct WideParts {
  Plane plane;
  float q_min, q_max;
  TriangleId id;
  std::uint32_t kind;
};

void EmitWide(const SnappedVertex* v, const WideParts& parts, int reach, Batch& batch) {
  const int b = AreaOf(v) > 0 ? 1 : 2;
  const int c = 3 - b;
  batch.wide.push_back({{v[0].x, v[b].x, v[c].x},
                        {v[0].y, v[b].y, v[c].y},
                        parts.plane.q_0,
                        parts.plane.q_dx,
                        parts.plane.q_dy,
                        parts.q_min,
                        parts.q_max,
                        parts.id,
                        parts.kind});
  batch.wide_pixels.include(pixels_of(batch.wide.back().x, batch.wide.back().y, reach));
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
    const glm::vec3& p = geometry.positions_ws[v];
    corners.clip[i] = ClipPosition(view, p.x, p.y, p.z);
    if (task.options->cut != nullptr) corners.clip[i].cut_side = task.options->cut->side(p);
    corners.right_side[i] = view.is_orthographic ? view.reversed_near - corners.clip[i].near_side : 1.0;
  }
  return corners;
}

WideParts PartsOf(const SetupTask& task, const WideCorners& corners, std::span<const ClipVertex> vertices,
                  TriangleId id) {
  const RasterView& view = *task.setup->view;
  double low = 0, high = 0;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double q = view.is_orthographic ? view.reversed_near - vertices[i].near_side : 1 / vertices[i].w;
    low = i == 0 ? q : std::min(low, q);
    high = i == 0 ? q : std::max(high, q);
  }
  return {PlaneThrough(corners.clip, corners.right_side), static_cast<float>(low), static_cast<float>(high),
          id, KindOf(task.geometry->clusters[task.cluster], *task.options)};
}

// Any triangle of a cluster that crosses the near plane, the guard band or a cutting plane.
void SetUpClipped(const SetupTask& task, const ScreenVertices& screen, std::uint32_t triangle, Batch& batch) {
  const RasterView& view = *task.setup->view;
  const Cluster& cluster = task.geometry->clusters[task.cluster];
  const TriangleId id = task.cluster << kTriangleBits | triangle;
  const WideCorners corners = LoadWideCorners(task, id);
  const ClippedPolygon polygon = clip_triangle(corners.clip, kGuardBand, task.options->cut != nullptr);
  if (polygon.count < 3) return;

  SnappedVertex snapped[9];
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
  const Culling culling(cluster, task.options->cull);
  const WideParts parts = PartsOf(task, corners, std::span(polygon.vertices).first(polygon.count), id);
  for (std::size_t i = 1; i + 1 < polygon.count; ++i) {
    const SnappedVertex fan[3] = {snapped[0], snapped[i], snapped[i + 1]};
    if (!TouchesPixels(task.options->pixels, view, task.options->sample_reach, fan)) continue;
    if (!culling.Drops(AreaOf(fan))) EmitWide(fan, parts, task.options->sample_reach, batch);
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
  EmitWide(snapped, PartsOf(task, corners, corners.clip, id), task.options->sample_reach, batch);
}

// ---------------------------------------------------------------------------------------------- N at a time

// N records on their way from vectors to memory: words 4 k … 4 k + 3 of each, one record after the other.
struct SmallRecords {
  alignas(64) std::int32_t quarter[4][16][4];
};
static_assert(offsetof(SmallTriangle, edge_dx) == 12 && offsetof(SmallTriangle, x) == 28 &&
              offsetof(SmallTriangle, kind) == 34 && offsetof(SmallTriangle, q) == 36 &&
              offsetof(SmallTriangle, id) == 56);

HWY_INLINE void EmitSmall(const SmallRecords& records, std::uint32_t mask, Batch& batch) {
  const std::size_t before = batch.small.size();
  batch.small.resize(before + static_cast<std::size_t>(__builtin_popcount(mask)));
  auto* to = reinterpret_cast<unsigned char*>(batch.small.data() + before);
  for (; mask != 0; mask &= mask - 1) {
    const auto i = static_cast<std::size_t>(__builtin_ctz(mask));
    for (const auto& quarter : records.quarter) {
      std::memcpy(to, quarter[i], sizeof(quarter[i]));
      to += sizeof(quarter[i]);
    }
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

// Pixels with samples that N triangles may cover, ends included.
struct PixelBoxes {
  IntVector x_first, x_last, y_first, y_last;
};

HWY_INLINE PixelBoxes FindBoxes(const Corners& c, int reach) {
  const IntTag di;
  const IntVector *x = c.snapped_x, *y = c.snapped_y;
  return {FirstPixel(di, Min3(x[0], x[1], x[2]), reach), LastPixel(di, Max3(x[0], x[1], x[2]), reach),
          FirstPixel(di, Min3(y[0], y[1], y[2]), reach), LastPixel(di, Max3(y[0], y[1], y[2]), reach)};
}

// The pixels of the picture, or of the band of it that is being drawn.
class PixelBounds {
 public:
  PixelBounds(const RasterView& view, const BinOptions& options)
      : x_first_(hn::Set(IntTag(), options.pixels.x_begin - view.origin_x)),
        x_last_(hn::Set(IntTag(), options.pixels.x_end - 1 - view.origin_x)),
        y_first_(hn::Set(IntTag(), options.pixels.y_begin - view.origin_y)),
        y_last_(hn::Set(IntTag(), options.pixels.y_end - 1 - view.origin_y)) {}

  HWY_INLINE IntMask Touches(const PixelBoxes& box) const {
    const auto x_begin = hn::Max(box.x_first, x_first_), x_end = hn::Min(box.x_last, x_last_);
    const auto y_begin = hn::Max(box.y_first, y_first_), y_end = hn::Min(box.y_last, y_last_);
    return hn::Not(hn::Or(x_begin > x_end, y_begin > y_end));
  }

 private:
  IntVector x_first_, x_last_, y_first_, y_last_;
};

// Edge functions of N small triangles at the centre of the first pixel of each, and their change from there, in 1/256
// pixel. `swap`: triangles that run counter-clockwise.
struct SmallEdges {
  IntVector at[3], dx[3], dy[3];
};

HWY_INLINE SmallEdges FindEdges(const Corners& c, const PixelBoxes& box, IntMask swap) {
  const IntTag di;
  const auto zero = hn::Zero(di);
  const IntVector x[3] = {c.snapped_x[0], hn::IfThenElse(swap, c.snapped_x[2], c.snapped_x[1]),
                          hn::IfThenElse(swap, c.snapped_x[1], c.snapped_x[2])};
  const IntVector y[3] = {c.snapped_y[0], hn::IfThenElse(swap, c.snapped_y[2], c.snapped_y[1]),
                          hn::IfThenElse(swap, c.snapped_y[1], c.snapped_y[2])};
  const auto centre = [&](IntVector pixel) HWY_ATTR {
    return hn::ShiftLeft<kSubpixelBits>(pixel) + hn::Set(di, kSubpixels / 2);
  };
  const auto sample_x = centre(box.x_first), sample_y = centre(box.y_first);
  SmallEdges edges;
  for (int i = 0; i < 3; ++i) {
    const int j = i == 2 ? 0 : i + 1;
    edges.dx[i] = y[i] - y[j];
    edges.dy[i] = x[j] - x[i];
    // y grows downward and the corners run clockwise: a left edge runs up (dx > 0), a top edge to the right.
    const auto is_top_left = hn::Or(edges.dx[i] > zero, hn::And(edges.dx[i] == zero, edges.dy[i] > zero));
    const auto at = edges.dx[i] * (sample_x - x[i]) + edges.dy[i] * (sample_y - y[i]);
    edges.at[i] = at - hn::IfThenZeroElse(is_top_left, hn::Set(di, 1));
  }
  return edges;
}

// Triangles that lie between the samples: none of the four samples of a box of up to 2 × 2 pixels is covered.
HWY_INLINE IntMask MissSamples(const SmallEdges& edges, const PixelBoxes& box) {
  const IntTag di;
  const auto one = hn::Set(di, 1), zero = hn::Zero(di);
  const auto is_tiny = hn::Not(hn::Or(box.x_last - box.x_first > one, box.y_last - box.y_first > one));
  if (hn::AllFalse(di, is_tiny)) return is_tiny;
  auto misses = is_tiny;
  for (int sample = 0; sample < 4; ++sample) {
    auto outside = zero;  // its sign
    for (int i = 0; i < 3; ++i) {
      auto at = edges.at[i];
      if ((sample & 1) != 0) at = at + hn::ShiftLeft<kSubpixelBits>(edges.dx[i]);
      if ((sample & 2) != 0) at = at + hn::ShiftLeft<kSubpixelBits>(edges.dy[i]);
      outside = hn::Or(outside, at);
    }
    misses = hn::And(misses, outside < zero);
  }
  return misses;
}

// Reversed depth at the centre of the first pixel of each triangle, and its change from there.
struct SmallDepths {
  FloatVector at, dx, dy, min, max;
};

// From positions before snapping.
HWY_INLINE SmallDepths FindDepths(const Corners& c, const FloatVector* q, const PixelBoxes& box) {
  const FloatTag d;
  const auto ux = c.x[1] - c.x[0], uy = c.y[1] - c.y[0], uq = q[1] - q[0];
  const auto vx = c.x[2] - c.x[0], vy = c.y[2] - c.y[0], vq = q[2] - q[0];
  const auto determinant = ux * vy - vx * uy;
  // A sliver has no gradient worth the name; the extremes bound it to the truth.
  const auto is_flat = hn::Abs(determinant) < hn::Set(d, 1e-9F);
  const auto inverse = hn::Set(d, 1.0F) / hn::IfThenElse(is_flat, hn::Set(d, 1.0F), determinant);
  SmallDepths depths;
  depths.dx = hn::IfThenZeroElse(is_flat, (uq * vy - vq * uy) * inverse);
  depths.dy = hn::IfThenZeroElse(is_flat, (vq * ux - uq * vx) * inverse);
  const auto half = hn::Set(d, 0.5F);
  const auto x = hn::ConvertTo(d, box.x_first) + half - c.x[0],
             y = hn::ConvertTo(d, box.y_first) + half - c.y[0];
  depths.at = q[0] + (depths.dx * x + depths.dy * y);
  depths.min = Min3(q[0], q[1], q[2]);
  depths.max = Max3(q[0], q[1], q[2]);
  return depths;
}

HWY_INLINE void Store(const SmallEdges& edges, const PixelBoxes& box, const SmallDepths& depths,
                      TriangleId first_id, std::uint32_t kind, SmallRecords& records) {
  const FloatTag d;
  const IntTag di;
  const auto as_float = [&](IntVector v) HWY_ATTR { return hn::BitCast(di, hn::ConvertTo(d, v)); };
  const auto bits = [&](FloatVector v) HWY_ATTR { return hn::BitCast(di, v); };
  const auto one = hn::Set(di, 1), low_half = hn::Set(di, 0xFFFF);
  const auto place = hn::Or(hn::And(box.x_first, low_half), hn::ShiftLeft<16>(box.y_first));
  const auto size = hn::Or(box.x_last - box.x_first + one, hn::ShiftLeft<8>(box.y_last - box.y_first + one));
  const auto size_and_kind = hn::Or(size, hn::Set(di, static_cast<std::int32_t>(kind << 16U)));
  hn::StoreInterleaved4(edges.at[0], edges.at[1], edges.at[2], as_float(edges.dx[0]), di,
                        records.quarter[0][0]);
  hn::StoreInterleaved4(as_float(edges.dx[1]), as_float(edges.dy[0]), as_float(edges.dy[1]), place, di,
                        records.quarter[1][0]);
  hn::StoreInterleaved4(size_and_kind, bits(depths.at), bits(depths.dx), bits(depths.dy), di,
                        records.quarter[2][0]);
  hn::StoreInterleaved4(bits(depths.min), bits(depths.max), hn::Iota(di, static_cast<std::int32_t>(first_id)),
                        hn::Zero(di), di, records.quarter[3][0]);
}

// Bounds of the boxes of all small triangles of a cluster.
class SmallBounds {
 public:
  HWY_INLINE SmallBounds() {
    const IntTag di;
    x_first_ = y_first_ = hn::Set(di, 1 << 28);
    x_last_ = y_last_ = hn::Set(di, -(1 << 28));
  }
  HWY_INLINE void Include(const PixelBoxes& box, IntMask small) {
    x_first_ = hn::IfThenElse(small, hn::Min(x_first_, box.x_first), x_first_);
    y_first_ = hn::IfThenElse(small, hn::Min(y_first_, box.y_first), y_first_);
    x_last_ = hn::IfThenElse(small, hn::Max(x_last_, box.x_last), x_last_);
    y_last_ = hn::IfThenElse(small, hn::Max(y_last_, box.y_last), y_last_);
  }
  [[nodiscard]] Rect Pixels() const {
    const IntTag di;
    return {hn::GetLane(hn::MinOfLanes(di, x_first_)), hn::GetLane(hn::MinOfLanes(di, y_first_)),
            hn::GetLane(hn::MaxOfLanes(di, x_last_)) + 1, hn::GetLane(hn::MaxOfLanes(di, y_last_)) + 1};
  }

 private:
  IntVector x_first_, y_first_, x_last_, y_last_;
};

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
  const bool has_one_sample = task.options->sample_reach == 0;
  SmallRecords records;
  SmallBounds bounds;

  for (std::uint32_t first = 0; first < cluster.triangle_count; first += kLanes) {
    const Corners c = LoadCorners(task, screen, first_id + first);
    const PixelBoxes box = FindBoxes(c, task.options->sample_reach);
    const auto touched = pixels.Touches(box);
    if (hn::AllFalse(di, touched)) continue;

    FloatVector q[3];
    for (int k = 0; k < 3; ++k) q[k] = hn::GatherIndex(d, screen.q, c.index[k]);
    const IntVector *x = c.snapped_x, *y = c.snapped_y;
    auto is_small = hn::Not(hn::Or(Max3(x[0], x[1], x[2]) - Min3(x[0], x[1], x[2]) > limit,
                                   Max3(y[0], y[1], y[2]) - Min3(y[0], y[1], y[2]) > limit));
    if (!view.is_orthographic) {
      const auto q_min = Min3(q[0], q[1], q[2]), q_max = Max3(q[0], q[1], q[2]);
      is_small = hn::And(is_small, hn::RebindMask(di, q_max <= q_min + q_min));
    }
    // Exact where it is used: both differences fit 13 bits with sign for small triangles.
    const auto area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    auto kept = area != hn::Zero(di);
    if (culling.front) kept = hn::And(kept, area > hn::Zero(di));
    if (culling.back) kept = hn::And(kept, area < hn::Zero(di));

    for (std::uint32_t wide = BitsOf(hn::AndNot(is_small, touched)); wide != 0; wide &= wide - 1) {
      SetUpWide(task, screen, first + static_cast<std::uint32_t>(__builtin_ctz(wide)), batch);
    }
    auto small = hn::And(hn::And(touched, is_small), kept);
    if (hn::AllFalse(di, small)) continue;
    const SmallEdges edges = FindEdges(c, box, area < hn::Zero(di));
    if (has_one_sample) small = hn::AndNot(MissSamples(edges, box), small);
    if (hn::AllFalse(di, small)) continue;
    Store(edges, box, FindDepths(c, q, box), first_id + first, kind, records);
    EmitSmall(records, BitsOf(small), batch);
    bounds.Include(box, small);
  }
  batch.small_pixels.include(bounds.Pixels());
}

void set_up_cluster(const SetupTask& task, Batch& batch) {
  const Cluster& cluster = task.geometry->clusters[task.cluster];
  batch.statistics.triangles += cluster.triangle_count;
  ScreenVertices screen;
  Stopwatch watch;
  if (task.transform_ms != nullptr) watch.start();
  TransformVertices(*task.setup, *task.geometry, cluster, screen);
  if (task.transform_ms != nullptr) *task.transform_ms += watch.lap_ms();
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
