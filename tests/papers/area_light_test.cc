// Lights with a size, as the mean of many points (Chen and Tung's soft shadow; Haeberli and Akeley's accumulation buffer).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reference/picture_probes.h"
#include "reference/shapes.h"

namespace laterna {
namespace {

using namespace reference;

// A strip light 1 m wide at 4 m, a straight edge across it at 2 m, and a floor.
Scene strip_over_edge(const LightSource& source) {
  Scene scene;
  add_object(scene, "floor", floor(6));
  const int board = add_object(scene, "board", box({-3, 2, 0}, {3, 1e-4F, 6}));
  scene.nodes[static_cast<std::size_t>(board)].visible = false;
  Light lamp;
  lamp.name = "lamp";
  lamp.type = LightType::spot;
  lamp.attenuation = Attenuation::none;
  lamp.outer_cone = lamp.inner_cone = Angle::degrees(60);
  lamp.source = source;
  add_light(scene, lamp, {0, 4, 0}, {0, 0, 0}, {0, 0, -1});  // right is +X
  return scene;
}

// A row of pixels across the edge: 2 m wide, 512 pixels.
constexpr int kWide = 512;
std::vector<double> row_of_visibility(const Scene& scene, ShadowTechnique technique, int points) {
  RenderSettings settings = test_settings(kWide, 4);
  settings.shadows = technique;
  settings.accumulate = points;
  settings.layers = {Layer::visibility};
  View camera = look({0, 8, 0}, {0, 0, 0}, 30, 1, {0, 0, -1});
  camera.projection = Projection::orthographic(1, 4.0 / kWide, 0.5, 20);
  const LayeredImage image = render(make_renderer(scene), camera, settings);
  const auto row = row_of(image, "visibility.lamp", 2);
  return {row.begin(), row.end()};
}
double x_of(int pixel) { return -1 + 2 * (pixel + 0.5) / kWide; }

LightSource strip(double width) {
  LightSource source;
  source.width = width;
  return source;
}

// Row 35: four points give exactly five levels, and many the analytic ramp over 1.0 m.
TEST(AreaLight, FourPointsAlongAStripGiveFiveLevels) {
  const std::vector<double> row = row_of_visibility(strip_over_edge(strip(1)), ShadowTechnique::raytraced, 4);
  const std::set<double> levels(row.begin(), row.end());
  EXPECT_EQ(levels, (std::set<double>{0, 0.25, 0.5, 0.75, 1}));
  EXPECT_TRUE(std::is_sorted(row.begin(), row.end()));
}

TEST(AreaLight, ManyPointsConvergeToTheAnalyticPenumbra) {
  const std::vector<double> row =
      row_of_visibility(strip_over_edge(strip(1)), ShadowTechnique::raytraced, 256);
  for (int i = 0; i < kWide; ++i) {
    // A point of the floor at x sees the lamp from 2·0 − x on: the edge is halfway.
    const double ramp = std::clamp(x_of(i) + 0.5, 0.0, 1.0);
    ASSERT_NEAR(row[static_cast<std::size_t>(i)], ramp, 0.01) << x_of(i);
  }
  const auto begin = std::find_if(row.begin(), row.end(), [](double a) { return a > 0; });
  const auto end = std::find_if(row.begin(), row.end(), [](double a) { return a == 1; });
  EXPECT_NEAR(static_cast<double>(end - begin) * 2 / kWide, 1.0, 0.01) << "metres of penumbra";
}

// A ball looks like an evenly bright disc: its share beyond a straight line is that of a disc.
TEST(AreaLight, ABallLooksEvenlyBright) {
  LightSource ball;
  ball.radius = 0.5;
  const std::vector<double> row = row_of_visibility(strip_over_edge(ball), ShadowTechnique::raytraced, 400);
  for (int i = 0; i < kWide; i += 16) {
    // The line at −x, seen from the floor, cuts the disc of radius 0.5 (nearly: the ball is near, 4 m).
    const double t = std::clamp(x_of(i) / 0.5, -1.0, 1.0);
    const double share = 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / 3.14159265358979;
    EXPECT_NEAR(row[static_cast<std::size_t>(i)], share, 0.02) << x_of(i);
  }
}

// The sun's disc, 0.53° wide, over an edge 10 m up: 92.5 mm of penumbra, of which an even disc's share is known.
TEST(AreaLight, TheSunsDiscGivesItsPenumbra) {
  Scene scene;
  add_object(scene, "floor", floor(1));
  const int board = add_object(scene, "board", box({-3, 10, 0}, {3, 1e-4F, 6}));
  scene.nodes[static_cast<std::size_t>(board)].visible = false;
  Light sun;
  sun.name = "lamp";
  sun.type = LightType::directional;
  sun.source.angular_diameter = Angle::degrees(0.53);
  add_light(scene, sun, {0, 20, 0}, {0, 0, 0}, {0, 0, -1});
  RenderSettings settings = test_settings(kWide, 4);
  settings.shadows = ShadowTechnique::raytraced;
  settings.accumulate = 512;
  settings.layers = {Layer::visibility};
  View camera = look({0, 8, 0}, {0, 0, 0}, 30, 1, {0, 0, -1});
  camera.projection = Projection::orthographic(0.1, 0.1 * 4.0 / kWide, 0.5, 20);
  const LayeredImage image = render(make_renderer(std::move(scene)), camera, settings);
  const double radius = 10 * std::tan(Angle::degrees(0.265).in_radians());
  EXPECT_NEAR(2 * radius, 0.0925, 0.0001);
  const auto row = row_of(image, "visibility.lamp", 2);
  for (int i = 0; i < kWide; i += 8) {
    const double t = std::clamp(0.1 * x_of(i) / radius, -1.0, 1.0);
    const double share = 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / 3.14159265358979;
    EXPECT_NEAR(row[static_cast<std::size_t>(i)], share, 0.01) << i;
  }
}

// The estimate says what the error is, within a factor of a few, and falls as points are added; asked to, drawing stops.
TEST(AreaLight, NoiseIsReportedAndStopsTheWork) {
  LightSource lamp;
  lamp.width = lamp.height = 1;
  const Renderer renderer = make_renderer(strip_over_edge(lamp));
  RenderSettings settings = test_settings(kWide, 4);
  settings.shadows = ShadowTechnique::raytraced;
  View camera = look({0, 8, 0}, {0, 0, 0}, 30, 1, {0, 0, -1});
  camera.projection = Projection::orthographic(1, 4.0 / kWide, 0.5, 20);
  const auto draw = [&](int points, double noise, RenderStatistics& statistics) {
    settings.accumulate = points;
    settings.noise = noise;
    return *renderer.render(camera, settings, {}, &statistics);
  };
  RenderStatistics s;
  const LayeredImage truth = draw(512, 0, s);
  EXPECT_EQ(s.pictures, 512);
  double last = 1;
  for (const int points : {4, 16, 64}) {
    const LayeredImage image = draw(points, 0, s);
    double squares = 0, mean = 0;
    for (std::size_t i = 0; i < truth.channels[0].values.size(); ++i) {
      const double difference = image.channels[0].values[i] - truth.channels[0].values[i];
      squares += difference * difference;
      mean += truth.channels[0].values[i];
    }
    const double count = static_cast<double>(truth.channels[0].values.size());
    const double error = std::sqrt(squares / count) / (mean / count);
    EXPECT_LT(error, 2 * s.noise) << points;
    EXPECT_LT(s.noise, 0.6 * last) << points;
    last = s.noise;
  }
  draw(9, 0, s);
  EXPECT_EQ(s.pictures, 9) << "an odd number is an estimate too";
  EXPECT_GT(s.noise, 0);
  EXPECT_LT(s.noise, 1);
  draw(512, last * 1.01, s);
  EXPECT_LE(s.pictures, 256);
  EXPECT_LE(s.noise, last * 1.01);
}

// Unless a noise is asked for, all points are drawn, also where the picture is the same from all of them, or black.
TEST(AreaLight, AllPointsAreDrawnWhereNoNoiseIsAskedFor) {
  for (const double intensity : {1.0, 0.0}) {
    Scene scene;
    add_object(scene, "floor", floor(2));
    Light sun;
    sun.name = "sun";
    sun.type = LightType::directional;
    sun.intensity = intensity;
    sun.source.angular_diameter = Angle::degrees(0.53);
    add_light(scene, sun, {0, 5, 0}, {0, 0, 0}, {0, 0, -1});
    RenderSettings settings = test_settings(16, 16);
    settings.shading = ShadingModel::papers;
    settings.accumulate = 16;
    RenderStatistics statistics;
    ASSERT_TRUE(make_renderer(std::move(scene))
                    .render(look({0, 3, 0}, {0, 0, 0}, 30, 1, {0, 0, -1}), settings, {}, &statistics));
    EXPECT_EQ(statistics.pictures, 16);
    EXPECT_EQ(statistics.noise, 0);
  }
}

// Beauty is the sum of the mean layers, and depends neither on the threads nor on which layers are asked for.
TEST(AreaLight, TheMeanIsTheSameForEveryone) {
  LightSource ball;
  ball.radius = 0.3;
  Scene scene = strip_over_edge(ball);
  scene.ambient = glm::vec3(0.1F, 0.2F, 0.3F);
  scene.ambient_is_set = true;
  RenderSettings settings = test_settings(64, 48);
  settings.accumulate = 6;
  settings.layers = {Layer::light, Layer::depth, Layer::visibility};
  const View camera = look({1, 3, 5}, {0, 0, 0}, 50, 1.33);
  const LayeredImage image = render(make_renderer(scene, 1), camera, settings);
  const LayeredImage again = render(make_renderer(scene, 3), camera, settings);
  EXPECT_EQ(count_different_pixels(image, again), 0U);
  settings.layers.clear();
  const LayeredImage bare = render(make_renderer(scene, 2), camera, settings);
  EXPECT_EQ(count_different_pixels(bare, image), 0U);
  for (int x = 0; x < 64; x += 5) {
    EXPECT_EQ(at(image, "G", x, 40), at(image, "ambient.G", x, 40) + at(image, "light.lamp.G", x, 40));
  }
  settings.accumulate = 1;
  settings.layers = {Layer::depth};
  const LayeredImage one = render(make_renderer(scene), camera, settings);
  EXPECT_EQ(at(one, "Z", 30, 40), at(image, "Z", 30, 40)) << "data is the first picture's";
}

// A number of pictures that there cannot be is refused.
TEST(AreaLight, ThereIsOnePictureAtLeast) {
  const Renderer renderer = make_renderer(strip_over_edge({}));
  RenderSettings settings = test_settings(16, 16);
  for (const int pictures : {0, -1, 65537}) {
    settings.accumulate = pictures;
    EXPECT_FALSE(renderer.render(look({1, 3, 5}, {0, 0, 0}, 50, 1), settings));
  }
}

}  // namespace
}  // namespace laterna
