#include "shade/split_sum.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "base/sample_sequence.h"

namespace laterna::shade {

ScaleAndBias integrate_reflectance(double n_v, double roughness, int count) {
  // As ReflectPbr has it: the least α, and the separable form of Smith's term.
  const double alpha = std::max(roughness * roughness, 1e-3);
  const double a2 = alpha * alpha;
  const auto smith = [&](double cosine) { return cosine + std::sqrt(a2 + (1 - a2) * cosine * cosine); };
  const double v_x = std::sqrt(std::max(0.0, 1 - n_v * n_v));
  ScaleAndBias sum{0, 0};
  for (int i = 0; i < count; ++i) {
    const auto [u, v] = lattice_point({i, count});
    const double turn = 2 * kPi * v;
    const double n_h = std::sqrt((1 - u) / (1 + (a2 - 1) * u));
    const double h_x = std::sqrt(std::max(0.0, 1 - n_h * n_h)) * cosine(turn);
    const double v_h = v_x * h_x + n_v * n_h;
    const double n_l = 2 * v_h * n_h - n_v;
    if (n_l <= 0 || v_h <= 0) continue;
    // f n·l / density, with density D n·h / (4 v·h) of light directions: D cancels.
    const double share = 4 * n_l * v_h / (n_h * smith(n_l) * smith(n_v));
    const double m = 1 - v_h;
    const double fresnel = m * m * m * m * m;
    sum.scale += share * (1 - fresnel);
    sum.bias += share * fresnel;
  }
  return {sum.scale / count, sum.bias / count};
}

SplitSum make_split_sum(const TaskPool& pool) {
  constexpr int kSamples = 512;
  constexpr double kLeastCosine = 1e-3;
  SplitSum table;
  pool.for_each(SplitSum::kSide, [&](std::size_t row, int) {
    const double roughness = static_cast<double>(row) / (SplitSum::kSide - 1);
    for (std::size_t column = 0; column < SplitSum::kSide; ++column) {
      const double n_v = std::max(static_cast<double>(column) / (SplitSum::kSide - 1), kLeastCosine);
      const ScaleAndBias entry = integrate_reflectance(n_v, roughness, kSamples);
      table.scale[row * SplitSum::kSide + column] = static_cast<float>(entry.scale);
      table.bias[row * SplitSum::kSide + column] = static_cast<float>(entry.bias);
    }
  });
  return table;
}

}  // namespace laterna::shade
