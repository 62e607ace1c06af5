#include "reference/lamp_lights.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "frame/lamp_table.h"
#include "shade/illumination.h"

namespace laterna::reference {

std::vector<float> shaded_candela(const LightDistribution& lamp, std::span<const glm::dvec3> directions_ls,
                                  InstructionSet set) {
  const frame::LampTable table(lamp);
  Light light;
  light.attenuation = Attenuation::none;
  frame::PlacedLight placed;
  placed.light = &light;
  placed.lamp = &table;
  placed.intensity = table.peak_candela;
  auto samples = std::make_unique<shadow::SurfaceSamples>();
  auto points = std::make_unique<shade::SurfacePoints>();
  auto irradiance = std::make_unique<shade::Irradiance>();
  samples->group_count = shadow::kMaxGroups;
  const shade::BoundLight bound(placed, samples->ray, ShadingModel::phong, 1);
  std::vector<float> candela;
  for (std::size_t first = 0; first < directions_ls.size(); first += shadow::kMaxSamples) {
    const std::size_t count = std::min(shadow::kMaxSamples, directions_ls.size() - first);
    for (std::size_t i = 0; i < shadow::kMaxSamples; ++i) {
      const glm::dvec3& d = directions_ls[first + std::min(i, count - 1)];
      samples->x_ws[i] = static_cast<float>(d.x), samples->y_ws[i] = static_cast<float>(d.y);
      samples->z_ws[i] = static_cast<float>(d.z);
      points->normal_x_ws[i] = 0, points->normal_y_ws[i] = 0, points->normal_z_ws[i] = 1;
    }
    shade::find_irradiance_for(set)(bound, *samples, *points, nullptr, *irradiance);
    candela.insert(candela.end(), irradiance->r.begin(),
                   irradiance->r.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return candela;
}

// Fibonacci's lattice on the sphere.
std::vector<glm::dvec3> spread_directions(int count) {
  std::vector<glm::dvec3> directions;
  directions.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, ring = std::sqrt(1 - z * z);
    const double turn = 2 * std::numbers::pi * i * std::numbers::phi;
    directions.emplace_back(ring * std::cos(turn), ring * std::sin(turn), z);
  }
  return directions;
}

double flux_by_directions(const LightDistribution& lamp, int count) {
  double sum = 0;
  for (const glm::dvec3& direction : spread_directions(count)) sum += candela_toward(lamp, direction);
  return sum * 4 * std::numbers::pi / count;
}

}  // namespace laterna::reference
