// What soft and variance shadow maps are read from, on every instruction set, against plain loops in double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "reference/shapes.h"
#include "shadow/moment_map.h"
#include "shadow/nearest_pyramid.h"

namespace laterna::shadow {
namespace {

constexpr int kWidth = 150, kHeight = 90;

// Every texel has seen something else, or nothing.
std::shared_ptr<DepthMap> random_map(bool is_orthographic) {
  View view = reference::look({0, 0, 5}, {0, 0, 0}, 50, 1.5);
  if (is_orthographic) view.projection = Projection::orthographic(3, 2, 0.5, 30);
  auto map = std::make_shared<DepthMap>(raster::RasterView(view, kWidth, kHeight), false);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> metres(1, 18);
  for (int y = 0; y < map->tiles_y(); ++y) {
    for (int x = 0; x < map->tiles_x(); ++x) {
      for (int i = 0; i < raster::kTilePixels; ++i) {
        map->tile(x, y)[i] = random() % 8 == 0
                                 ? kNothingSeen
                                 : static_cast<float>(map->view().reversed_from_distance(metres(random)));
      }
    }
  }
  return map;
}

TEST(NearestPyramid, HoldsNoLessThanTheNearestAndNoMoreThanWhatLiesAbout) {
  const auto map = random_map(false);
  const NearestPyramid pyramid(*map, TaskPool(2));
  const auto nearest = [&](double x, double y, double reach) {
    float found = kNothingSeen;
    for (int j = std::max(0, static_cast<int>(std::floor(y - reach))); j < kHeight && j <= y + reach; ++j) {
      for (int i = std::max(0, static_cast<int>(std::floor(x - reach))); i < kWidth && i <= x + reach; ++i)
        found = std::max(found, map->reversed_depth(i, j));
    }
    return found;
  };
  EXPECT_GE(pyramid.nearest(), nearest(75, 45, 200));
  std::mt19937 random(8);
  std::uniform_real_distribution<float> x(0, kWidth), y(0, kHeight), reach(0, 12);
  int tight = 0;
  for (int k = 0; k < 2000; ++k) {
    const float at_x = x(random);
    const float at_y = y(random);
    const float about = reach(random);
    const float bound = pyramid.nearest_about(at_x, at_y, about);
    ASSERT_GE(bound, nearest(at_x, at_y, about));
    tight += bound < pyramid.nearest() ? 1 : 0;
  }
  EXPECT_GT(tight, 1000);
}

class MomentMapOnEverySet : public testing::TestWithParam<InstructionSet> {};

// Depths as the header defines them, in double.
double measured(const DepthMap& map, const DepthMeasure& measure, int x, int y) {
  const double q = map.reversed_depth(x, y);
  if (q == kNothingSeen) return 1;
  const raster::RasterView& view = map.view();
  double metres = view.is_orthographic ? measure.nearest - q : 1 / q;
  if (!view.is_orthographic) {
    const glm::dvec3 ray = view.direction_0 + view.direction_x * (x + 0.5 - view.origin_x) +
                           view.direction_y * (y + 0.5 - view.origin_y);
    metres = metres * (measure.is_radial ? std::sqrt(ray.x * ray.x + ray.y * ray.y + ray.z * ray.z) : 1.0) -
             measure.nearest;
  }
  return metres * measure.per_metre - 1;
}

TEST_P(MomentMapOnEverySet, MomentsAreWeightedMeansOfDepthAndOfItsExponentials) {
  for (const bool is_orthographic : {false, true}) {
    for (const ShadowDepth depth : {ShadowDepth::planar, ShadowDepth::radial}) {
      const std::vector maps = {random_map(is_orthographic)};
      const DepthMap& map = *maps[0];
      const TaskPool pool(2);
      const DepthMeasure measure = find_depth_measure(maps, depth, pool);
      EXPECT_EQ(measure.is_radial, depth == ShadowDepth::radial && !is_orthographic);
      for (const ShadowMoments kind : {ShadowMoments::variance, ShadowMoments::exponential}) {
        for (const float blur : {0.0F, 1.5F}) {
          const MomentMap moments(map, measure, kind, blur, GetParam(), pool);
          const std::size_t channels = kind == ShadowMoments::variance ? 2 : 4;
          const int reach = static_cast<int>(std::ceil(blur));
          for (const auto& [x, y] : {std::pair{0, 0}, {1, 40}, {77, 3}, {149, 89}, {63, 64}, {148, 44}}) {
            double sums[4] = {0, 0, 0, 0};
            double weights = 0;
            for (int dy = -reach; dy <= reach; ++dy) {
              for (int dx = -reach; dx <= reach; ++dx) {
                const double weight = (1 - std::abs(dx) / (blur + 1.0)) * (1 - std::abs(dy) / (blur + 1.0));
                const double d = measured(map, measure, std::clamp(x + dx, 0, kWidth - 1),
                                          std::clamp(y + dy, 0, kHeight - 1));
                ASSERT_GE(d, -1.0001);
                ASSERT_LE(d, 1.0001);
                const double positive = std::exp(kPositiveExponent * d);
                const double negative = -std::exp(-kNegativeExponent * d);
                const double values[4] = {kind == ShadowMoments::variance ? d : positive,
                                          kind == ShadowMoments::variance ? d * d : positive * positive,
                                          negative, negative * negative};
                for (int k = 0; k < 4; ++k) sums[k] += weight * values[k];
                weights += weight;
              }
            }
            for (std::size_t k = 0; k < channels; ++k) {
              const double expected = sums[k] / weights;
              const double got = moments.moments()[static_cast<std::size_t>(y * kWidth + x) * channels + k];
              // A unit in the last place of the depth is 40 to 80 of the exponential.
              ASSERT_NEAR(got, expected, 1e-4 * std::max(std::abs(expected), 0.01))
                  << x << ", " << y << " channel " << k;
            }
          }
        }
      }
    }
  }
}

TEST_P(MomentMapOnEverySet, CoarserLevelsAreMeansOfFour) {
  const std::vector maps = {random_map(false)};
  const TaskPool pool(2);
  const DepthMeasure measure = find_depth_measure(maps, ShadowDepth::planar, pool);
  const MomentMap moments(*maps[0], measure, ShadowMoments::variance, 0, GetParam(), pool);
  ASSERT_GE(moments.levels().size(), 4U);
  for (std::size_t level = 1; level < moments.levels().size(); ++level) {
    const MomentLevel& finer = moments.levels()[level - 1];
    const MomentLevel& coarser = moments.levels()[level];
    ASSERT_EQ(coarser.width, (finer.width + 1) / 2);
    ASSERT_EQ(coarser.height, (finer.height + 1) / 2);
    for (int y = 0; y < coarser.height; ++y) {
      for (int x = 0; x < coarser.width; ++x) {
        double sum = 0;
        for (int k = 0; k < 4; ++k) {
          const int i = std::min(2 * x + k % 2, finer.width - 1);
          const int j = std::min(2 * y + k / 2, finer.height - 1);
          sum += moments.moments()[2 * (finer.first + static_cast<std::size_t>(j * finer.width + i))] / 4;
        }
        ASSERT_NEAR(moments.moments()[2 * (coarser.first + static_cast<std::size_t>(y * coarser.width + x))],
                    sum, 1e-6);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllSets, MomentMapOnEverySet, testing::ValuesIn(supported_instruction_sets()),
                         [](const auto& set) { return std::string(name_of(set.param)); });

}  // namespace
}  // namespace laterna::shadow
