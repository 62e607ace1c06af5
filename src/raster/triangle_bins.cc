#include "raster/triangle_bins.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/stopwatch.h"
#include "raster/triangle_setup.h"

namespace laterna::raster {
namespace {

/// Clusters handed to one task: enough triangles to pay for sorting them by tile, few enough to stay in cache.
constexpr std::size_t kClustersPerBatch = 32;

// A linear form over (position − eye), with its additive term: ≥ 0 on the inner side of a clipping plane.
struct Halfspace {
  glm::dvec3 normal;
  double offset;
};

struct Bounds {
  double low, high;  // of a halfspace's form over a box
};

Bounds over_box(const Halfspace& h, glm::dvec3 centre, glm::dvec3 extent) {
  const double middle = glm::dot(h.normal, centre) + h.offset;
  const double reach = glm::dot(glm::abs(h.normal), extent);
  return {middle - reach, middle + reach};
}

class ClusterPlacer {
 public:
  ClusterPlacer(const RasterView& view, const BinOptions& options) : view_(view) {
    const Rect& pixels = options.pixels;
    const auto side = [&](double sign, const glm::dvec3& row, double add, double limit) {
      // sign · (X − limit · W) ≥ 0, W = 1 in an orthographic view.
      if (view.is_orthographic) return Halfspace{sign * row, sign * (add - limit)};
      return Halfspace{sign * (row - limit * view.w_row), 0.0};
    };
    // One pixel wider than wanted: samples and snapping reach half a pixel and a little more.
    needed_ = {side(+1, view.x_row, view.x_add, pixels.x_begin - view.origin_x - 1),
               side(-1, view.x_row, view.x_add, pixels.x_end - view.origin_x + 1),
               side(+1, view.y_row, view.y_add, pixels.y_begin - view.origin_y - 1),
               side(-1, view.y_row, view.y_add, pixels.y_end - view.origin_y + 1)};
    guard_ = {side(+1, view.x_row, view.x_add, -kGuardBand), side(-1, view.x_row, view.x_add, kGuardBand),
              side(+1, view.y_row, view.y_add, -kGuardBand), side(-1, view.y_row, view.y_add, kGuardBand)};
    const glm::dvec3 forward = view.view.pose.forward_ws();
    near_ = {forward, -view.view.projection.near};
    far_ = {-forward, view.view.projection.far};
    if (options.cut != nullptr) cut_ = {options.cut->normal_ws, options.cut->side(view.eye_ws)};
  }

  struct Placed {
    ClusterPlace place;
    double nearest;  // distance along the axis
  };

  [[nodiscard]] Placed place(const Cluster& cluster) const {
    const glm::dvec3 low(cluster.low_ws[0], cluster.low_ws[1], cluster.low_ws[2]);
    const glm::dvec3 high(cluster.high_ws[0], cluster.high_ws[1], cluster.high_ws[2]);
    const glm::dvec3 centre = 0.5 * (low + high) - view_.eye_ws;
    const glm::dvec3 extent = 0.5 * (high - low);
    const Bounds near = over_box(near_, centre, extent);
    if (near.high < 0 || over_box(far_, centre, extent).high < 0) return {ClusterPlace::outside, 0};
    for (const Halfspace& h : needed_) {
      if (over_box(h, centre, extent).high < 0) return {ClusterPlace::outside, 0};
    }
    const Bounds cut = over_box(cut_, centre, extent);
    if (cut.high < 0) return {ClusterPlace::outside, 0};
    const double nearest = near.low + view_.view.projection.near;
    // A hair's breadth of distance is left to the rounding of the float transform.
    if (near.low <= 1e-5 * view_.view.projection.near) return {ClusterPlace::crossing, nearest};
    if (cut.low <= 0) return {ClusterPlace::crossing, nearest};
    for (const Halfspace& h : guard_) {
      if (over_box(h, centre, extent).low <= 0) return {ClusterPlace::crossing, nearest};
    }
    return {ClusterPlace::inside, nearest};
  }

 private:
  const RasterView& view_;
  std::array<Halfspace, 4> needed_, guard_;
  Halfspace near_, far_;
  Halfspace cut_ = {glm::dvec3(0), 1};  // without: everything is before it
};

// The tiles of pixels that are given from the view's origin.
Rect tiles_of(const Rect& box, const RasterView& view, const Rect& pixels) {
  const int x = view.origin_x, y = view.origin_y;
  return {std::max(box.x_begin + x, pixels.x_begin) >> kTileBits,
          std::max(box.y_begin + y, pixels.y_begin) >> kTileBits,
          ((std::min(box.x_end + x, pixels.x_end) - 1) >> kTileBits) + 1,
          ((std::min(box.y_end + y, pixels.y_end) - 1) >> kTileBits) + 1};
}

Rect pixels_of(const WideTriangle& t, int reach) { return raster::pixels_of(t.x, t.y, reach); }
Rect pixels_of(const SmallTriangle& t, int) { return {t.x, t.y, t.x + t.columns, t.y + t.rows}; }

// Edge functions of a triangle at the corners of tiles, to leave out tiles that its bounding box touches and it does
// not. Exact up to rounding, which is paid for by a margin of two pixels.
class TileRejector {
 public:
  TileRejector(const WideTriangle& t, const RasterView& view) {
    for (int i = 0; i < 3; ++i) {
      const int j = i == 2 ? 0 : i + 1;
      const double a = t.y[i] - t.y[j];
      const double b = t.x[j] - t.x[i];
      const double scale = kSubpixels;
      slope_x_[i] = a * scale;
      slope_y_[i] = b * scale;
      offset_[i] = a * (-view.origin_x * scale - t.x[i]) + b * (-view.origin_y * scale - t.y[i]);
      // Largest over a tile, with the margin.
      offset_[i] += std::max(slope_x_[i], 0.0) * kTileSide + std::max(slope_y_[i], 0.0) * kTileSide +
                    2 * (std::abs(slope_x_[i]) + std::abs(slope_y_[i]));
    }
  }

  [[nodiscard]] bool may_touch(int tile_x, int tile_y) const {
    for (int i = 0; i < 3; ++i) {
      if (offset_[i] + slope_x_[i] * (tile_x * kTileSide) + slope_y_[i] * (tile_y * kTileSide) < 0)
        return false;
    }
    return true;
  }

 private:
  double slope_x_[3], slope_y_[3], offset_[3];
};

template <class Visit>
void for_each_tile(const SmallTriangle&, const RasterView&, const Rect& tiles, Visit visit) {
  for (int y = tiles.y_begin; y < tiles.y_end; ++y) {
    for (int x = tiles.x_begin; x < tiles.x_end; ++x) visit(x, y);
  }
}

template <class Visit>
void for_each_tile(const WideTriangle& t, const RasterView& view, const Rect& tiles, Visit visit) {
  const bool is_in_few = tiles.width() * tiles.height() <= 2;
  const TileRejector rejector(t, view);
  for (int y = tiles.y_begin; y < tiles.y_end; ++y) {
    for (int x = tiles.x_begin; x < tiles.x_end; ++x) {
      if (is_in_few || rejector.may_touch(x, y)) visit(x, y);
    }
  }
}

// A triangle in one of the lists of the tiles that it touches.
struct ListEntry {
  std::uint32_t list, triangle;
};

// Every list of every triangle, in drawing order. Counts a list's entries two places beyond its own.
template <class Triangle>
void find_list_entries(std::span<const Triangle> triangles, const RasterView& view, const BinOptions& options,
                       std::vector<ListEntry>& entries, TileLists& lists) {
  entries.clear();
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    const Rect tiles = tiles_of(pixels_of(t, options.sample_reach), view, options.pixels);
    const bool has_holes = (t.kind & kMasked) != 0;
    for_each_tile(t, view, tiles, [&](int x, int y) {
      const std::size_t list = lists.list_number(x, y, has_holes);
      entries.push_back({static_cast<std::uint32_t>(list), i});
      ++lists.offsets[list + 2];
      lists.nearest[list] = std::max(lists.nearest[list], t.q_max);
    });
  }
}

// Counting sort by tile and holes, stable: drawing order is kept within each list. `found`: scratch.
template <class Triangle>
void sort_by_tile(std::span<const Triangle> triangles, const Rect& touched, const RasterView& view,
                  const BinOptions& options, std::vector<ListEntry>& found, TileLists& lists) {
  lists.tiles = triangles.empty() ? Rect() : tiles_of(touched, view, options.pixels);
  const std::size_t count = 2 * static_cast<std::size_t>(lists.tiles.width() * lists.tiles.height());
  lists.offsets.assign(count + 2, 0);
  lists.nearest.assign(count, std::numeric_limits<float>::lowest());
  find_list_entries(triangles, view, options, found, lists);
  // Shifted by one place, the counts become where each list starts, and then, entry by entry, where it ends: which is
  // where the next one starts.
  for (std::size_t i = 2; i < lists.offsets.size(); ++i) lists.offsets[i] += lists.offsets[i - 1];
  std::uint32_t* next = lists.offsets.data() + 1;
  lists.entries.resize(found.size());
  for (const ListEntry& entry : found) lists.entries[next[entry.list]++] = entry.triangle;
  lists.offsets.pop_back();
}

struct OrderedCluster {
  float nearest;
  std::uint32_t cluster;
  bool crossing;
};

std::vector<OrderedCluster> visible_clusters(const RasterView& view, std::span<const Cluster> clusters,
                                             const BinOptions& options) {
  const ClusterPlacer placer(view, options);
  std::vector<OrderedCluster> visible;
  visible.reserve(clusters.size());
  for (std::uint32_t i = 0; i < clusters.size(); ++i) {
    if ((clusters[i].flags & options.required_flags) != options.required_flags) continue;
    if ((clusters[i].flags & options.excluded_flags) != 0) continue;
    if (options.left_out != nullptr && (*options.left_out)[i]) continue;
    const auto [place, nearest] = placer.place(clusters[i]);
    if (place == ClusterPlace::outside) continue;
    visible.push_back({static_cast<float>(nearest), i, place == ClusterPlace::crossing});
  }
  if (options.nearest_first) {
    std::sort(visible.begin(), visible.end(), [](const OrderedCluster& a, const OrderedCluster& b) {
      return a.nearest != b.nearest ? a.nearest < b.nearest : a.cluster < b.cluster;
    });
  }
  return visible;
}

// Sets up clusters one after the other. Time is taken by runs of clusters that cross the near plane or the guard band
// and of those that do not; the first of these tells how transform and set-up share the time of all.
void set_up_clusters(std::span<const OrderedCluster> clusters, SetupTask task, SetUpCluster set_up_cluster,
                     Batch& batch) {
  StageTimes& times = batch.statistics.times;
  StageTimes sample;
  double inside_ms = 0;
  Stopwatch watch;
  watch.start();
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    task.cluster = clusters[i].cluster;
    task.crossing = clusters[i].crossing;
    const bool is_sample = !task.crossing && inside_ms == 0;
    task.transform_ms = is_sample ? &sample[Stage::transform] : nullptr;
    set_up_cluster(task, batch);
    const bool ends_run = i + 1 == clusters.size() || clusters[i + 1].crossing != task.crossing;
    if (!ends_run && !is_sample) continue;
    const double ms = watch.lap_ms();
    (task.crossing ? times[Stage::clip] : inside_ms) += ms;
    if (is_sample) sample[Stage::set_up] = ms - sample[Stage::transform];
  }
  times += sample.share_out(inside_ms);
}

}  // namespace

void TriangleBins::fill(const RasterView& view, const TriangleClusters& geometry, const BinOptions& options,
                        const TaskPool& pool) {
  Stopwatch watch;
  watch.start();
  const std::vector<OrderedCluster> visible = visible_clusters(view, geometry.clusters, options);
  cull_ms_ = watch.lap_ms();
  used_ = (visible.size() + kClustersPerBatch - 1) / kClustersPerBatch;
  if (batches_.size() < used_) batches_.resize(used_);
  const SetupView setup(view);
  const SetUpCluster set_up_cluster = set_up_cluster_for(options.instruction_set);
  std::vector<std::vector<ListEntry>> scratch(static_cast<std::size_t>(pool.threads()));
  pool.for_each(used_, [&](std::size_t index, int worker) {
    Batch& batch = batches_[index];
    batch.small.clear();
    batch.wide.clear();
    batch.small_pixels = batch.wide_pixels = Rect::nowhere();
    const std::size_t first = index * kClustersPerBatch;
    const std::size_t count = std::min(kClustersPerBatch, visible.size() - first);
    batch.statistics = {};
    batch.statistics.clusters = count;
    set_up_clusters(std::span(visible).subspan(first, count), {&setup, &geometry, &options, 0, false},
                    set_up_cluster, batch);
    batch.statistics.triangles_binned = batch.small.size() + batch.wide.size();
    Stopwatch sort_watch;
    sort_watch.start();
    std::vector<ListEntry>& found = scratch[static_cast<std::size_t>(worker)];
    sort_by_tile<SmallTriangle>(batch.small, batch.small_pixels, view, options, found, batch.small_by_tile);
    sort_by_tile<WideTriangle>(batch.wide, batch.wide_pixels, view, options, found, batch.wide_by_tile);
    batch.statistics.times[Stage::bin] = sort_watch.lap_ms();
  });
}

BinStatistics TriangleBins::statistics() const {
  BinStatistics sum;
  sum.times[Stage::cull] = cull_ms_;
  for (const Batch& batch : batches()) {
    sum.clusters += batch.statistics.clusters;
    sum.triangles += batch.statistics.triangles;
    sum.triangles_binned += batch.statistics.triangles_binned;
    sum.times += batch.statistics.times;
  }
  return sum;
}

std::size_t TriangleBins::memory_bytes() const {
  const auto bytes = [](const auto& values) { return values.capacity() * sizeof(values[0]); };
  std::size_t sum = 0;
  for (const Batch& batch : batches_) {
    sum += bytes(batch.small) + bytes(batch.wide);
    for (const TileLists* lists : {&batch.small_by_tile, &batch.wide_by_tile}) {
      sum += bytes(lists->offsets) + bytes(lists->entries) + bytes(lists->nearest);
    }
  }
  return sum;
}

}  // namespace laterna::raster
