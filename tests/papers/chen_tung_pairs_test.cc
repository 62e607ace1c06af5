// Chen and Tung, Real-time shadow rendering using projective texture: which objects can shade which.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "light/shadow_pairs.h"

namespace laterna::light {
namespace {

constexpr glm::dvec4 kAtOrigin(0, 0, 0, 1);

using Pairs = std::vector<ShadowPair>;

// Row 38: φ against θ1 + θ2, with θ = asin(r/d).
TEST(ShadowPairs, ConesThatOverlapMakeAPair) {
  const BoundingSphere near = {{0, 0, -4}, 1};
  // 14.04° < 14.48° + 6.97°
  EXPECT_EQ(find_shadow_pairs(std::vector<BoundingSphere>{near, {{2, 0, -8}, 1}}, kAtOrigin),
            (Pairs{{0, 1, true}}));
  // 26.57° > 14.48° + 6.42°
  EXPECT_EQ(find_shadow_pairs(std::vector<BoundingSphere>{near, {{4, 0, -8}, 1}}, kAtOrigin), Pairs{});
  // The light inside a sphere.
  EXPECT_EQ(find_shadow_pairs(std::vector<BoundingSphere>{near, {{4, 0, -8}, 9}}, kAtOrigin).size(), 2U);
  EXPECT_EQ(find_shadow_pairs(std::vector<BoundingSphere>{{{0, 0, 0}, 1}, {{5, 0, 0}, 1}}, kAtOrigin),
            (Pairs{{0, 1, true}}));
  // Behind the light there is another direction.
  EXPECT_EQ(find_shadow_pairs(std::vector<BoundingSphere>{near, {{0, 0, 8}, 1}}, kAtOrigin), Pairs{});
}

// Row 38, the case in the middle: cones that touch make no pair.
TEST(ShadowPairs, ConesThatTouchMakeNone) {
  for (const double theta : {0.5, 0.05, 1e-4}) {
    const double other = 0.3 * theta;
    const auto at = [](double angle, double distance, double half_angle) {
      return BoundingSphere{{distance * std::sin(angle), 0, -distance * std::cos(angle)},
                            distance * std::sin(half_angle)};
    };
    const auto pairs = [&](double phi) {
      return find_shadow_pairs(std::vector<BoundingSphere>{at(0, 3, theta), at(phi, 50, other)}, kAtOrigin);
    };
    EXPECT_EQ(pairs(theta + other).size(), 0U) << theta;
    EXPECT_EQ(pairs((theta + other) * (1 + 1e-6)).size(), 0U) << theta;
    EXPECT_EQ(pairs((theta + other) * (1 - 1e-6)).size(), 1U) << theta;
  }
}

// Row 39.
TEST(ShadowPairs, TheNearerIsTheOccluderAndWhereRangesOverlapBothAre) {
  const BoundingSphere a = {{0, 0, -4}, 1}, b = {{0.5, 0, -8}, 1}, c = {{0.2, 0, -5.5}, 1};
  EXPECT_EQ(find_shadow_pairs(std::vector<BoundingSphere>{a, b}, kAtOrigin), (Pairs{{0, 1, true}}));
  EXPECT_EQ(find_shadow_pairs(std::vector<BoundingSphere>{b, a}, kAtOrigin), (Pairs{{1, 0, true}}));
  EXPECT_EQ(find_shadow_pairs(std::vector<BoundingSphere>{a, c}, kAtOrigin),
            (Pairs{{0, 1, false}, {1, 0, false}}));
}

// Row 40: circles on a plane, ordered by p·n.
TEST(ShadowPairs, CirclesThatOverlapMakeAPairInDirectionalLight) {
  const glm::dvec4 from_x(1, 0, 0, 0);  // figure 18: the light shines along −x
  const auto pairs = [&](double y, double z, double radius) {
    return find_shadow_pairs(std::vector<BoundingSphere>{{{5, 0, 0}, 1}, {{-3, y, z}, radius}}, from_x);
  };
  EXPECT_EQ(pairs(2, 1, 1), Pairs{}) << "apart";
  EXPECT_EQ(pairs(2, 0, 1), Pairs{}) << "touching";
  EXPECT_EQ(pairs(1.2, 1.6, 1), Pairs{}) << "touching";
  EXPECT_EQ(pairs(1.2, 1.5, 1), (Pairs{{0, 1, true}})) << "overlapping";
  EXPECT_EQ(pairs(0, 0, 0.2), (Pairs{{0, 1, true}})) << "one inside the other";
  const glm::dvec4 from_behind(-1, 0, 0, 0);
  EXPECT_EQ(find_shadow_pairs(std::vector<BoundingSphere>{{{5, 0, 0}, 1}, {{-3, 0, 0}, 1}}, from_behind),
            (Pairs{{1, 0, true}}));
  EXPECT_EQ(
      find_shadow_pairs(std::vector<BoundingSphere>{{{1, 0, 0}, 1}, {{-0.5, 0.1, 0}, 1}}, from_x).size(), 2U)
      << "ranges overlap: both directions";
}

std::vector<BoundingSphere> random_spheres(std::size_t count, double most_radius, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-100, 100), radius(0, most_radius);
  std::vector<BoundingSphere> spheres(count);
  for (BoundingSphere& s : spheres) s = {{place(random), place(random), place(random)}, radius(random)};
  return spheres;
}

// Row 48: sorted once and swept, the same pairs as of comparing each with each.
TEST(ShadowPairs, SweepAndPruneFindsTheSamePairs) {
  for (const std::size_t count : {0U, 1U, 2U, 50U, 700U}) {
    for (const double radius : {0.0, 0.5, 8.0, 70.0}) {
      const std::vector<BoundingSphere> spheres = random_spheres(count, radius, 48);
      for (const glm::dvec4& light : {kAtOrigin, glm::dvec4(90, 250, 30, 1), glm::dvec4(0.3, 1, -0.2, 0),
                                      glm::dvec4(0, 1, 0, 0), glm::dvec4(0, 0, 5, 0)}) {
        const Pairs expected = find_shadow_pairs(spheres, light);
        EXPECT_EQ(sweep_shadow_pairs(spheres, light), expected) << count << ", " << radius;
        if (count == 700 && radius == 8) {
          EXPECT_GT(expected.size(), 500U);
        }
      }
    }
  }
}

TEST(ShadowPairs, SweepAndPruneFindsTheSamePairsOfTenThousandSpheres) {
  const std::vector<BoundingSphere> spheres = random_spheres(10000, 1, 10000);
  for (const glm::dvec4& light : {glm::dvec4(20, 300, 10, 1), glm::dvec4(0.3, 1, -0.2, 0)}) {
    const Pairs expected = find_shadow_pairs(spheres, light);
    EXPECT_GT(expected.size(), 1000U);
    EXPECT_EQ(sweep_shadow_pairs(spheres, light), expected);
  }
}

// Caps about the poles of the axis that is swept along, and lights at centres.
TEST(ShadowPairs, SweepAndPruneAtTheEndsOfItsAxis) {
  std::vector<BoundingSphere> spheres;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      for (const double distance : {3.0, 7.0, 20.0}) {
        glm::dvec3 centre(0.1, -0.2, 0.05);
        centre[axis] += sign * distance;
        spheres.push_back({centre, 1});
      }
    }
  }
  spheres.push_back({{0, 0, 0}, 2});
  spheres.push_back({{0, 0, 0}, 0});
  const Pairs expected = find_shadow_pairs(spheres, kAtOrigin);
  EXPECT_GT(expected.size(), 18U);
  EXPECT_EQ(sweep_shadow_pairs(spheres, kAtOrigin), expected);
}

}  // namespace
}  // namespace laterna::light
