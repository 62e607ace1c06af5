// The split sum against the integral that it approximates.
#include "laterna/environment_accuracy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/elementary.h"
#include "base/sample_sequence.h"
#include "image/environment_map.h"
#include "image/luminance.h"
#include "shade/split_sum.h"

namespace laterna {
namespace {

constexpr int kViews = 48, kFields = 512, kSplitSumSamples = 4096;
constexpr std::array<double, 6> kRoughness = {0.25, 1.0 / 3, 0.5, 2.0 / 3, 5.0 / 6, 1};
constexpr std::array<double, 5> kCosines = {1, 0.8, 0.6, 0.4, 0.2};

double luminance_of(const glm::dvec3& c) {
  return static_cast<double>(
      image::luminance(static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)));
}

// Spread evenly over all directions.
glm::dvec3 direction_number(int i) {
  const double y = 1 - (2 * i + 1.0) / kViews, turn = 2 * kPi * i * 0.61803398874989485;
  const double across = std::sqrt(1 - y * y);
  return {across * cosine(turn), y, across * sine(turn)};
}

struct Axes {
  glm::dvec3 x, y, z;
};
Axes axes_about(const glm::dvec3& z) {
  const glm::dvec3 x =
      glm::normalize(glm::cross(std::abs(z.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), z));
  return {x, glm::cross(z, x), z};
}

// A direction with the luminance that comes from it, one for each of many small fields all around.
struct LightSample {
  glm::dvec3 direction;
  double luminance, solid_angle;
};
std::vector<LightSample> sample_all_around(const image::EnvironmentPicture& source) {
  std::vector<LightSample> samples;
  samples.reserve(std::size_t{kFields} * kFields);
  for (int y = 0; y < kFields; ++y) {
    for (int x = 0; x < kFields; ++x) {
      // Anywhere in its field: no two rows of fields are alike.
      const auto [u, v] = lattice_point({y * kFields + x, kFields * kFields});
      const double jitter = u * kFields - std::floor(u * kFields);
      const image::PanelPoint at{0, 2 * (x + v) / kFields - 1, 2 * (y + jitter) / kFields - 1};
      const glm::dvec3 direction = image::direction_from_panel(EnvironmentChart::octahedral, at);
      samples.push_back(
          {direction, luminance_of(source.look_up(direction)),
           image::panel_density(EnvironmentChart::octahedral, at) * 4 / (double{kFields} * kFields)});
    }
  }
  return samples;
}

// Luminance of a level's texel nearest to a direction, interpolated.
class MapReader {
 public:
  explicit MapReader(const image::OctahedralLevels& map) {
    for (std::size_t level = 0; level < map.levels.size(); ++level) {
      const int side = map.levels[level].side;
      std::vector<glm::vec3> texels;
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          const std::size_t at = map.index(level, x, y);
          texels.emplace_back(map.r[at], map.g[at], map.b[at]);
        }
      }
      levels_.emplace_back(EnvironmentChart::octahedral, side, side, texels);
    }
  }
  [[nodiscard]] double look_up(double roughness, const glm::dvec3& direction) const {
    const double level = roughness * static_cast<double>(levels_.size() - 1);
    const auto sharper = std::min(static_cast<std::size_t>(level), levels_.size() - 2);
    const double blend = level - static_cast<double>(sharper);
    return luminance_of(levels_[sharper].look_up(direction) * (1 - blend) +
                        levels_[sharper + 1].look_up(direction) * blend);
  }

 private:
  std::vector<image::EnvironmentPicture> levels_;
};

// Sums of squares, of errors and of what is true.
struct Squares {
  double error = 0, truth = 0;
  void add(double found, double true_value) {
    error += (found - true_value) * (found - true_value);
    truth += true_value * true_value;
  }
  [[nodiscard]] double relative() const { return truth > 0 ? std::sqrt(error / truth) : 0; }
};

// The prefiltered map against its own integral, at one direction.
void add_prefilter_error(const std::vector<LightSample>& lights, const MapReader& map, double roughness,
                         const glm::dvec3& reflected, Squares& squares) {
  const double a2 = roughness * roughness * roughness * roughness;
  double sum = 0, weight = 0;
  for (const LightSample& light : lights) {
    const double n_l = glm::dot(reflected, light.direction);
    if (n_l <= 0) continue;
    const double t = (1 + n_l) / 2 * (a2 - 1) + 1, share = n_l / (t * t) * light.solid_angle;
    sum += light.luminance * share;
    weight += share;
  }
  squares.add(map.look_up(roughness, reflected), sum / weight);
}

void add_split_sum_error(const std::vector<LightSample>& lights, const MapReader& map, double roughness,
                         double n_v, const shade::ScaleAndBias& entry, const glm::dvec3& normal,
                         Squares& squares) {
  const Axes axes = axes_about(normal);
  const double across = std::sqrt(std::max(0.0, 1 - n_v * n_v));
  const glm::dvec3 eye = axes.x * across + axes.z * n_v;
  const double alpha = std::max(roughness * roughness, 1e-3), a2 = alpha * alpha;
  const auto smith = [&](double c) { return c + std::sqrt(a2 + (1 - a2) * c * c); };
  double sum = 0;
  for (const LightSample& light : lights) {
    const double n_l = glm::dot(normal, light.direction);
    if (n_l <= 0) continue;
    // GGX, Smith's term over 4 n·l n·v, and n·l; a white metal's Fresnel term is 1.
    const glm::dvec3 half = light.direction + eye;
    const double n_h_squared = (n_l + n_v) * (n_l + n_v) / glm::dot(half, half);
    const double t = n_h_squared * (a2 - 1) + 1;
    sum += light.luminance * light.solid_angle * n_l / (t * t * smith(n_l));
  }
  sum *= a2 / (kPi * smith(n_v));
  squares.add(map.look_up(roughness, axes.z * n_v - axes.x * across) * (entry.scale + entry.bias), sum);
}

}  // namespace

Result<std::vector<SplitSumError>> measure_split_sum(const LayeredImage& environment, EnvironmentChart chart,
                                                     int threads) {
  // In the chart of the map itself, so that only filtering is measured.
  const Result<LayeredImage> octahedral =
      convert_environment(environment, {chart, EnvironmentChart::octahedral, 256, threads});
  if (!octahedral) return tl::unexpected(octahedral.error());
  std::vector<glm::vec3> texels;
  const auto plane = [&](std::size_t i) {
    return octahedral->channels[std::min(i, octahedral->channels.size() - 1)].values.data();
  };
  for (std::size_t i = 0; i < octahedral->channels[0].values.size(); ++i)
    texels.emplace_back(plane(0)[i], plane(1)[i], plane(2)[i]);
  const image::EnvironmentPicture source(EnvironmentChart::octahedral, octahedral->width, octahedral->height,
                                         texels);
  const TaskPool pool(threads);
  const MapReader map(image::make_environment_map(source, pool, best_instruction_set(), {}).mirrored);
  const std::vector<LightSample> lights = sample_all_around(source);
  std::vector<SplitSumError> errors(kRoughness.size() * kCosines.size());
  pool.for_each(errors.size(), [&](std::size_t i, int) {
    SplitSumError& error = errors[i];
    error.roughness = kRoughness[i / kCosines.size()];
    error.n_v = kCosines[i % kCosines.size()];
    const shade::ScaleAndBias entry =
        shade::integrate_reflectance(error.n_v, error.roughness, kSplitSumSamples);
    Squares split_sum, prefilter;
    for (int view = 0; view < kViews; ++view) {
      const glm::dvec3 direction = direction_number(view);
      add_split_sum_error(lights, map, error.roughness, error.n_v, entry, direction, split_sum);
      if (i % kCosines.size() == 0) add_prefilter_error(lights, map, error.roughness, direction, prefilter);
    }
    error.split_sum = split_sum.relative();
    error.prefilter = prefilter.relative();
  });
  for (std::size_t i = 0; i < errors.size(); ++i)
    errors[i].prefilter = errors[i / kCosines.size() * kCosines.size()].prefilter;
  return errors;
}

}  // namespace laterna
