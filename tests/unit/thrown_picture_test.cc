// Where a projector's picture lands: sizes, lux and pixels that follow from the data sheet.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "laterna/thrown_picture.h"
#include "reference/projector_scenes.h"
#include "reference/shapes.h"

namespace laterna {
namespace {

// A projector of 3,000 lm and throw ratio 1.5 at the height of 1 m, 3 m before a wall of 20 × 20 m that is turned by `turn`
// about the vertical through the point that it looks at.
Scene projector_before_a_wall(Angle turn = {}) {
  Scene scene;
  const double c = std::cos(turn.in_radians()), s = std::sin(turn.in_radians());
  Primitive wall;
  for (const glm::dvec2 corner :
       {glm::dvec2(-10, -10), glm::dvec2(10, -10), glm::dvec2(10, 10), glm::dvec2(-10, 10)})
    wall.positions.emplace_back(corner.x * c, corner.y + 1, -3 - corner.x * s);
  wall.indices = {0, 1, 2, 0, 2, 3};
  reference::add_object(scene, "wall", wall);
  Light lantern = reference::projector("lantern", 1, 1);
  lantern.projection =
      Projection::from_throw_ratio(1.5, 16.0 / 9, 0.1, std::numeric_limits<double>::infinity());
  lantern.lumens = 3000;
  lantern.attenuation = Attenuation::inverse_square;
  lantern.aspect_from_slide = false;
  lantern.panel_width = 1920, lantern.panel_height = 1080;
  scene.lights.push_back(lantern);
  Node& node = scene.nodes.emplace_back();
  node.name = "lantern";
  node.light = 0;
  node.parent_from_node = Pose::look_at({0, 1, 0}, {0, 1, -1}, {0, 1, 0})->world_from_view();
  return scene;
}

ThrownPicture thrown(const Scene& scene) {
  const Renderer renderer = reference::make_renderer(scene);
  const auto found = find_thrown_picture(renderer, "lantern");
  EXPECT_TRUE(found) << (found ? "" : to_string(found.error()));
  EXPECT_TRUE(found && *found) << "it meets nothing";
  return found && *found ? **found : ThrownPicture{};
}

// 3,000 lm on 2.0 × 1.125 m are 1,333 lx; 1920 pixels on 2.0 m are 1.0417 mm apart.
TEST(ThrownPicture, SquareOn) {
  const ThrownPicture picture = thrown(projector_before_a_wall());
  EXPECT_NEAR(picture.throw_distance, 3, 1e-5);
  EXPECT_NEAR(picture.incidence.in_degrees(), 0, 0.01);
  EXPECT_NEAR(picture.lux, 3000 / 2.25, 0.05);
  ASSERT_TRUE(picture.size && picture.corners_ws && picture.pixel_pitch);
  EXPECT_NEAR(picture.size->x, 2, 1e-5);
  EXPECT_NEAR(picture.size->y, 1.125, 1e-5);
  EXPECT_NEAR(picture.pixel_pitch->x, 2.0 / 1920, 1e-8);
  EXPECT_NEAR(picture.pixel_pitch->y, 1.125 / 1080, 1e-8);
  EXPECT_NEAR(glm::distance(picture.middle_ws, {0, 1, -3}), 0, 1e-5);
  EXPECT_NEAR(glm::distance((*picture.corners_ws)[0], {-1, 1.5625, -3}), 0, 1e-5);
  EXPECT_NEAR(glm::distance((*picture.corners_ws)[2], {1, 0.4375, -3}), 0, 1e-5);
}

// On a wall turned by 60° the ray of tangent t meets it at t d / (cos 60° ± t sin 60°) along the wall.
TEST(ThrownPicture, OnAWallThatIsTurned) {
  const double turn = 60, t = 1 / 3.0, d = 3;
  const ThrownPicture picture = thrown(projector_before_a_wall(Angle::degrees(turn)));
  const double c = std::cos(turn * 3.14159265358979 / 180), s = std::sin(turn * 3.14159265358979 / 180);
  EXPECT_NEAR(picture.incidence.in_degrees(), turn, 0.02);
  EXPECT_NEAR(picture.throw_distance, 3, 1e-4);
  EXPECT_NEAR(picture.lux, 3000 / 2.25 * c, 1);  // flat field: cos θ / d² on the axis
  ASSERT_TRUE(picture.size);
  EXPECT_NEAR(picture.size->x, t * d / (c - t * s) + t * d / (c + t * s), 0.02);
  EXPECT_NEAR(picture.size->y, 1.125, 1e-3);
}

TEST(ThrownPicture, ShiftedDistortedAndColoured) {
  Scene scene = projector_before_a_wall();
  Light& light = scene.lights[0];
  light.projection = light.projection.shifted(0.25, 0.5);
  EXPECT_NEAR(glm::distance(thrown(scene).middle_ws, {0.5, 1.5625, -3}), 0, 1e-4);
  EXPECT_NEAR(thrown(scene).size->x, 2, 1e-4);
  EXPECT_NEAR(thrown(scene).lux, 3000 / 2.25, 0.5);
  light.color = {0, 1, 0};
  EXPECT_NEAR(thrown(scene).lux, 0.7152 * 3000 / 2.25, 0.5);
  light.color = glm::vec3(1);
  light.distortion.k1 = 0.25;  // a barrel: smaller than the frame
  const ThrownPicture barrel = thrown(scene);
  ASSERT_TRUE(barrel.size);
  EXPECT_LT(barrel.size->x, 1.99);
}

// What is in the way, a dark slide, and other lights do not change what white would be; the slide's shape is the frame's.
TEST(ThrownPicture, AWhiteSlideOfTheSlidesShape) {
  Scene scene = projector_before_a_wall();
  Light& light = scene.lights[0];
  light.slide = reference::add_linear_picture(scene, 40, 20, [](int, int) { return glm::vec3(0); });
  light.projection = Projection::perspective(Angle::degrees(2 * 14.0362434679), 1, 0.1,  // tan = 1/4
                                             std::numeric_limits<double>::infinity());
  light.aspect_from_slide = true;
  light.panel_width = light.panel_height = 0;
  const ThrownPicture picture = thrown(scene);
  ASSERT_TRUE(picture.size && picture.pixel_pitch);
  EXPECT_NEAR(picture.size->x, 3, 1e-4);
  EXPECT_NEAR(picture.size->y, 1.5, 1e-4);
  EXPECT_EQ(picture.pixels_across, 40);
  EXPECT_NEAR(picture.pixel_pitch->x, 3.0 / 40, 1e-5);
  EXPECT_NEAR(picture.lux, 3000 / 4.5, 0.1);
}

TEST(ThrownPicture, MissesAndFaults) {
  Scene scene = projector_before_a_wall();
  scene.nodes.back().parent_from_node = Pose::look_at({0, 1, 0}, {0, 1, 1}, {0, 1, 0})->world_from_view();
  const Renderer renderer = reference::make_renderer(scene);
  const auto found = find_thrown_picture(renderer, "lantern");
  ASSERT_TRUE(found);
  EXPECT_FALSE(*found);
  EXPECT_FALSE(find_thrown_picture(renderer, "nobody"));
  EXPECT_EQ(renderer.idle_projectors(), std::vector<std::string>{"lantern"});
}

TEST(IdleProjectors, OnlyThoseThatShinePastEverything) {
  Scene scene = projector_before_a_wall();
  EXPECT_TRUE(reference::make_renderer(scene).idle_projectors().empty());
  scene.lights[0].projection.far = 2.5;
  EXPECT_EQ(reference::make_renderer(scene).idle_projectors().size(), 1U);
  scene.lights[0].outside = Outside::repeat;  // its slide goes on all over
  EXPECT_TRUE(reference::make_renderer(scene).idle_projectors().empty());
  scene.lights[0].outside = Outside::black;
  scene.lights[0].enabled = false;
  EXPECT_TRUE(reference::make_renderer(scene).idle_projectors().empty());
}

}  // namespace
}  // namespace laterna
