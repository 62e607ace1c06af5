// From samples in a batch to pixels of a tile.
#pragma once

#include <cstring>

#include "shade/illumination.h"
#include "shadow/surface_samples.h"

namespace laterna::shade {

/// Where one colour per sample goes; SurfaceSamples::pixel is the index.
struct ColorTarget {
  float *r, *g, *b;
};

/// target[pixel of sample i] = values[i], for the samples that count.
inline void scatter(const shadow::SurfaceSamples& samples, const float* values, float* target) {
  constexpr std::size_t kGroupSize = shadow::kGroupSize;
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    const std::size_t first = group * kGroupSize;
    const std::uint32_t* pixel = samples.pixel.data() + first;
    if (samples.active[group] == 0xFFFFU && pixel[15] == pixel[0] + 15) {
      // In pieces that compilers copy by themselves: a call for 64 bytes costs more than they do.
      for (std::size_t i = 0; i < kGroupSize; i += 4) {
        std::memcpy(target + *pixel + i, values + first + i, 4 * sizeof(float));
      }
      continue;
    }
    for (unsigned mask = samples.active[group]; mask != 0; mask &= mask - 1) {
      const auto i = static_cast<std::size_t>(__builtin_ctz(mask));
      target[pixel[i]] = values[first + i];
    }
  }
}

inline void scatter(const shadow::SurfaceSamples& samples, const Radiance& radiance,
                    const ColorTarget& target) {
  scatter(samples, radiance.r.data(), target.r);
  scatter(samples, radiance.g.data(), target.g);
  scatter(samples, radiance.b.data(), target.b);
}

}  // namespace laterna::shade
