#include "shade/sheen_albedo.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "base/sample_sequence.h"

namespace laterna::shade {
namespace {

constexpr double kLeastAlpha = 1e-3;
constexpr double kLog2E = 1.4426950408889634;

// L(x) of Estevez & Kulla 2017, table 1: parameters for α 0 and 1, mixed by (1 − α)².
double fitted_exponent(double x, double alpha) {
  const double t = (1 - alpha) * (1 - alpha);
  const auto mix = [&](double smooth, double rough) { return rough + (smooth - rough) * t; };
  const double a = mix(25.3245, 21.5473), b = mix(3.32435, 3.82987), c = mix(0.16801, 0.19823),
               d = mix(-1.27393, -1.97760), e = mix(-4.85967, -4.32054);
  return a / (1 + b * power(x, c)) + d * x + e;
}

double masking(double cosine, double alpha) {
  const double exponent = cosine < 0.5 ? fitted_exponent(cosine, alpha)
                                       : 2 * fitted_exponent(0.5, alpha) - fitted_exponent(1 - cosine, alpha);
  return exponential2(exponent * kLog2E);
}

}  // namespace

double sheen_lobe(double n_l, double n_v, double n_h, double roughness) {
  const double alpha = std::max(roughness * roughness, kLeastAlpha);
  const double distribution = (2 + 1 / alpha) * power(std::max(0.0, 1 - n_h * n_h), 0.5 / alpha) / (2 * kPi);
  return distribution / ((1 + masking(n_v, alpha) + masking(n_l, alpha)) * 4 * n_l * n_v);
}

double integrate_sheen(double n_v, double roughness, int count) {
  const double v_x = std::sqrt(std::max(0.0, 1 - n_v * n_v));
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    // Evenly over the hemisphere: density 1 / 2π.
    const auto [u, v] = lattice_point({i, count});
    const double n_l = std::max(u, 1e-6), turn = 2 * kPi * v;
    const double l_x = std::sqrt(1 - n_l * n_l) * cosine(turn), l_y = std::sqrt(1 - n_l * n_l) * sine(turn);
    const double h_x = v_x + l_x, h_z = n_v + n_l;
    const double n_h = h_z / std::sqrt(h_x * h_x + l_y * l_y + h_z * h_z);
    sum += sheen_lobe(n_l, n_v, n_h, roughness) * n_l * 2 * kPi;
  }
  return std::min(sum / count, 1.0);
}

SheenAlbedo make_sheen_albedo(const TaskPool& pool) {
  constexpr int kSamples = 512;
  constexpr double kLeastCosine = 1e-3;
  SheenAlbedo table;
  pool.for_each(SheenAlbedo::kSide, [&](std::size_t row, int) {
    const double roughness = static_cast<double>(row) / (SheenAlbedo::kSide - 1);
    for (std::size_t column = 0; column < SheenAlbedo::kSide; ++column) {
      const double n_v = std::max(static_cast<double>(column) / (SheenAlbedo::kSide - 1), kLeastCosine);
      table.share[row * SheenAlbedo::kSide + column] =
          static_cast<float>(integrate_sheen(n_v, roughness, kSamples));
    }
  });
  return table;
}

}  // namespace laterna::shade
