// From samples in a batch to pixels of a tile.
#pragma once

#include "laterna/instruction_set.h"
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
    for (unsigned mask = samples.active[group]; mask != 0; mask &= mask - 1) {
      const auto i = static_cast<std::size_t>(__builtin_ctz(mask));
      target[pixel[i]] = values[first + i];
    }
  }
}

/// The same for colours. Up to kGroupSize − 1 places behind a target's last are written to, with what is there.
using ScatterRadiance = void (*)(const shadow::SurfaceSamples& samples, const Radiance& radiance,
                                 const ColorTarget& target);
ScatterRadiance scatter_radiance_for(InstructionSet set);

}  // namespace laterna::shade
