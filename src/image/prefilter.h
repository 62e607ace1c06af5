// Environments as rough surfaces mirror them: the kernel.
#pragma once

#include <span>

#include "image/octahedral_levels.h"
#include "laterna/instruction_set.h"

namespace laterna::image {

/// One light direction of a lobe about +Z, with its weight; weights add up to 1. The source is read between `level` and
/// the one after it.
struct LobeSample {
  float x, y, z, weight;
  std::uint32_t level;
  float blend;
};

/// Row `y` of level `to` of `out`: for each texel the weighted mean of `source` over the lobe about the texel's direction.
/// The last level of `source` is not asked for a next one: its samples have blend 0.
using PrefilterRow = void (*)(const OctahedralLevels& source, std::span<const LobeSample> lobe,
                              std::size_t to, int y, OctahedralLevels& out);
PrefilterRow prefilter_row_for(InstructionSet set);

}  // namespace laterna::image
