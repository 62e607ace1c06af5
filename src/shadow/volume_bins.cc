#include "shadow/volume_bins.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace laterna::shadow {
namespace {

using raster::kTileSide;

// Samples have been moved a little toward the light, and pixels are stretched by the directions' rounding: boxes of
// pixels are taken larger by this.
constexpr double kMargin = 1.0 / 8;

// Triangles or prisms that one task sorts.
constexpr std::size_t kItemsPerTask = 8192;

// Of the products of an edge, whose components are rounded to double, and a direction, and their sum: eight half units
// in the last place are more than enough.
constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon() * kDirectionScale;

// Of points in prisms, whose triangle decides in the end: larger than rounding can be.
constexpr double kPrismRounding = 1e-12;

struct Box {
  double x_low, y_low, x_high, y_high;
};

}  // namespace

template <class Item>
struct VolumeBins::Batch {
  std::vector<Item> items;
  std::vector<TileEntry> entries;

  // `entries` end with those of one item, from `first`: several of a tile become one. Where there are any, it is kept.
  void keep(const Item& item, std::size_t first) {
    const auto begin = entries.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(begin, entries.end(), [](const TileEntry& a, const TileEntry& b) { return a.tile < b.tile; });
    std::size_t end = first;
    for (std::size_t i = first; i < entries.size(); ++i) {
      if (end > first && entries[end - 1].tile == entries[i].tile) {
        entries[end - 1].entry.cells |= entries[i].entry.cells;
      } else {
        entries[end++] = entries[i];
      }
    }
    entries.resize(end);
    for (std::size_t i = first; i < end; ++i)
      entries[i].entry.index = static_cast<std::uint32_t>(items.size());
    if (end > first) items.push_back(item);
  }
};

// Finds the cells that one facet may touch: quarters of quarters of the picture, as long as none of its edges has them
// wholly outside.
class VolumeBins::Sorter {
 public:
  Sorter(const VolumeBins& bins, const VolumeFacet& facet, std::vector<TileEntry>& entries)
      : bins_(bins), facet_(facet), entries_(entries) {
    find_bounds();
  }

  void sort() {
    int side = 1;
    while (side < std::max(bins_.tiles_x_, bins_.tiles_y_)) side *= 2;
    visit_tiles(0, 0, side);
  }

 private:
  // Where all corners are in front of the eye, the facet lies between them.
  void find_bounds() {
    const double far = std::numeric_limits<double>::infinity();
    bounds_ = {far, far, -far, -far};
    for (const VolumeCorner& corner : facet_.corner) {
      const EyeDirection& d = bins_.direction_to(corner);
      if (d.w <= kDirectionScale >> 16U) {
        bounds_ = {-far, -far, far, far};
        return;
      }
      const double x = bins_.eye_.unit() * d.x / d.w;
      const double y = bins_.eye_.unit() * d.y / d.w;
      bounds_ = {std::min(bounds_.x_low, x), std::min(bounds_.y_low, y), std::max(bounds_.x_high, x),
                 std::max(bounds_.y_high, y)};
    }
  }

  [[nodiscard]] bool touches(double x, double y, double size) const {
    const Box box = {x - kMargin, y - kMargin, x + size + kMargin, y + size + kMargin};
    if (box.x_high < bounds_.x_low || box.x_low > bounds_.x_high || box.y_high < bounds_.y_low ||
        box.y_low > bounds_.y_high) {
      return false;
    }
    const double unit = bins_.eye_.unit();
    return std::all_of(std::begin(facet_.edge), std::end(facet_.edge), [&](const double(&e)[3]) {
      const double at_corner =
          e[0] * (e[0] > 0 ? box.x_high : box.x_low) + e[1] * (e[1] > 0 ? box.y_high : box.y_low);
      return at_corner + e[2] * unit >= 0;
    });
  }

  void visit_tiles(int tile_x, int tile_y, int side) {
    if (tile_x >= bins_.tiles_x_ || tile_y >= bins_.tiles_y_) return;
    const int x = bins_.x_begin_ + tile_x * kTileSide;
    const int y = bins_.y_begin_ + tile_y * kTileSide;
    if (!touches(x, y, side * kTileSide)) return;
    if (side == 1) {
      cells_ = 0;
      visit_cells(x, y, 0, 0, kCellsPerSide / 2);
      if (cells_ != 0) entries_.push_back({tile_y * bins_.tiles_x_ + tile_x, {cells_, 0}});
      return;
    }
    const int half = side / 2;
    for (int k = 0; k < 4; ++k) visit_tiles(tile_x + (k & 1) * half, tile_y + (k >> 1) * half, half);
  }

  // The four squares of `side` cells from (cell_x, cell_y) of the tile at (x, y).
  void visit_cells(int x, int y, int cell_x, int cell_y, int side) {
    for (int k = 0; k < 4; ++k) {
      const int i = cell_x + (k & 1) * side;
      const int j = cell_y + (k >> 1) * side;
      if (!touches(x + (i << kCellBits), y + (j << kCellBits), side << kCellBits)) continue;
      if (side == 1) {
        cells_ |= std::uint64_t{1} << static_cast<unsigned>(j * kCellsPerSide + i);
      } else {
        visit_cells(x, y, i, j, side / 2);
      }
    }
  }

  const VolumeBins& bins_;
  const VolumeFacet& facet_;
  std::vector<TileEntry>& entries_;
  Box bounds_{};
  std::uint64_t cells_ = 0;
};

VolumeBins::VolumeBins(const VolumeSurface& surface, const light::LightRays& light, const Eye& eye,
                       const raster::RasterView& camera, const frame::Bounds& bounds, const TaskPool& pool)
    : surface_(surface),
      light_(light),
      eye_(eye),
      // A tile around the picture, for samples that are moved out of it.
      x_begin_(-camera.origin_x - kTileSide),
      y_begin_(-camera.origin_y - kTileSide),
      tiles_x_(raster::tiles_across(camera.width) + 2),
      tiles_y_(raster::tiles_across(camera.height) + 2) {
  for (int k = 0; k < 3; ++k)
    farthest_ = std::max({farthest_, std::abs(double{bounds.low[k]}), std::abs(double{bounds.high[k]})});
  for (const glm::dvec3& point : surface.points_ws()) {
    to_points_.push_back(eye_.to_point(point));
    to_ends_.push_back(eye_.to_infinity(light_.away_at(point)));
  }
  sort_facets(pool);
  sort_prisms(pool);
}

void VolumeBins::sort_facets(const TaskPool& pool) {
  const std::vector<VolumeTriangle>& triangles = surface_.triangles();
  std::vector<Batch<VolumeFacet>> batches((triangles.size() + kItemsPerTask - 1) / kItemsPerTask);
  pool.for_each(batches.size(), [&](std::size_t task, int) {
    Batch<VolumeFacet>& batch = batches[task];
    const std::size_t end = std::min((task + 1) * kItemsPerTask, triangles.size());
    for (std::size_t i = task * kItemsPerTask; i < end; ++i) {
      const std::optional<VolumeFacet> facet = facet_of(triangles[i]);
      if (!facet) continue;
      const std::size_t first = batch.entries.size();
      Sorter(*this, *facet, batch.entries).sort();
      batch.keep(*facet, first);
    }
  });
  merge(std::span(batches), facets_, facet_lists_);
}

// A line of sight that goes on from a point within a prism must leave it: where its surface is left, there may be such.
void VolumeBins::sort_prisms(const TaskPool& pool) {
  const std::vector<VolumePrism>& prisms = surface_.prisms();
  std::vector<Batch<PrismPlanes>> batches((prisms.size() + kItemsPerTask - 1) / kItemsPerTask);
  pool.for_each(batches.size(), [&](std::size_t task, int) {
    Batch<PrismPlanes>& batch = batches[task];
    const std::size_t end = std::min((task + 1) * kItemsPerTask, prisms.size());
    for (std::size_t i = task * kItemsPerTask; i < end; ++i) {
      const std::size_t first = batch.entries.size();
      for (const VolumeTriangle& triangle : surface_.surface_of(prisms[i])) {
        const std::optional<VolumeFacet> facet = facet_of(triangle);
        if (facet && facet->step > 0) Sorter(*this, *facet, batch.entries).sort();
      }
      batch.keep(planes_of(prisms[i]), first);
    }
  });
  merge(std::span(batches), prisms_, prism_lists_);
}

template <class Item>
void VolumeBins::merge(std::span<Batch<Item>> batches, std::vector<Item>& items, Lists& lists) const {
  std::vector<std::size_t>& offsets = lists.offsets;
  offsets.assign(static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y_) + 1, 0);
  std::size_t count = 0;
  for (const Batch<Item>& batch : batches) {
    count += batch.items.size();
    for (const TileEntry& e : batch.entries) ++offsets[static_cast<std::size_t>(e.tile) + 1];
  }
  for (std::size_t i = 1; i < offsets.size(); ++i) offsets[i] += offsets[i - 1];
  items.reserve(count);
  lists.entries.resize(offsets.back());
  std::vector<std::size_t> next(offsets.begin(), offsets.end() - 1);
  for (Batch<Item>& batch : batches) {
    const auto first = static_cast<std::uint32_t>(items.size());
    items.insert(items.end(), batch.items.begin(), batch.items.end());
    for (const TileEntry& e : batch.entries) {
      lists.entries[next[static_cast<std::size_t>(e.tile)]++] = {e.entry.cells, e.entry.index + first};
    }
    batch = {};
  }
}

std::optional<VolumeFacet> VolumeBins::facet_of(const VolumeTriangle& triangle) const {
  const EyeDirection d[3] = {direction_to(triangle.corner[0]), direction_to(triangle.corner[1]),
                             direction_to(triangle.corner[2])};
  const int turn = turn_of(d[0], d[1], d[2]);
  if (turn == 0) return std::nullopt;
  VolumeFacet facet;
  std::copy(std::begin(triangle.corner), std::end(triangle.corner), facet.corner.begin());
  facet.turn = static_cast<std::int8_t>(turn);
  for (std::size_t k = 0; k < 3; ++k) {
    const EdgeNormal n = edge_between(d[k], d[(k + 1) % 3]);
    const double components[3] = {static_cast<double>(n.x), static_cast<double>(n.y),
                                  static_cast<double>(n.w)};
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      facet.edge[k][i] = turn * components[i];
      sum += std::abs(components[i]);
    }
    facet.doubt[k] = sum * kRounding;
  }
  find_plane(triangle, facet.plane);
  // The determinant of the corners as the eye sees them is minus the eye's distance from their plane, times a positive
  // number and the sign of the eye's axes.
  const int eye_side = -turn * eye_.handedness();
  for (double& p : facet.plane) p *= eye_side;
  // An end is beyond everything.
  if (triangle.part == VolumePart::end) facet.plane[3] = 1;
  facet.step = eye_side > 0 ? -triangle.count : triangle.count;
  return facet;
}

// The outward normal, and what makes the plane 0. The first corner is a point unless all are infinitely far away.
void VolumeBins::find_plane(const VolumeTriangle& triangle, double (&plane)[4]) const {
  std::fill(std::begin(plane), std::end(plane), 0.0);
  if (triangle.corner[0].is_infinite) return;
  const std::vector<glm::dvec3>& points = surface_.points_ws();
  const glm::dvec3& origin = points[triangle.corner[0].point];
  const auto along = [&](const VolumeCorner& corner) {
    const glm::dvec3& point = points[corner.point];
    return corner.is_infinite ? light_.away_at(point) : point - origin;
  };
  const glm::dvec3 normal = glm::cross(along(triangle.corner[1]), along(triangle.corner[2]));
  for (int i = 0; i < 3; ++i) plane[i] = normal[i];
  plane[3] = -glm::dot(normal, origin);
}

PrismPlanes VolumeBins::planes_of(const VolumePrism& prism) const {
  PrismPlanes planes{};
  planes.caster = prism.caster;
  std::size_t k = 0;
  for (const VolumeTriangle& triangle : surface_.surface_of(prism)) {
    // Of a wall's two halves the first.
    if (triangle.part == VolumePart::end ||
        (triangle.part == VolumePart::side && triangle.corner[1].is_infinite))
      continue;
    double(&plane)[4] = planes.plane[k];
    find_plane(triangle, plane);
    double sum = std::abs(plane[3]);
    for (int i = 0; i < 3; ++i) sum += std::abs(plane[i]) * farthest_;
    for (double& p : plane) p = -p;
    planes.doubt[k++] = kPrismRounding * sum;
  }
  return planes;
}

VolumeBins::Place VolumeBins::place_of(const EyeDirection& direction) const {
  if (direction.w <= 0) return {};
  const double x = std::floor(eye_.unit() * direction.x / direction.w) - x_begin_;
  const double y = std::floor(eye_.unit() * direction.y / direction.w) - y_begin_;
  if (!(x >= 0 && y >= 0 && x < tiles_x_ * kTileSide && y < tiles_y_ * kTileSide)) return {};
  const auto column = static_cast<int>(x);
  const auto row = static_cast<int>(y);
  const auto cell = [](int pixel) { return (pixel & (kTileSide - 1)) >> kCellBits; };
  return {(row / kTileSide) * tiles_x_ + column / kTileSide, cell(row) * kCellsPerSide + cell(column)};
}

bool VolumeBins::is_crossed(const VolumeFacet& facet, const EyeDirection& direction) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const EdgeNormal edge =
        edge_between(direction_to(facet.corner[k]), direction_to(facet.corner[(k + 1) % 3]));
    if (side_of(edge, direction) * facet.turn <= 0) return false;
  }
  return true;
}

std::size_t VolumeBins::memory_bytes() const {
  return (to_points_.capacity() + to_ends_.capacity()) * sizeof(EyeDirection) +
         facets_.capacity() * sizeof(VolumeFacet) + prisms_.capacity() * sizeof(PrismPlanes) +
         facet_lists_.memory_bytes() + prism_lists_.memory_bytes();
}

}  // namespace laterna::shadow
