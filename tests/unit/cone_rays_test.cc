#include "shade/cone_rays.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace laterna::shade {
namespace {

// Of n pictures each of 48 fields of the same size, 4 rings of 12, has n rays, give or take what a lattice leaves.
TEST(ConeRays, FillTheDiscEvenlyTogether) {
  for (const int pictures : {16, 64, 256}) {
    std::array<int, 48> fields = {};
    for (int index = 0; index < pictures; ++index) {
      for (const glm::vec2& ray : cone_rays({index, pictures})) {
        ASSERT_LT(glm::length(ray), 1);
        const int ring = static_cast<int>(4 * glm::dot(ray, ray));
        const int sector =
            static_cast<int>(12 * (std::atan2(ray.y, ray.x) / (2 * 3.14159265358979) + 0.5)) % 12;
        ++fields[static_cast<std::size_t>(12 * ring + sector)];
      }
    }
    for (const int rays : fields) EXPECT_NEAR(rays, pictures, 0.25 * pictures) << pictures;
  }
}

TEST(ConeRays, OfOnePictureAreAlwaysTheSame) {
  const ConeRays rays = cone_rays({});
  EXPECT_NEAR(rays[0].x, std::sqrt(0.5 / 48), 1e-6);
  EXPECT_NEAR(rays[0].y, 0, 1e-6);
  EXPECT_EQ(rays, cone_rays({0, 1}));
}

}  // namespace
}  // namespace laterna::shade
