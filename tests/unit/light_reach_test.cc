// Lights that are left out of a batch must not have lit anything of it.
#include "shade/light_reach.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>

namespace laterna::shade {
namespace {

glm::dvec3 random_point(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> along(-reach, reach);
  const double x = along(random), y = along(random), z = along(random);
  return {x, y, z};
}

frame::Bounds box_about(const glm::dvec3& centre, const glm::dvec3& extent) {
  return {glm::vec3(centre - extent), glm::vec3(centre + extent), false};
}

frame::PlacedLight placed(const Light& light, const glm::dvec3& from, const glm::dvec3& to) {
  frame::PlacedLight out;
  out.light = &light;
  out.pose = *Pose::look_at(from, to, {0, 1, 0});
  out.view = {out.pose, light.projection};
  return out;
}

bool shines_at(const frame::PlacedLight& light, const glm::dvec3& p) {
  const glm::dvec4 h = light.view.image_from_world() * glm::dvec4(p, 1);
  const bool is_ahead = light.view.projection.is_orthographic || h.w > 0;
  return is_ahead && h.x >= 0 && h.x <= h.w && h.y >= 0 && h.y <= h.w;
}

class ProjectorReach : public ::testing::TestWithParam<bool> {};

TEST_P(ProjectorReach, LeavesOutOnlyBoxesWithoutLight) {
  Light light;
  light.type = LightType::projector;
  light.projection = GetParam() ? Projection::orthographic(1.5, 1, 0.1, 100)
                                : Projection::perspective(Angle::degrees(35), 1.6, 0.1, 100);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> side(0.05, 1.5), inside(-1, 1);
  int left_out = 0;
  for (int i = 0; i < 4000; ++i) {
    const frame::PlacedLight lamp = placed(light, random_point(random, 5), random_point(random, 5));
    const LightReach reach(lamp, ShadingModel::pbr);
    const glm::dvec3 centre = random_point(random, 6);
    const glm::dvec3 extent(side(random), side(random), side(random));
    if (reach.touches(box_about(centre, extent))) continue;
    ++left_out;
    for (int k = 0; k < 60; ++k) {
      const glm::dvec3 p = centre + extent * glm::dvec3(inside(random), inside(random), inside(random));
      ASSERT_FALSE(shines_at(lamp, p));
    }
  }
  EXPECT_GT(left_out, 2500);
}

INSTANTIATE_TEST_SUITE_P(Beams, ProjectorReach, ::testing::Bool(),
                         [](const auto& beam) { return beam.param ? "Parallel" : "Perspective"; });

TEST(LightReach, EndsAtTheRangeOfWindowedLight) {
  Light light;
  light.type = LightType::point;
  light.attenuation = Attenuation::gltf_windowed;
  light.range = 3;
  const frame::PlacedLight lamp = placed(light, {0, 0, 0}, {0, 0, -1});
  const auto touches = [&](ShadingModel model, double x) {
    return LightReach(lamp, model).touches(box_about({x, 0, 0}, {0.5, 0.5, 0.5}));
  };
  EXPECT_TRUE(touches(ShadingModel::pbr, 3.4));
  EXPECT_FALSE(touches(ShadingModel::pbr, 3.6));
  // The papers' lights know no range unless they ask for one.
  EXPECT_TRUE(touches(ShadingModel::papers, 3.6));
}

TEST(LightReach, IsEverywhereForSlidesThatRepeat) {
  Light light;
  light.type = LightType::projector;
  light.projection = Projection::perspective(Angle::degrees(20), 1, 0.1, 100);
  light.outside = Outside::repeat;
  const LightReach reach(placed(light, {0, 0, 0}, {0, 0, -1}), ShadingModel::pbr);
  EXPECT_TRUE(reach.touches(box_about({9, 0, -2}, {0.5, 0.5, 0.5})));
  EXPECT_FALSE(reach.touches(box_about({0, 0, 2}, {0.5, 0.5, 0.5})));  // behind the lens
}

}  // namespace
}  // namespace laterna::shade
