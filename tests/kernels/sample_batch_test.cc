// Batches of samples, filled in from a tile and written back, against plain loops on every instruction set.
#include "shade/sample_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <random>

#include "shade/light_reach.h"
#include "shade/scatter.h"

namespace laterna::kernels {
namespace {

using shade::SurfaceGroups;
using shadow::kGroupSize;
using shadow::kMaxGroups;
using shadow::kMaxSamples;
using shadow::SurfaceSamples;

// Blocks of a tile, each once, with masks of all kinds: full, of one sample, of any.
std::vector<SurfaceGroups::Block> random_blocks(std::size_t count, std::mt19937& random) {
  std::vector<SurfaceGroups::Block> blocks;
  for (std::uint16_t block = 0; block < raster::kTilePixels / kGroupSize; ++block) {
    const auto any = static_cast<std::uint16_t>(std::max<std::uint32_t>(random() & 0xFFFFU, 1));
    const auto one = static_cast<std::uint16_t>(1U << random() % kGroupSize);
    const std::uint16_t masks[] = {0xFFFF, one, any};
    blocks.push_back({block, masks[random() % 3]});
  }
  std::shuffle(blocks.begin(), blocks.end(), random);
  blocks.resize(count);
  return blocks;
}

class SampleBatch : public testing::TestWithParam<InstructionSet> {
 protected:
  SampleBatch() {
    std::uniform_real_distribution<float> q(0.01F, 3);
    for (float& depth : depth_) depth = q(random_);
    for (TriangleId& id : ids_) id = static_cast<TriangleId>(random_());
    frame_.bounds = {glm::vec3(-3, 0, 1), glm::vec3(2, 7, 4), false};
  }

  std::mt19937 random_{5};
  alignas(64) std::array<float, raster::kTilePixels> depth_{};
  std::array<TriangleId, raster::kTilePixels> ids_{};
  frame::Frame frame_;
  raster::RasterView view_{View(), 640, 480};
  std::unique_ptr<SurfaceSamples> samples_ = std::make_unique<SurfaceSamples>();
};

TEST_P(SampleBatch, HoldsTheBlocksSamplesAndCopiesForTheRest) {
  const shade::TileOrigin origin(frame_, view_, 3, 2, 37, -90);
  for (std::size_t count = 1; count <= kMaxGroups; ++count) {
    const std::vector<SurfaceGroups::Block> blocks = random_blocks(count, random_);
    shade::fill_from_blocks_for(GetParam())(origin, blocks, depth_.data(), ids_.data(), *samples_);
    ASSERT_EQ(samples_->group_count, count);
    float least_q = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < count * kGroupSize; ++i) {
      const auto [block, mask] = blocks[i / kGroupSize];
      ASSERT_EQ(samples_->active[i / kGroupSize], mask);
      const std::size_t lane = i % kGroupSize;
      const std::size_t shown =
          (mask >> lane & 1U) != 0 ? lane : static_cast<std::size_t>(std::countr_zero(mask));
      const std::size_t pixel = block * kGroupSize + shown;
      const int x = block % 16 * 4 + static_cast<int>(shown % 4),
                y = block / 16 * 4 + static_cast<int>(shown / 4);
      ASSERT_EQ(samples_->x[i], origin.x + static_cast<float>(x)) << i;
      ASSERT_EQ(samples_->y[i], origin.y + static_cast<float>(y)) << i;
      ASSERT_EQ(samples_->q[i], depth_[pixel]) << i;
      ASSERT_EQ(samples_->id[i], ids_[pixel]) << i;
      ASSERT_EQ(samples_->pixel[i], block * kGroupSize + lane) << i;
      least_q = std::min(least_q, depth_[pixel]);
    }
    EXPECT_EQ(samples_->position_error, shade::position_error(origin, least_q));
  }
}

TEST_P(SampleBatch, IsBounded) {
  std::uniform_real_distribution<float> place(-50, 50);
  for (std::size_t count = 1; count <= kMaxGroups; ++count) {
    samples_->group_count = count;
    glm::vec3 low(1e30F), high(-1e30F);
    for (std::size_t i = 0; i < kMaxSamples; ++i) {
      const glm::vec3 p(place(random_), place(random_), place(random_));
      samples_->x_ws[i] = p.x;
      samples_->y_ws[i] = p.y;
      samples_->z_ws[i] = p.z;
      if (i < count * kGroupSize) {
        low = glm::min(low, p);
        high = glm::max(high, p);
      }
    }
    const frame::Bounds bounds = shade::find_bounds_for(GetParam())(*samples_);
    EXPECT_FALSE(bounds.is_empty);
    EXPECT_EQ(bounds.low, low);
    EXPECT_EQ(bounds.high, high);
  }
}

// Blocks lie in a row in their target, fragments where they like.
TEST_P(SampleBatch, IsWrittenWhereItBelongsAndNowhereElse) {
  const auto radiance = std::make_unique<shade::Radiance>();
  for (std::size_t i = 0; i < kMaxSamples; ++i) {
    radiance->r[i] = static_cast<float>(i);
    radiance->g[i] = static_cast<float>(i) + 1000;
    radiance->b[i] = static_cast<float>(i) + 2000;
  }
  for (const bool in_rows : {true, false}) {
    const std::vector<SurfaceGroups::Block> blocks = random_blocks(kMaxGroups, random_);
    shade::fill_from_blocks_for(GetParam())({frame_, view_, 0, 0, 0, 0}, blocks, depth_.data(), ids_.data(),
                                            *samples_);
    if (!in_rows) std::shuffle(samples_->pixel.begin(), samples_->pixel.end(), random_);
    std::vector<float> got(3 * raster::kTilePixels, -1), expected(got);
    for (std::size_t i = 0; i < kMaxSamples; ++i) {
      if ((samples_->active[i / kGroupSize] >> i % kGroupSize & 1U) == 0) continue;
      for (std::size_t channel = 0; channel < 3; ++channel)
        expected[channel * raster::kTilePixels + samples_->pixel[i]] =
            static_cast<float>(i) + 1000 * static_cast<float>(channel);
    }
    got.resize(got.size() + kGroupSize, -1);
    float* r = got.data();
    shade::scatter_radiance_for(GetParam())(
        *samples_, *radiance, {r, r + raster::kTilePixels, r + 2 * std::size_t{raster::kTilePixels}});
    got.resize(expected.size());
    EXPECT_EQ(got, expected) << in_rows;
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, SampleBatch, testing::ValuesIn(supported_instruction_sets()),
                         [](const auto& set) { return std::string(name_of(set.param)); });

}  // namespace
}  // namespace laterna::kernels
