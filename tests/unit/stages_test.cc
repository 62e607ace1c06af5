// What a picture says of its stages. Times differ from run to run: held are sums, and which stages have any.
#include "laterna/stages.h"

#include <gtest/gtest.h>

#include <set>

#include "reference/shapes.h"

namespace laterna {
namespace {

TEST(Stages, SharesAddUpToTheWholeInTheSamplesProportions) {
  StageTimes sample;
  sample[Stage::surface] = 1;
  sample[Stage::light] = 3;
  const StageTimes shares = sample.share_out(20);
  EXPECT_EQ(shares[Stage::surface], 5);
  EXPECT_EQ(shares[Stage::light], 15);
  EXPECT_EQ(shares.total(), 20);
  EXPECT_EQ(StageTimes().share_out(20).total(), 0) << "nothing is known of how to share";
}

TEST(Stages, TimesAreAddedStageByStage) {
  StageTimes sum;
  sum[Stage::cull] = 1;
  StageTimes more;
  more[Stage::cull] = 2;
  more[Stage::encode] = 4;
  sum += more;
  EXPECT_EQ(sum[Stage::cull], 3);
  EXPECT_EQ(sum[Stage::encode], 4);
}

TEST(Stages, NamesDiffer) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < kStageCount; ++i) names.insert(name_of(static_cast<Stage>(i)));
  EXPECT_EQ(names.size(), kStageCount);
}

// A ball over a floor that runs past the viewer, so that some of it is clipped.
Scene ball_over_floor() {
  Scene scene;
  reference::add_object(scene, "floor", reference::floor(20));
  reference::add_object(scene, "ball", reference::sphere({0, 1, 0}, 0.5F, 24));
  Light lamp;
  lamp.name = "lamp";
  lamp.type = LightType::spot;
  lamp.intensity = 50;
  lamp.shadow.resolution = 256;
  reference::add_light(scene, lamp, {1, 5, 1}, {0, 0, 0});
  return scene;
}

RenderStatistics statistics_of(const Renderer& renderer) {
  std::vector<std::uint8_t> pixels(std::size_t{3} * 160 * 120);
  RenderTarget target;
  target.color8 = ColorTarget8{pixels.data(), 3, 3 * 160, 1};
  return renderer
      .render_into(reference::look({0, 1.5, 4}, {0, 0.5, 0}, 60, 4.0 / 3), reference::test_settings(160, 120),
                   target)
      .value();
}

TEST(Stages, APictureAndItsMapsTellOfEveryStageTheyGoThrough) {
  const Renderer renderer = reference::make_renderer(ball_over_floor(), 2);
  const RenderStatistics first = statistics_of(renderer);
  for (std::size_t i = 0; i < kStageCount; ++i) {
    const auto stage = static_cast<Stage>(i);
    EXPECT_GT(first.picture_stages[stage], 0) << name_of(stage);
    if (stage > Stage::raster) {
      EXPECT_EQ(first.map_stages[stage], 0) << name_of(stage);
    }
  }
  EXPECT_GT(first.map_stages[Stage::raster], 0);
  const RenderStatistics second = statistics_of(renderer);
  EXPECT_EQ(second.maps_kept, 1);
  EXPECT_EQ(second.map_stages.total(), 0) << "nothing was drawn";
}

TEST(Stages, ADepthMapAskedForByItselfTellsOfItsOwn) {
  const Renderer renderer = reference::make_renderer(ball_over_floor(), 1);
  RenderStatistics statistics;
  const Result<LayeredImage> map = renderer.depth_map("lamp", 0, &statistics);
  ASSERT_TRUE(map);
  EXPECT_EQ(statistics.maps_drawn, 1);
  EXPECT_GT(statistics.map_stages[Stage::raster], 0);
  EXPECT_EQ(statistics.picture_stages.total(), 0);
  // The second is drawn into the first one's memory.
  const Result<LayeredImage> again = renderer.depth_map("lamp");
  ASSERT_TRUE(again);
  EXPECT_EQ(again->channels[0].values, map->channels[0].values);
}

}  // namespace
}  // namespace laterna
