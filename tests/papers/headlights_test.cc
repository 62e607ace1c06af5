// Segal et al. 1992, section 1 and 3.2: headlights, landing lights and steerable taxi lights (row 20), on the scenes of
// examples/scenes.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"

namespace laterna {
namespace {

using namespace reference;

Scene example(const char* scene, const char* rig) {
  const std::filesystem::path folder = LATERNA_SOURCE_DIR "/examples/scenes";
  LoadOptions options;
  options.rigs = {folder / rig};
  Result<Scene> loaded = load_scene({folder / scene}, options);
  if (!loaded) throw std::runtime_error(to_string(loaded.error()));
  return std::move(*loaded);
}

Scene with_only(Scene scene, const std::string& light) {
  for (Light& each : scene.lights) each.enabled = each.name == light;
  return scene;
}

// Where a column of values changes most from one row to the next: the border between the two.
int steepest_row(const LayeredImage& image, const std::string& channel, int x) {
  int best = 1;
  float most = -1;
  for (int y = 1; y < image.height; ++y) {
    const float step = at(image, channel, x, y) - at(image, channel, x, y - 1);
    if (step <= most) continue;
    most = step;
    best = y;
  }
  return best;
}

// The wall square-on, from 0.5 m before it: `side` metres to a pixel, its top-left corner at (−8, 2).
constexpr double kPixel = 0.05;
constexpr int kWallWidth = 320, kWallHeight = 40;
LayeredImage draw_wall(const Renderer& renderer, double wall_z) {
  View view;
  view.pose = Pose::look_at({0, 1, wall_z + 0.5}, {0, 1, wall_z}, {0, 1, 0}).value();
  view.projection = Projection::orthographic(8, 1, 0, 1);
  RenderSettings settings = test_settings(kWallWidth, kWallHeight);
  settings.layers = {Layer::lux};
  settings.shadows = ShadowTechnique::none;  // walkers and posts stand in the way
  return render(renderer, view, settings);
}

// Low beams are put on the wall as the map has them: the border that starts 1 % below the lamps, level to the left and
// rising to the right, 25 m ahead and wherever else the car has driven.
TEST(Headlights, TheCutOffStandsOnTheWallWhereTheMapPutsIt) {
  const LayeredImage map =
      read_layered_image(LATERNA_SOURCE_DIR "/examples/scenes/low_beam.png", ChannelValues::stored).value();
  ASSERT_EQ(map.width, 1024);
  constexpr double kFocal = 640;
  constexpr double kAxisX = 512;
  constexpr double kAxisY = 64;
  for (const char* lamp : {"left low beam", "right low beam"}) {
    Renderer renderer = make_renderer(with_only(example("road.glb", "headlights.json"), lamp));
    const int node = find_light_node(renderer.scene(), lamp);
    const glm::dmat4 parked = renderer.scene().nodes[static_cast<std::size_t>(node)].parent_from_node;
    for (const double driven : {0.0, 10.0}) {
      const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), {0, 0, -driven}) * parked;
      ASSERT_TRUE(renderer.set_transform(node, moved));
      const glm::dvec3 position(moved[3]);
      const double distance = 25 - driven;
      const LayeredImage wall = draw_wall(renderer, -25);
      int level = 0;
      int rising = 0;
      for (int x = 20; x < kWallWidth - 20; x += 4) {
        const double across = ((x + 0.5) * kPixel - 8 - position.x) / distance;
        if (std::max(across, 0.0) * std::tan(std::numbers::pi / 12) > 0.09) continue;  // above the map's top
        const int column = static_cast<int>(kAxisX + across * kFocal);
        const double up = (kAxisY - steepest_row(map, map.channels[0].name, column)) / kFocal;
        const double expected = (2 - (position.y + up * distance)) / kPixel;
        if (expected < 2) continue;  // above the picture
        EXPECT_NEAR(steepest_row(wall, "lux.Y", x), expected, 1) << lamp << ", " << x << ", " << driven;
        // What the map was made to be: UN Regulation 112's border.
        EXPECT_NEAR(up, -0.01 + std::max(across, 0.0) * std::tan(std::numbers::pi / 12), 1.5 / kFocal);
        (across > 0 ? rising : level) += 1;
      }
      EXPECT_GT(level, 20);
      EXPECT_GT(rising, 15);
    }
  }
}

// Both lamps together are the sum of the two, and glare above the border is little.
TEST(Headlights, TwoLampsAddUp) {
  const Scene scene = example("road.glb", "headlights.json");
  const LayeredImage both = draw_wall(make_renderer(scene), -25);
  const LayeredImage left = draw_wall(make_renderer(with_only(scene, "left low beam")), -25);
  const LayeredImage right = draw_wall(make_renderer(with_only(scene, "right low beam")), -25);
  for (int i = 0; i < kWallWidth * kWallHeight; i += 13) {
    const int x = i % kWallWidth;
    const int y = i / kWallWidth;
    const float sum = at(left, "lux.Y", x, y) + at(right, "lux.Y", x, y);
    EXPECT_NEAR(at(both, "lux.Y", x, y), sum, 1e-5F * sum);
  }
  EXPECT_LT(at(both, "lux.Y", 80, 20), 1);    // 4 m to the left, 1 m high
  EXPECT_GT(at(both, "lux.Y", 160, 34), 20);  // in the middle, 0.3 m high
}

// A taxi light that is turned by θ moves its patch by d tan θ; the landing lights stay where they are.
TEST(Headlights, SteeringMovesTheTaxiLightsPatch) {
  Scene scene = with_only(example("apron.glb", "taxi_light.json"), "taxi light");
  const int node = find_light_node(scene, "taxi light");
  scene.nodes[static_cast<std::size_t>(node)].parent_from_node =
      Pose::look_at({0, 2, 0}, {0, 2, -1}, {0, 1, 0})->world_from_view();
  Renderer renderer = make_renderer(std::move(scene));
  const glm::dmat4 ahead = renderer.scene().nodes[static_cast<std::size_t>(node)].parent_from_node;
  constexpr double kDoors = 79.7;  // metres ahead
  constexpr int kWidth = 1000;
  constexpr double kSide = 0.08;  // metres of a pixel
  for (const double degrees : {-20.0, -5.0, 0.0, 12.0, 24.0}) {
    const double theta = degrees * std::numbers::pi / 180;
    // To the right is clockwise from above.
    ASSERT_TRUE(renderer.set_transform(node, glm::rotate(ahead, -theta, glm::dvec3(0, 1, 0))));
    View view;
    view.pose = Pose::look_at({0, 2, 0.5 - kDoors}, {0, 2, -kDoors}, {0, 1, 0}).value();
    view.projection = Projection::orthographic(kWidth * kSide / 2, kWidth * kSide / 20, 0, 0.9);
    RenderSettings settings = test_settings(kWidth, 100);
    settings.layers = {Layer::uv, Layer::lux};
    settings.shadows = ShadowTechnique::none;
    const LayeredImage picture = render(renderer, view, settings);
    std::vector<double> middle = crossings(row_of(picture, "uv.taxi light.u", 50), 0.5);
    std::erase_if(middle, [](double x) { return std::isnan(x); });  // the frame's sides
    ASSERT_EQ(middle.size(), 1U) << degrees;
    const double moved = (middle[0] - kWidth / 2.0) * kSide;
    EXPECT_NEAR(moved, kDoors * std::tan(theta), kSide) << degrees;
    EXPECT_GT(at(picture, "lux.Y", static_cast<int>(middle[0]), 50), 5);
  }
}

}  // namespace
}  // namespace laterna
