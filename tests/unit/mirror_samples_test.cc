// Which samples of a mirrored picture are kept.
#include "shade/mirror_samples.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <utility>

namespace laterna::shade {
namespace {

constexpr int kSamples = 4;

// Of one colour, all samples alike.
std::unique_ptr<TileResult> plain_tile(const glm::vec3& color) {
  auto tile = std::make_unique<TileResult>();
  fill(tile->beauty, color.r, color.g, color.b);
  tile->samples.resize(kSamples);
  for (TileColor& sample : tile->samples) fill(sample, color.r, color.g, color.b);
  return tile;
}

// Sample s of a pixel has as much green as `greens` says.
void set_green(TileResult& tile, int x, int y, const float (&greens)[kSamples]) {
  const auto pixel = static_cast<std::size_t>(raster::index_in_tile(x, y));
  float sum = 0;
  for (int s = 0; s < kSamples; ++s) {
    tile.samples[static_cast<std::size_t>(s)].g[pixel] = greens[s];
    sum += greens[s];
  }
  tile.beauty.g[pixel] = sum / kSamples;
}

// The second tile of the second row, of which a few pixels at the corner are beyond the box.
TEST(MirrorSamples, AreKeptWhereTheyDiffer) {
  const light::PixelBox box = {70, 66, 190, 200};
  MirrorSamples kept(box, kSamples);
  const auto tile = plain_tile({1, 0.25F, 0});
  set_green(*tile, 9, 5, {0, 0, 1, 1});
  set_green(*tile, 63, 63, {0.25F, 0.25F, 0.25F, 0.3F});   // farther than 1/64 of the red
  set_green(*tile, 20, 30, {0.25F, 0.25F, 0.25F, 0.26F});  // nearer
  set_green(*tile, 40, 41, {0, 0, 0, std::numeric_limits<float>::infinity()});
  set_green(*tile, 5, 5, {0, 0, 1, 1});  // left of the box
  kept.write(1, 1, *tile);
  int pixels = 0;
  for (int y = box.y_begin; y < box.y_end; ++y) {
    for (int x = box.x_begin; x < box.x_end; ++x) pixels += kept.at(x, y) != nullptr ? 1 : 0;
  }
  EXPECT_EQ(pixels, 3);
  const float greens[] = {0, 0, 1, 1};
  for (int s = 0; s < kSamples; ++s) {
    ASSERT_NE(kept.at(64 + 9, 64 + 5), nullptr);
    EXPECT_EQ(kept.at(64 + 9, 64 + 5)[s], glm::vec3(1, greens[s], 0)) << s;
    ASSERT_NE(kept.at(127, 127), nullptr);
    EXPECT_EQ(kept.at(127, 127)[s], glm::vec3(1, s < 3 ? 0.25F : 0.3F, 0)) << s;
  }
  EXPECT_NE(kept.at(64 + 40, 64 + 41), nullptr);
}

// Black is like black alone, however dark the rest.
TEST(MirrorSamples, AreKeptInTheDarkToo) {
  MirrorSamples kept({0, 0, 64, 64}, kSamples);
  const auto tile = plain_tile(glm::vec3(0));
  set_green(*tile, 3, 3, {0, 0, 0, 1e-6F});
  kept.write(0, 0, *tile);
  EXPECT_NE(kept.at(3, 3), nullptr);
  EXPECT_EQ(kept.at(4, 3), nullptr);
}

// A picture of 1024 × 1024 with an edge through it, whose samples would take 50 MB in all.
TEST(MirrorSamples, TakeMemoryForEdgesAlone) {
  constexpr int kTiles = 16;
  MirrorSamples kept({0, 0, kTiles * raster::kTileSide, kTiles * raster::kTileSide}, kSamples);
  const auto plain = plain_tile(glm::vec3(0.5F)), edge = plain_tile(glm::vec3(0.5F));
  for (int y = 0; y < raster::kTileSide; ++y) set_green(*edge, 7, y, {0, 1, 0, 1});
  for (int y = 0; y < kTiles; ++y) {
    for (int x = 0; x < kTiles; ++x) kept.write(x, y, x == 5 ? *edge : *plain);
  }
  const std::size_t edge_bytes = kTiles * (64 * kSamples * sizeof(glm::vec3) + 2 * raster::kTilePixels);
  EXPECT_GE(kept.memory_bytes(), edge_bytes);
  EXPECT_LE(kept.memory_bytes(), edge_bytes + kTiles * kTiles * 64);
}

}  // namespace
}  // namespace laterna::shade
