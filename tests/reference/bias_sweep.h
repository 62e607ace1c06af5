// What a bias does: too little and lit surfaces shade themselves, too much and shadows leave their casters.
#pragma once

#include "reference/shadow_truth.h"

namespace laterna::reference {

struct BiasEffect {
  int acne = 0;           ///< false dark pixels farther than kFarTexels from every true boundary
  double gap_texels = 0;  ///< lit floor between a sheet that stands on it and where its shadow begins
};

/// A sheet 1 m high on a floor, in a sun 45° high whose map has 512 texels a side.
BiasEffect effect_of_bias(const ShadowSettings& settings);

/// The gap that a constant bias must leave: a point g behind the sheet is g √2 from it along the light.
double expected_gap_texels(double constant_bias);

}  // namespace laterna::reference
