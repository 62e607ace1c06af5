#include "image/environment_map.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "base/elementary.h"
#include "base/sample_sequence.h"

namespace laterna::image {
namespace {

// The smallest power of two that is not less.
int power_of_two(double least) {
  int side = 16;
  while (side < least && side < kLargestMirrorSide) side *= 2;
  return side;
}

// Rough lobes are wide: they take more samples and fewer texels. So many keep a sun that is 300 times as bright as the sky
// within 1 % (row 65).
int lobe_samples(int mirror_side, std::size_t level) {
  constexpr std::array<int, kMirrorLevels> kSamples = {1,    256,  1024, 2048, 4096, 4096, 4096,
                                                       4096, 4096, 4096, 4096, 4096, 4096};
  // Four to a texel of the source are all that there is to see.
  return std::min(kSamples[level], 4 * mirror_side * mirror_side);
}
int level_side(int mirror_side, std::size_t level) {
  const int smallest = std::min(mirror_side, level < 7 ? 64 : 32);
  return std::max(mirror_side >> std::min<std::size_t>(level, 8), smallest);
}

class RowProgress {
 public:
  RowProgress(std::size_t rows, const FractionDone& tell) : rows_(rows), tell_(tell) {}
  void add(double cost) {
    if (!tell_) return;
    const std::lock_guard lock(mutex_);
    done_ += cost;
    tell_(std::min(done_ / static_cast<double>(rows_), 1.0));
  }

 private:
  std::size_t rows_;
  const FractionDone& tell_;
  std::mutex mutex_;
  double done_ = 0;
};

}  // namespace

int mirror_side(double texels) { return power_of_two(std::sqrt(texels)); }

std::array<double, 9> spherical_harmonics(const glm::dvec3& n) {
  // Ramamoorthi & Hanrahan 2001, An efficient representation for irradiance environment maps, equation 3.
  return {0.282094791773878,
          0.488602511902920 * n.y,
          0.488602511902920 * n.z,
          0.488602511902920 * n.x,
          1.092548430592079 * n.x * n.y,
          1.092548430592079 * n.y * n.z,
          0.315391565252520 * (3 * n.z * n.z - 1),
          1.092548430592079 * n.x * n.z,
          0.546274215296040 * (n.x * n.x - n.y * n.y)};
}

HarmonicCoefficients find_irradiance(const OctahedralLevels& radiance) {
  // The finest level that is not finer than any harmonic can tell.
  constexpr int kFineEnough = 128;
  std::size_t level = 0;
  while (level + 1 < radiance.levels.size() && radiance.levels[level].side > kFineEnough) ++level;
  const int side = radiance.levels[level].side;
  HarmonicCoefficients sums{};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const glm::dvec2 low(2.0 * x / side - 1, 2.0 * y / side - 1), high = low + 2.0 / side;
      const PanelPoint middle{0, (low.x + high.x) / 2, (low.y + high.y) / 2};
      const std::size_t at = radiance.index(level, x, y);
      const glm::dvec3 flux = glm::dvec3(radiance.r[at], radiance.g[at], radiance.b[at]) *
                              rectangle_solid_angle(EnvironmentChart::octahedral, low, high);
      const std::array<double, 9> basis =
          spherical_harmonics(direction_from_panel(EnvironmentChart::octahedral, middle));
      for (std::size_t i = 0; i < 9; ++i) sums[i] += flux * basis[i];
    }
  }
  // Equation 8: a clamped cosine takes the orders down to π, 2π/3 and π/4.
  for (std::size_t i = 0; i < 9; ++i) sums[i] *= i == 0 ? kPi : (i < 4 ? 2 * kPi / 3 : kPi / 4);
  return sums;
}

std::vector<LobeSample> sample_lobe(double roughness, int count, int pyramid_side) {
  const double alpha_squared = roughness * roughness * roughness * roughness;
  const double texel = 4 * kPi / (static_cast<double>(pyramid_side) * pyramid_side);
  const double coarsest = std::max(0.0, logarithm2(pyramid_side) - 2);  // a side of 4
  std::vector<LobeSample> lobe;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const auto [u, v] = lattice_point({i, count});
    // The half vector by GGX's distribution of normals (Walter et al. 2007, equation 35), the light mirrored at it.
    const double cosine_squared = (1 - u) / (1 + (alpha_squared - 1) * u);
    const double n_h = std::sqrt(cosine_squared), across = std::sqrt(std::max(0.0, 1 - cosine_squared));
    const double n_l = 2 * cosine_squared - 1;
    if (n_l <= 0) continue;
    const double t = cosine_squared * (alpha_squared - 1) + 1;
    const double density =
        alpha_squared / (kPi * t * t) / 4;  // of light directions: D n·h / (4 v·h), v·h = n·h
    // Twice a sample's share: neighbouring footprints overlap.
    const double share = 1 / (count * density);
    const double level = std::clamp(0.5 * logarithm2(2 * share / texel), 0.0, coarsest);
    const double whole = std::floor(level);
    const double radius = 2 * n_h * across;
    lobe.push_back({static_cast<float>(radius * cosine(2 * kPi * v)),
                    static_cast<float>(radius * sine(2 * kPi * v)), static_cast<float>(n_l),
                    static_cast<float>(n_l), static_cast<std::uint32_t>(whole),
                    whole < coarsest ? static_cast<float>(level - whole) : 0.0F});
    sum += n_l;
  }
  for (LobeSample& sample : lobe) sample.weight = static_cast<float>(sample.weight / sum);
  return lobe;
}

EnvironmentMap make_environment_map(const EnvironmentPicture& picture, const TaskPool& pool,
                                    InstructionSet set, const FractionDone& progress) {
  const double texels = 4 * kPi / (picture.texel_side() * picture.texel_side());
  const int side = mirror_side(texels);
  const OctahedralLevels pyramid =
      make_octahedral_pyramid(side, resample(picture, EnvironmentChart::octahedral, side, pool));
  EnvironmentMap map;
  map.irradiance = find_irradiance(pyramid);
  for (std::size_t level = 0; level < kMirrorLevels; ++level) map.mirrored.add_level(level_side(side, level));
  std::size_t work = 0;
  for (std::size_t level = 1; level < kMirrorLevels; ++level) {
    work += static_cast<std::size_t>(map.mirrored.levels[level].side) *
            static_cast<std::size_t>(map.mirrored.levels[level].side * lobe_samples(side, level));
  }
  RowProgress done(work, progress);
  const PrefilterRow prefilter_row = prefilter_row_for(set);
  const OctahedralLevels::Level finest = pyramid.levels[0];
  for (AlignedVector<float> OctahedralLevels::*plane :
       {&OctahedralLevels::r, &OctahedralLevels::g, &OctahedralLevels::b}) {
    std::copy_n((pyramid.*plane).data(),
                static_cast<std::size_t>(finest.side + 2) * static_cast<std::size_t>(finest.side + 2),
                (map.mirrored.*plane).data());
  }
  for (std::size_t level = 1; level < kMirrorLevels; ++level) {
    const double roughness = static_cast<double>(level) / static_cast<double>(kMirrorLevels - 1);
    const int samples = lobe_samples(side, level);
    const std::vector<LobeSample> lobe = sample_lobe(roughness, samples, side);
    const int rows = map.mirrored.levels[level].side;
    pool.for_each(static_cast<std::size_t>(rows), [&](std::size_t row, int) {
      prefilter_row(pyramid, lobe, level, static_cast<int>(row), map.mirrored);
      done.add(static_cast<double>(rows) * samples);
    });
    map.mirrored.fill_border(level);
  }
  return map;
}

EnvironmentMap make_environment_map(const std::vector<EnvironmentPicture>& filtered, const TaskPool& pool) {
  EnvironmentMap map;
  for (const EnvironmentPicture& picture : filtered) {
    const int side = mirror_side(4 * kPi / (picture.texel_side() * picture.texel_side()));
    map.mirrored.set(map.mirrored.add_level(side),
                     resample(picture, EnvironmentChart::octahedral, side, pool));
  }
  const int side = map.mirrored.levels[0].side;
  std::vector<glm::vec3> texels;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const std::size_t at = map.mirrored.index(0, x, y);
      texels.emplace_back(map.mirrored.r[at], map.mirrored.g[at], map.mirrored.b[at]);
    }
  }
  map.irradiance = find_irradiance(make_octahedral_pyramid(side, texels));
  return map;
}

}  // namespace laterna::image
