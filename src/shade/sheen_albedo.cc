#include "shade/sheen_albedo.h"

#include <algorithm>
#include <cmath>
#include <vector>

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

// A direction of light, evenly spread over the hemisphere, and what of the lobe depends on it alone.
struct LightDirection {
  double x, y, z, masking;
};

std::vector<LightDirection> directions(double alpha, int count) {
  std::vector<LightDirection> result;
  for (int i = 0; i < count; ++i) {
    const auto [u, v] = lattice_point({i, count});
    const double r = std::sqrt(1 - u * u), turn = 2 * kPi * v;
    result.push_back({r * cosine(turn), r * sine(turn), u, masking(u, alpha)});
  }
  return result;
}

// D V n·l over the density 1 / 2π of the directions, summed: equations 2 and 3.
double integrate_sheen(double n_v, double alpha, const std::vector<LightDirection>& lights) {
  const double v_x = std::sqrt(std::max(0.0, 1 - n_v * n_v)), masking_v = masking(n_v, alpha);
  double sum = 0;
  for (const LightDirection& light : lights) {
    const double h_x = v_x + light.x, h_y = light.y, h_z = n_v + light.z;
    const double n_h_squared = h_z * h_z / (h_x * h_x + h_y * h_y + h_z * h_z);
    sum += power(std::max(0.0, 1 - n_h_squared), 0.5 / alpha) / (1 + masking_v + light.masking);
  }
  return std::min(sum * (2 + 1 / alpha) / (4 * n_v * static_cast<double>(lights.size())), 1.0);
}

}  // namespace

SheenAlbedo make_sheen_albedo(const TaskPool& pool) {
  constexpr int kSamples = 512;
  constexpr double kLeastCosine = 1e-3;
  SheenAlbedo table;
  pool.for_each(SheenAlbedo::kSide, [&](std::size_t row, int) {
    const double roughness = static_cast<double>(row) / (SheenAlbedo::kSide - 1);
    const double alpha = std::max(roughness * roughness, kLeastAlpha);
    const std::vector<LightDirection> lights = directions(alpha, kSamples);
    for (std::size_t column = 0; column < SheenAlbedo::kSide; ++column) {
      const double n_v = std::max(static_cast<double>(column) / (SheenAlbedo::kSide - 1), kLeastCosine);
      table.share[row * SheenAlbedo::kSide + column] =
          static_cast<float>(integrate_sheen(n_v, alpha, lights));
    }
  });
  return table;
}

}  // namespace laterna::shade
