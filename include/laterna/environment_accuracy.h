// How far light from an environment, as pictures show it, is from the integral that it stands for.
#pragma once

#include <vector>

#include "laterna/environment.h"

namespace laterna {

/// Of one roughness and one angle of view, over directions of view all around.
struct SplitSumError {
  double roughness = 0;
  double n_v = 0;  ///< cosine between normal and eye
  /// Root mean square errors over the root mean square of the truth, of luminance. The truth is radiance × GGX × n·l for a
  /// white metal, light reflected once, by Monte Carlo.
  double split_sum = 0;
  /// Likewise of the prefiltered map alone, against its own integral, N = V = R: it does not depend on `n_v`.
  double prefilter = 0;
};

/// For roughness 0.25 … 1 (lobes narrower than that would need finer directions) and n·v 1, 0.8 … 0.2 (row 65: the remaining error of the split sum, by roughness and angle).
/// Errors: as convert_environment().
Result<std::vector<SplitSumError>> measure_split_sum(const LayeredImage& environment, EnvironmentChart chart,
                                                     int threads = 0);

}  // namespace laterna
