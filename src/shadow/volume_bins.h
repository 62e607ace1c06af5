// A light's shadow volumes as an eye sees them, sorted into the tiles of its picture.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/aligned_vector.h"
#include "base/task_pool.h"
#include "raster/triangle_bins.h"
#include "shadow/eye_directions.h"
#include "shadow/volume_surface.h"

namespace laterna::shadow {

/// A triangle of the surface with what lines of sight are tested against.
struct VolumeFacet {
  /// The line of sight in direction d passes inside of edge k where edge[k] · d > 0, as long as that is more than
  /// doubt[k], which bounds what rounding may have done to it.
  double edge[3][3];
  double doubt[3];
  /// What is crossed lies beyond the point p where plane · (p, 1) > 0.
  double plane[4];
  std::int32_t step = 0;  ///< volumes left here, less volumes entered
  std::array<VolumeCorner, 3> corner;
  std::int8_t turn = 0;  ///< of the corners: 1 or −1, times edge k's exact sign is 1 inside
};

/// The volume of a cut-out's triangle: the point p is in it where plane · (p, 1) > 0 for all planes, give or take what
/// rounding may have done, `doubt`.
struct PrismPlanes {
  double plane[4][4];
  double doubt[4];
  TriangleId caster;
};

/// Which facets a line of sight may cross, and in which prisms its samples may lie.
class VolumeBins {
 public:
  /// Tiles are the rasteriser's. Their 64 cells are 8 × 8 pixels.
  static constexpr int kCellBits = 3;
  static constexpr int kCellsPerSide = raster::kTileSide >> kCellBits;
  static_assert(kCellsPerSide * kCellsPerSide == 64);

  /// A facet or prism in a tile, and the cells that it may touch.
  struct Entry {
    std::uint64_t cells;
    std::uint32_t index;
  };
  /// Where a line of sight passes.
  struct Place {
    int tile = -1;  ///< −1: outside of all tiles
    int cell = 0;
  };

  /// The surface must outlive this.
  VolumeBins(const VolumeSurface& surface, const light::LightRays& light, const Eye& eye,
             const raster::RasterView& camera, const frame::Bounds& bounds, const TaskPool& pool);

  [[nodiscard]] Place place_of(const EyeDirection& direction) const;
  [[nodiscard]] std::span<const Entry> facets_in(int tile) const { return facet_lists_.in(tile); }
  [[nodiscard]] std::span<const Entry> prisms_in(int tile) const { return prism_lists_.in(tile); }
  [[nodiscard]] const VolumeFacet& facet(std::uint32_t index) const { return facets_[index]; }
  [[nodiscard]] const PrismPlanes& prism(std::uint32_t index) const { return prisms_[index]; }

  /// The triangle of the surface, wherever the eye sees it; none where it sees it edge-on.
  [[nodiscard]] std::optional<VolumeFacet> facet_of(const VolumeTriangle& triangle) const;

  /// Whether the line of sight passes through the facet, without rounding.
  [[nodiscard]] bool is_crossed(const VolumeFacet& facet, const EyeDirection& direction) const;

  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  // Entries by tile.
  struct Lists {
    std::vector<std::size_t> offsets;
    std::vector<Entry> entries;
    [[nodiscard]] std::span<const Entry> in(int tile) const {
      const auto i = static_cast<std::size_t>(tile);
      return {entries.data() + offsets[i], offsets[i + 1] - offsets[i]};
    }
    [[nodiscard]] std::size_t memory_bytes() const {
      return offsets.capacity() * sizeof(std::size_t) + entries.capacity() * sizeof(Entry);
    }
  };
  struct TileEntry {
    std::int32_t tile;
    Entry entry;
  };
  template <class Item>
  struct Batch;
  class Sorter;

  [[nodiscard]] const EyeDirection& direction_to(const VolumeCorner& corner) const {
    return corner.is_infinite ? to_ends_[corner.point] : to_points_[corner.point];
  }
  void find_plane(const VolumeTriangle& triangle, double (&plane)[4]) const;
  [[nodiscard]] PrismPlanes planes_of(const VolumePrism& prism) const;
  void sort_facets(const TaskPool& pool);
  void sort_prisms(const TaskPool& pool);
  template <class Item>
  void merge(std::span<Batch<Item>> batches, std::vector<Item>& items, Lists& lists) const;

  const VolumeSurface& surface_;
  const light::LightRays& light_;
  Eye eye_;
  int x_begin_, y_begin_, tiles_x_, tiles_y_;  // pixels from the picture's middle
  std::vector<EyeDirection> to_points_, to_ends_;
  double farthest_ = 0;  // coordinate of what is lit
  std::vector<VolumeFacet> facets_;
  std::vector<PrismPlanes> prisms_;
  Lists facet_lists_, prism_lists_;
};

}  // namespace laterna::shadow
