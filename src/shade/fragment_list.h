// Samples of blended surfaces over a tile's opaque ones.
#pragma once

#include <vector>

#include "frame/frame.h"
#include "raster/tile_raster.h"

namespace laterna::shade {

class FragmentList {
 public:
  void clear() { fragments_.clear(); }
  [[nodiscard]] bool is_empty() const { return fragments_.empty(); }
  [[nodiscard]] std::vector<raster::Fragment>& list() { return fragments_; }
  [[nodiscard]] const std::vector<raster::Fragment>& list() const { return fragments_; }

  /// By pixel, then back to front; at equal depth the smaller id is in front, as for opaque surfaces.
  void sort();

  /// Indices of the sorted list, those of one surface together.
  struct Run {
    std::uint32_t surface = 0;
    std::span<const std::uint32_t> fragments;
  };
  std::span<const Run> by_surface(const frame::Frame& frame);

 private:
  std::vector<raster::Fragment> fragments_;
  std::vector<std::uint32_t> order_;
  std::vector<Run> runs_;
};

}  // namespace laterna::shade
