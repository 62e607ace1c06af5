// Points on surfaces, the meeting point of visibility, shadows and shading. They come from a camera's pixels, from
// blended layers over them, or from anywhere else; shadow techniques and shading know no other source.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>

#include "base/triangle_clusters.h"
#include "raster/raster_view.h"

namespace laterna::shadow {

/// Samples are handled in groups of 16 (a 4 × 4 block of pixels where they come from a picture).
inline constexpr std::size_t kGroupSize = 16;
inline constexpr std::size_t kMaxGroups = 16;
inline constexpr std::size_t kMaxSamples = kGroupSize * kMaxGroups;

template <class T>
struct alignas(64) SampleArray : std::array<T, kMaxSamples> {};

struct SurfaceSamples {
  /// The homogeneous world point of a sample is ray_0 + ray_x x + ray_y y + q_term q (RasterView::Ray): x, y the
  /// pixel and q the reversed depth for a camera's samples.
  raster::RasterView::Ray ray;
  std::size_t group_count = 0;
  /// Samples of a group that count, a bit each. The others hold copies of one that does, so that every number is one.
  std::array<std::uint16_t, kMaxGroups> active{};

  SampleArray<float> x, y, q;
  SampleArray<TriangleId> id;
  SampleArray<std::uint32_t> pixel;  // where the result belongs, index in the tile

  // Filled in by shade::find_surface_points:
  SampleArray<float> x_ws, y_ws, z_ws;
  SampleArray<float> normal_x_ws, normal_y_ws,
      normal_z_ws;                  // of the triangle, unit, on the side that is seen
  SampleArray<float> dq_dx, dq_dy;  // reversed depth along the triangle's plane, per pixel
  /// Bounds on how far x_ws, y_ws, z_ws may be off by rounding, in metres.
  float position_error = 0;
};

/// Makes room for so many samples, up to kMaxSamples, all of which count.
inline void set_count(SurfaceSamples& samples, std::size_t count) {
  samples.group_count = (count + kGroupSize - 1) / kGroupSize;
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    const std::size_t there = std::min(kGroupSize, count - group * kGroupSize);
    samples.active[group] = static_cast<std::uint16_t>((1U << there) - 1);
  }
}

/// Calls `use(i)` for every sample named by `wanted`, a bit each, by group.
template <class Use>
void for_each_sample(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted, Use use) {
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    for (unsigned mask = wanted[group]; mask != 0; mask &= mask - 1)
      use(group * kGroupSize + static_cast<std::size_t>(__builtin_ctz(mask)));
  }
}

}  // namespace laterna::shadow
