// Which luxels share their light.
#include "bake/light_sharing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "reference/luxel_rooms.h"

namespace laterna {
namespace {

using bake::LightSharing;
using bake::LuxelTree;
using reference::LitRoom;
using reference::LuxelRoom;

// By place.
std::map<std::uint32_t, float> others_of(const LightSharing& sharing, std::uint32_t place) {
  std::map<std::uint32_t, float> others;
  sharing.for_others(place, [&](std::uint32_t other, float weight) {
    EXPECT_TRUE(others.emplace(other, weight).second) << other;
  });
  return others;
}

// A floor of 1 m × 1 m with 40 × 40 luxels.
LuxelRoom floor_of_luxels() {
  LuxelRoom room;
  room.add({{0, 0, 1}, {1, 0, 0}, {0, 0, -1}, 40, 40});
  return room;
}

std::uint32_t place_near(const LuxelTree& tree, const glm::vec3& point) {
  std::uint32_t nearest = 0;
  for (std::uint32_t place = 0; place < tree.luxels().size(); ++place) {
    if (glm::distance(tree.luxels()[place].position_ws, point) <
        glm::distance(tree.luxels()[nearest].position_ws, point))
      nearest = place;
  }
  return nearest;
}

TEST(LightSharing, ReachesFiveLuxelsInTheOpen) {
  const LitRoom lit(floor_of_luxels());
  const LuxelTree tree(lit.owned.frame, lit.room.luxels);
  const std::vector<float> nothing_near(tree.luxels().size(), 0);
  const LightSharing sharing(tree, nothing_near);
  const std::uint32_t middle = place_near(tree, {0.5F, 0, 0.5F});
  const std::map<std::uint32_t, float> others = others_of(sharing, middle);
  EXPECT_NEAR(static_cast<double>(others.size() + 1), 25 * std::numbers::pi, 8);  // a disc, in whole luxels
  for (const auto& [other, weight] : others) {
    const float widths =
        40 * glm::distance(tree.luxels()[other].position_ws, tree.luxels()[middle].position_ws);
    EXPECT_NEAR(weight, 1 - widths * widths / 25, 1e-4F);
  }
}

// What is near is of no use far away, and both must think so.
TEST(LightSharing, EndsWhereSomethingIsNearToEither) {
  const LitRoom lit(floor_of_luxels());
  const LuxelTree tree(lit.owned.frame, lit.room.luxels);
  std::vector<float> nearness(tree.luxels().size());
  for (std::size_t place = 0; place < nearness.size(); ++place)
    nearness[place] = tree.luxels()[place].position_ws.x < 0.5F ? 1 / 0.4F : 0;
  const LightSharing sharing(tree, nearness);
  const std::uint32_t beside = place_near(tree, {0.51F, 0, 0.5F});
  float left = 0, right = 0;
  for (const auto& [other, weight] : others_of(sharing, beside)) {
    const float x = tree.luxels()[other].position_ws.x;
    (x < 0.5F ? left : right) = std::max(x < 0.5F ? left : right, std::abs(x - 0.5125F));
    EXPECT_EQ(others_of(sharing, other).at(beside), weight);
  }
  EXPECT_NEAR(left, 0.05F, 0.001F);  // within 0.15 · 0.4 m
  EXPECT_NEAR(right, 0.1F, 0.001F);  // within five luxels
}

TEST(LightSharing, NothingIsSharedRoundCorners) {
  LuxelRoom room = floor_of_luxels();
  room.add({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 40, 40});        // a wall
  room.add({{0, -0.001F, 0}, {1, 0, 0}, {0, 0, 1}, 40, 40});  // the floor's underside
  room.add({{0, 0, 1},
            {1, 0, 0},
            {0, -0.1F, std::sqrt(0.99F)},
            40,
            40});  // a ramp, 6° off, that goes on with it upside down
  const LitRoom lit(room);
  const LuxelTree tree(lit.owned.frame, lit.room.luxels);
  const LightSharing sharing(tree, std::vector<float>(tree.luxels().size(), 0));
  for (std::uint32_t place = 0; place < tree.luxels().size(); place += 7) {
    for (const auto& [other, weight] : others_of(sharing, place))
      EXPECT_GT(glm::dot(tree.luxels()[place].normal_ws, tree.luxels()[other].normal_ws), 0.93F);
  }
}

}  // namespace
}  // namespace laterna
