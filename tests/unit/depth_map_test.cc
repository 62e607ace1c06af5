// Depth maps whose tiles are drawn when they are first asked for.
#include "shadow/depth_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <new>
#include <thread>
#include <vector>

namespace laterna::shadow {
namespace {

raster::RasterView view_of(int side) {
  View view;
  view.projection = Projection::perspective(Angle::radians(1), 1, 0.1, 10);
  return {view, side, side};
}

// Writes a tile's number into all of its texels.
class NumberPainter final : public TilePainter {
 public:
  explicit NumberPainter(std::atomic<int>& calls, int failures = 0) : calls_(calls), failures_(failures) {}
  void paint(const raster::RasterView&, int tile_x, int tile_y, float* depth, TriangleId* ids) override {
    ++calls_;
    if (failures_-- > 0) throw std::bad_alloc();
    std::fill_n(depth, raster::kTilePixels, static_cast<float>(10 * tile_y + tile_x));
    if (ids != nullptr) std::fill_n(ids, raster::kTilePixels, static_cast<TriangleId>(tile_x));
  }
  void rest() override {}
  [[nodiscard]] std::size_t working_bytes() const override { return 0; }

 private:
  std::atomic<int>& calls_;
  std::atomic<int> failures_;
};

TEST(DepthMap, IsCompleteWithoutAPainter) {
  const DepthMap map(view_of(130), false);
  EXPECT_TRUE(map.is_complete());
  EXPECT_TRUE(map.is_drawn(2, 2));
}

TEST(DepthMap, DrawsATileOnceWhenItIsAskedFor) {
  std::atomic<int> calls = 0;
  DepthMap map(view_of(130), true);
  map.set_painter(std::make_unique<NumberPainter>(calls));
  EXPECT_FALSE(map.is_complete());
  EXPECT_FALSE(map.is_drawn(1, 2));
  map.require(1, 2);
  map.require(1, 2);
  EXPECT_EQ(calls, 1);
  EXPECT_TRUE(map.is_drawn(1, 2));
  EXPECT_FALSE(map.is_drawn(2, 1));
  EXPECT_EQ(map.reversed_depth(64, 128), 21);
  EXPECT_EQ(map.triangle_tile(1, 2)[0], 1U);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 3; ++x) map.require(x, y);
  }
  EXPECT_EQ(calls, 9);
  EXPECT_TRUE(map.is_complete());
}

TEST(DepthMap, ManyThreadsGetEachTileDrawnOnce) {
  std::atomic<int> calls = 0;
  DepthMap map(view_of(512), false);
  map.set_painter(std::make_unique<NumberPainter>(calls));
  std::vector<std::thread> threads;
  threads.reserve(8);
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&map] {
      for (int i = 0; i < 64; ++i) {
        const int x = i % 8, y = i / 8;
        map.require(x, y);
        EXPECT_EQ(map.reversed_depth(64 * x, 64 * y), static_cast<float>(10 * y + x));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(calls, 64);
  EXPECT_TRUE(map.is_complete());
}

TEST(DepthMap, ATileThatFailedIsTriedAgain) {
  std::atomic<int> calls = 0;
  DepthMap map(view_of(64), false);
  map.set_painter(std::make_unique<NumberPainter>(calls, 1));
  EXPECT_THROW(map.require(0, 0), std::bad_alloc);
  EXPECT_FALSE(map.is_drawn(0, 0));
  map.require(0, 0);
  EXPECT_EQ(calls, 2);
  EXPECT_TRUE(map.is_complete());
}

TEST(DepthMap, TakesOverTheMemoryOfAnOutwornOne) {
  std::atomic<int> calls = 0;
  DepthMap first(view_of(256), true);
  first.set_painter(std::make_unique<NumberPainter>(calls));
  first.require(0, 0);
  const float* texels = first.texels();
  const DepthMap second(view_of(256), true, std::move(first));
  EXPECT_EQ(second.texels(), texels);
  EXPECT_TRUE(second.is_complete());
  const DepthMap larger(view_of(512), false);
  EXPECT_EQ(larger.memory_bytes(), std::size_t{512} * 512 * sizeof(float));
}

}  // namespace
}  // namespace laterna::shadow
