// How much of an environment a rough surface mirrors toward the eye: the second factor of the split sum.
#pragma once

#include <array>

#include "base/task_pool.h"

namespace laterna::shade {

/// The integral of GGX, Smith's masking and shadowing and Schlick's Fresnel term under light of 1 from everywhere is
/// F₀ scale + bias (Karis 2013, Real shading in Unreal Engine 4).
struct SplitSum {
  static constexpr int kSide = 32;
  /// By n·v across and roughness down, both from 0 to 1, the first and last entry at the ends.
  std::array<float, kSide * kSide> scale{}, bias{};
};
SplitSum make_split_sum(const TaskPool& pool);

struct ScaleAndBias {
  double scale, bias;
};
/// One entry; n·v in (0, 1], roughness in [0, 1], `count` directions.
ScaleAndBias integrate_reflectance(double n_v, double roughness, int count);

}  // namespace laterna::shade
