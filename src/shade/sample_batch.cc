#include "shade/sample_batch.h"

#include <algorithm>
#include <cmath>

namespace laterna::shade {

using shadow::kGroupSize;
using shadow::SurfaceSamples;

namespace {

// Samples that do not count become copies of one that does.
void repeat_active(SurfaceSamples& s, std::size_t group) {
  if (s.active[group] == 0xFFFFU) return;
  const std::size_t first = group * kGroupSize;
  const std::size_t from = first + static_cast<std::size_t>(__builtin_ctz(s.active[group]));
  for (std::size_t i = 0; i < kGroupSize; ++i) {
    if ((s.active[group] >> i & 1U) != 0) continue;
    s.x[first + i] = s.x[from];
    s.y[first + i] = s.y[from];
    s.q[first + i] = s.q[from];
    s.id[first + i] = s.id[from];
  }
}

}  // namespace

float position_error(const TileOrigin& origin, float least_q) {
  const frame::Bounds& bounds = origin.frame->bounds;
  float extent = 0;
  for (int k = 0; k < 3; ++k) extent = std::max({extent, std::abs(bounds.low[k]), std::abs(bounds.high[k])});
  const raster::RasterView& view = *origin.view;
  const float distance = view.is_orthographic ? static_cast<float>(view.view.projection.far) : 1 / least_q;
  // Half a unit in the last place of the coordinates as stored, and a few of the distance for the ray's arithmetic.
  return 1.2e-7F * extent + 4e-7F * distance;
}

TileOrigin::TileOrigin(const frame::Frame& of_frame, const raster::RasterView& of_view, int tile_x,
                       int tile_y, int offset_x, int offset_y)
    : frame(&of_frame),
      view(&of_view),
      x(static_cast<float>(tile_x * raster::kTileSide - of_view.origin_x) +
        (0.5F + static_cast<float>(offset_x) / raster::kSubpixels)),
      y(static_cast<float>(tile_y * raster::kTileSide - of_view.origin_y) +
        (0.5F + static_cast<float>(offset_y) / raster::kSubpixels)) {}

void fill_from_fragments(const TileOrigin& origin, std::span<const raster::Fragment> fragments,
                         std::span<const std::uint32_t> indices, SurfaceSamples& s) {
  s.group_count = (indices.size() + kGroupSize - 1) / kGroupSize;
  std::fill_n(s.active.begin(), s.group_count, std::uint16_t{0});
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const raster::Fragment& fragment = fragments[indices[i]];
    const std::uint32_t block = fragment.pixel / kGroupSize;
    const auto column = block % raster::kBlocksPerSide, row = block / raster::kBlocksPerSide;
    s.x[i] = origin.x + static_cast<float>(column * 4 + (fragment.pixel & 3U));
    s.y[i] = origin.y + static_cast<float>(row * 4 + (fragment.pixel >> 2U & 3U));
    s.q[i] = fragment.reversed_depth;
    s.id[i] = fragment.id;
    s.pixel[i] = indices[i];
    std::uint16_t& active = s.active[i / kGroupSize];
    active = static_cast<std::uint16_t>(active | 1U << (i % kGroupSize));
  }
  repeat_active(s, s.group_count - 1);
  const auto end = s.q.begin() + static_cast<std::ptrdiff_t>(s.group_count * kGroupSize);
  s.position_error = position_error(origin, *std::min_element(s.q.begin(), end));
}

}  // namespace laterna::shade
