// What light passes and what it does not, sameness, and what is refused.
#include "bake/radiosity.h"

#include <gtest/gtest.h>

#include <limits>

#include "reference/luxel_rooms.h"

namespace laterna {
namespace {

using bake::Interreflection;
using reference::LitRoom;
using reference::LuxelRoom;

// Two plates 0.2 m apart, the upper one shining.
LuxelRoom plates() {
  LuxelRoom room;
  room.add({{0, 0, 1}, {1, 0, 0}, {0, 0, -1}, 4, 4, glm::vec3(0.5F)});
  room.add({{0, 0.2F, 0}, {1, 0, 0}, {0, 0, 1}, 4, 4, glm::vec3(0), glm::vec3(1, 2, 4)});
  return room;
}

TEST(Interreflection, panes_tint_what_comes_through) {
  const std::vector<glm::vec3> open = LitRoom(plates()).solve({64, 1, 0}).value().irradiance;
  LuxelRoom room = plates();
  room.add({{-9, 0.1F, 10}, {19, 0, 0}, {0, 0, -20}, 0, 0}, 0.5F, {1, 0.5F, 0});
  const std::vector<glm::vec3> behind = LitRoom(room).solve({64, 1, 0}).value().irradiance;
  for (std::size_t i = 0; i < 16; ++i) {
    ASSERT_GT(open[i].x, 0.1F);
    EXPECT_NEAR(behind[i].x, open[i].x, 1e-5F);
    EXPECT_NEAR(behind[i].y, 0.75F * open[i].y, 1e-5F);
    EXPECT_NEAR(behind[i].z, 0.5F * open[i].z, 1e-5F);
  }
}

// A sheet without thickness has luxels on both sides; light of one is not seen from the other.
TEST(Interreflection, sheets_do_not_leak) {
  LuxelRoom room;
  room.add_box({0, 0, 0}, {1, 1, 1}, 4, true, glm::vec3(0.5F));
  const std::size_t lit =
      room.add({{0, 0.5F, 1}, {1, 0, 0}, {0, 0, -1}, 4, 4, glm::vec3(0.5F), glm::vec3(7)});
  const std::size_t dark = room.luxels.size();
  for (std::size_t i = lit; i < dark; ++i) {
    room.luxels.push_back(room.luxels[i]);
    room.luxels.back().normal_ws *= -1.0F;
    room.exitance.emplace_back(0);
    room.direct_irradiance.emplace_back(0);
  }
  const LitRoom solved(room);
  const std::vector<glm::vec3> irradiance = solved.solve({64, 100, 1e-3F}).value().irradiance;
  for (std::size_t i = 0; i < irradiance.size(); ++i) {
    const float y = solved.room.luxels[i].position_ws.y;
    if (y < 0.5F || i >= dark) {
      EXPECT_EQ(irradiance[i].x, 0) << i;
    } else {
      EXPECT_GT(irradiance[i].x, 0.5F) << i;
    }
  }
}

// What has no luxels is black and stands in the way.
TEST(Interreflection, surfaces_without_luxels_are_black) {
  LuxelRoom room = plates();
  room.add({{-1, 0.1F, 2}, {3, 0, 0}, {0, 0, -3}, 0, 0});
  const Interreflection solved = LitRoom(room).solve({64, 4, 0}).value();
  for (const glm::vec3& irradiance : solved.irradiance) EXPECT_EQ(irradiance, glm::vec3(0));
}

// Light that would not fall off for ever ends with the number of bounces.
TEST(Interreflection, white_rooms_come_to_an_end) {
  LuxelRoom room;
  room.add_box({0, 0, 0}, {1, 1, 1}, 2, true, glm::vec3(1), glm::vec3(1));
  const Interreflection solved = LitRoom(room).solve({16, 30, 1e-3F}).value();
  EXPECT_EQ(solved.bounces, 30);
  for (const glm::vec3& irradiance : solved.irradiance) EXPECT_NEAR(irradiance.x, 30, 1e-3F);
}

// More luxels than patches: bounces are worked out between groups, and the last goes to each luxel.
TEST(Interreflection, many_luxels_are_grouped) {
  LuxelRoom room;
  room.add_box({0, 0, 0}, {1, 1, 1}, 75, true, glm::vec3(0.5F), glm::vec3(1));
  const LitRoom lit(room);
  const Interreflection solved = lit.solve({16, 100, 1e-3F}).value();
  EXPECT_LT(solved.patch_count, lit.room.luxels.size());
  for (const glm::vec3& irradiance : solved.irradiance) ASSERT_NEAR(irradiance.x, 2, 0.01F);
}

// A wall without thickness parts a room; more luxels than patches. Nothing of the light on one side is shared with the other.
TEST(Interreflection, walls_are_not_shared_across) {
  LuxelRoom room;
  const std::size_t lit = room.add({{0, 0, 1}, {1, 0, 0}, {0, 0, -1}, 100, 100, glm::vec3(0.5F)});
  const std::size_t dark = room.add({{1, 0, 1}, {1, 0, 0}, {0, 0, -1}, 100, 100, glm::vec3(0.5F)});
  const std::size_t lit_wall =
      room.add({{1, 0, 1}, {0, 1, 0}, {0, 0, -1}, 100, 100, glm::vec3(0.5F), glm::vec3(1)});
  ASSERT_LT(room.luxels[lit_wall].normal_ws.x, 0);
  room.add({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 100, 100, glm::vec3(0.5F)});
  const LitRoom parted(room);
  const Interreflection solved = parted.solve({64, 2, 0}).value();
  ASSERT_LT(solved.patch_count, parted.room.luxels.size());
  for (std::size_t i = 0; i < 10000; ++i) {
    EXPECT_GT(solved.irradiance[lit + i].x, 0.01F) << i;
    EXPECT_EQ(solved.irradiance[dark + i].x, 0) << i;
  }
}

TEST(Interreflection, threads_cannot_be_seen) {
  LuxelRoom room;
  room.add_box({0, 0, 0}, {1, 1, 1}, 8, true, glm::vec3(0.5F, 0.25F, 0.75F));
  for (std::size_t i = 0; i < 40; ++i)
    room.direct_irradiance[3 * i] = glm::vec3(static_cast<float>(i), 3, 100);
  const LitRoom lit(room);
  const std::vector<glm::vec3> one = lit.solve({32, 100, 1e-3F}, 1).value().irradiance;
  EXPECT_EQ(lit.solve({32, 100, 1e-3F}, 5).value().irradiance, one);
}

TEST(Interreflection, progress_rises_and_stops_when_asked) {
  const LitRoom lit(plates());
  double last = 0;
  ASSERT_TRUE(lit.solve({16, 4, 0}, 1, [&](double fraction) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return true;
  }));
  EXPECT_EQ(last, 1);
  const auto stopped = lit.solve({16, 4, 0}, 1, [](double) { return false; });
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().failure, Failure::cancelled);
}

TEST(Interreflection, refuses_what_makes_no_sense) {
  const auto message = [](const auto& change, RadiositySettings settings = {}) {
    LitRoom lit(plates());
    change(lit.room);
    const auto result = lit.solve(settings);
    return result ? std::string("solved") : to_string(result.error());
  };
  const auto nothing = [](LuxelRoom&) {};
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(message(nothing), "solved");
  EXPECT_EQ(message([](LuxelRoom& r) { r = {}; }), "solved");
  EXPECT_EQ(message(nothing, {15, 1, 0}), "expected 16 to 65536 rays, found 15");
  EXPECT_EQ(message(nothing, {16, 1001, 0}), "expected 0 to 1000 bounces, found 1001");
  EXPECT_EQ(message(nothing, {16, 1, kNan}), "expected a tolerance from 0 to 1, found nan");
  EXPECT_EQ(message([](LuxelRoom& r) { r.direct_irradiance.pop_back(); }),
            "expected direct irradiance for 32 luxels, found it for 31");
  EXPECT_EQ(message([](LuxelRoom& r) { r.exitance.pop_back(); }),
            "expected exitance for 32 luxels or none, found it for 31");
  EXPECT_EQ(message([](LuxelRoom& r) { r.luxels[3].position_ws.y = kNan; }),
            "luxel 3: expected a position within 1e+09 m, found 0.875, nan, 0.875");
  EXPECT_EQ(message([](LuxelRoom& r) {
              r.luxels[4].normal_ws = {0, 2, 0};
            }),
            "luxel 4: expected a normal of length 1, found 0, 2, 0");
  EXPECT_EQ(message([](LuxelRoom& r) { r.luxels[5].area = 0; }),
            "luxel 5: expected an area above 0 and up to 1e+12 m², found 0");
  EXPECT_EQ(message([](LuxelRoom& r) { r.luxels[6].triangle = 77; }),
            "luxel 6: expected a triangle of the frame, found id 77");
  EXPECT_EQ(message([](LuxelRoom& r) { r.luxels[7].reflectance.z = 1.5F; }),
            "luxel 7: expected a reflectance from 0 to 1, found 0.5, 0.5, 1.5");
  EXPECT_EQ(message([](LuxelRoom& r) { r.direct_irradiance[8].x = -1; }),
            "luxel 8: expected an irradiance from 0 to 1e+15, found -1, 0, 0");
  EXPECT_EQ(message([](LuxelRoom& r) { r.exitance[9].x = std::numeric_limits<float>::infinity(); }),
            "luxel 9: expected an exitance from 0 to 1e+15, found inf, 0, 0");
}

}  // namespace
}  // namespace laterna
