// Segal et al. 1992, section 3.3: shadow maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "reference/bias_sweep.h"
#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"
#include "reference/shadow_scenes.h"
#include "shadow/depth_comparison.h"

namespace laterna {
namespace {

using namespace reference;

// Row 21: Williams' method; the edge against rays, in the map's own texels.
TEST(Segal1992Shadow, ShadowEdgesAgreeWithRays) {
  for (const LightType type : {LightType::directional, LightType::projector, LightType::point}) {
    ShadowScene shown = sphere_over_plane(4.0 / 3);
    Light& light = shown.scene.lights[0];
    light.type = type;
    if (type == LightType::projector)
      light.projection = Projection::perspective(Angle::degrees(50), 1, 0.1, 100);
    light.shadow.resolution = 512;
    const ShadowErrors errors = find_shadow_errors(
        draw_shadow_masks(make_renderer(shown.scene), shown.camera, test_settings(480, 360), "light", 3));
    SCOPED_TRACE(to_string(errors));
    EXPECT_GT(errors.edge_share(), 0.995);
    EXPECT_EQ(errors.far_false_dark + errors.far_false_lit, 0);
    EXPECT_GT(errors.edge_pixels, 200);
  }
}

// Row 22: the three passes; in full shadow a pixel holds the ambient term exactly, and α can be looked at.
TEST(Segal1992Shadow, FullShadowIsTheAmbientTermExactly) {
  ShadowScene shown = sphere_over_plane(4.0 / 3);
  shown.scene.ambient = {0.13F, 0.17F, 0.19F};
  shown.scene.ambient_is_set = true;
  shown.scene.materials[0].base_color = {0.7F, 0.3F, 0.9F, 1};
  RenderSettings settings = papers_settings(160, 120);
  settings.passes = Passes::multi;
  settings.layers = {Layer::passes, Layer::visibility, Layer::albedo, Layer::depth, Layer::object};
  const LayeredImage image = render(make_renderer(shown.scene), shown.camera, settings);
  int in_shadow = 0;
  int in_light = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (at(image, "id.object", x, y) < 0) continue;
      const float alpha = at(image, "pass.2.light.alpha", x, y);
      EXPECT_EQ(alpha, at(image, "visibility.light", x, y));
      EXPECT_EQ(at(image, "pass.1.z", x, y), at(image, "Z", x, y));
      const char* channels[] = {"R", "G", "B"};
      for (int k = 0; k < 3; ++k) {
        const float c = at(image, std::string("albedo.") + channels[k], x, y);
        const float ambient = c * shown.scene.ambient[k];
        EXPECT_EQ(at(image, std::string("pass.1.c.") + channels[k], x, y), ambient);
        const float pixel = at(image, channels[k], x, y);
        EXPECT_EQ(at(image, std::string("pass.3.light.c.") + channels[k], x, y), pixel);
        if (alpha == 0) {
          EXPECT_EQ(pixel, ambient);
        }
        if (alpha == 1) {
          EXPECT_EQ(pixel, ambient + c);
        }
      }
      in_shadow += alpha == 0 ? 1 : 0;
      in_light += alpha == 1 ? 1 : 0;
    }
  }
  EXPECT_GT(in_shadow, 300);
  EXPECT_GT(in_light, 5000);
}

// Row 23: the bias ε.
TEST(Segal1992Shadow, ASweepOfTheBiasTradesAcneForAGapAndTheAutomaticOneHasNeither) {
  int acne_before = 1 << 30;
  double gap_before = -1;
  int acne_at_zero = 0;
  BiasEffect last;
  for (const double bias : {0.0, 0.004, 0.008, 0.016, 0.032, 0.064, 0.128, 0.256}) {
    ShadowSettings settings;
    settings.constant_bias = bias;
    last = effect_of_bias(settings);
    EXPECT_LE(last.acne, acne_before) << bias;
    EXPECT_GE(last.gap_texels, gap_before) << bias;
    EXPECT_NEAR(last.gap_texels, expected_gap_texels(bias), 2) << bias;
    if (bias == 0) acne_at_zero = last.acne;
    acne_before = last.acne;
    gap_before = last.gap_texels;
  }
  EXPECT_GT(acne_at_zero, 10000);
  EXPECT_EQ(last.acne, 0);
  EXPECT_GT(last.gap_texels, 8);

  for (const ShadowFilter filter : {ShadowFilter::refined, ShadowFilter::nearest, ShadowFilter::bilinear,
                                    ShadowFilter::percentage_closer}) {
    ShadowSettings settings;
    settings.filter = filter;
    const BiasEffect automatic = effect_of_bias(settings);
    EXPECT_EQ(automatic.acne, 0) << static_cast<int>(filter);
    EXPECT_LT(automatic.gap_texels, 2) << static_cast<int>(filter);
  }
}

// Row 24: near 0.1 m, far 10 km, two plates 1 cm apart at 9 km.
TEST(Segal1992Shadow, PlatesOneCentimetreApartAtNineKilometresAreToldApart) {
  Scene scene;
  add_object(scene, "front", wall(20, 40, -9000), {1, 0, 0});
  add_object(scene, "back", wall(40, 40, -9000.01F), {0, 1, 0});
  // One more triangle from under the lens to beyond both.
  Mesher mesh;
  mesh.triangle({-0.02F, -0.1F, -0.1F}, {0.02F, -0.1F, -0.1F}, {0, -30, -9200});
  add_object(scene, "strip", mesh.primitive, {0, 0, 1});
  Light light = projector("light", 0.006, 0.006);
  light.projection.near = 0.1;
  light.projection.far = 10000;
  light.shadow.resolution = 512;
  add_light(scene, light, {0, 0, 0}, {0, 0, -1});
  const Renderer renderer = make_renderer(std::move(scene));

  const LayeredImage map = renderer.depth_map("light").value();
  const double seen = 9000 * 0.006;  // metres to each side
  RenderSettings settings = papers_settings(256, 256);
  settings.layers = {Layer::object, Layer::depth};
  View camera = {Pose{}, light.projection};
  const LayeredImage image = render(renderer, camera, settings);
  int front = 0;
  int back = 0;
  const auto is_near = [](double a, double b) { return std::abs(a - b) < 0.002; };
  for (int y = 1; y < 100; ++y) {  // above the strip
    for (int x = 0; x < 512; ++x) {
      const double wx = std::abs(((x + 0.5) / 256 - 1) * seen);
      const float z = at(map, "Z", x, y);
      if (wx < 19.8 && std::abs(((y + 0.5) / 256 - 1) * seen) < 39) {
        EXPECT_TRUE(is_near(z, 9000)) << z;
        EXPECT_EQ(at(image, "id.object", x / 2, y / 2), 0);
        ++front;
      } else if (wx > 20.2 && wx < 39 && std::abs(((y + 0.5) / 256 - 1) * seen) < 39) {
        EXPECT_TRUE(is_near(z, 9000.01)) << z;
        EXPECT_EQ(at(image, "id.object", x / 2, y / 2), 1);
        ++back;
      }
    }
  }
  EXPECT_GT(front, 1000);
  EXPECT_GT(back, 1000);
}

// Row 24: and in the comparison: the plate behind is dark, the one in front is lit.
TEST(Segal1992Shadow, AtNineKilometresAPlateShadesTheOneACentimetreBehindIt) {
  Scene scene;
  const int front = add_object(scene, "front", wall(60, 60, -9000));
  add_object(scene, "back", wall(60, 60, -9000.01F));
  Light light = projector("light", 0.006, 0.006);
  light.projection.near = 0.1;
  light.projection.far = 10000;
  add_light(scene, light, {0, 0, 0}, {0, 0, -1});
  const View camera = look({0, 0, -8990}, {0, 0, -9000}, 60, 1);
  RenderSettings settings = papers_settings(64, 64);
  settings.layers = {Layer::visibility};
  const LayeredImage in_light = render(make_renderer(scene), camera, settings);
  for (const float alpha : values_of(in_light, "visibility.light")) ASSERT_EQ(alpha, 1);
  scene.nodes[static_cast<std::size_t>(front)].visible = false;  // to the camera; it still casts
  const LayeredImage in_shadow = render(make_renderer(scene), camera, settings);
  for (const float alpha : values_of(in_shadow, "visibility.light")) ASSERT_EQ(alpha, 0);
}

// Row 24: where one triangle runs from 0.1 m to 9 km, plates 1 cm before and behind it at 9 km are told from it.
TEST(Segal1992Shadow, OneTriangleFromTheLensToNineKilometresIsToldFromPlatesByIt) {
  // A floor 1 m below the axis, and 1 cm above and below it, far out, a plate.
  Scene scene;
  Mesher mesh;
  mesh.triangle({-40000, -0.05F, 5}, {40000, -0.05F, 5}, {0, -0.05F, -80000});
  add_object(scene, "floor", mesh.primitive);
  // A plane that meets the pixel ray at 9 km is told apart by its distance along that ray: plates square to the axis.
  add_object(scene, "plate", wall(200, 0.04F, -8999.99F));
  scene.nodes[1].parent_from_node[3] = {0, -0.05, 0, 1};
  const Renderer renderer = make_renderer(std::move(scene));
  const double depth = 9000;
  // The camera looks along the floor; the row whose centre meets the floor at 9 km.
  const double tangent = 0.05 / depth;
  const View camera = {Pose{}, {false, -0.01, 0.01, -tangent - 1e-9, -tangent + 1e-9, 0.1, 10000}};
  RenderSettings settings = papers_settings(64, 3);
  settings.layers = {Layer::object, Layer::depth};
  const LayeredImage image = render(renderer, camera, settings);
  EXPECT_EQ(at(image, "id.object", 32, 1), 1);
  EXPECT_NEAR(at(image, "Z", 32, 1), 8999.99, 0.002);
  // And with the plate 1 cm behind, the floor.
  Scene behind = renderer.scene();
  behind.nodes[1].parent_from_node[3].z -= 0.02;
  const LayeredImage other = render(make_renderer(behind), camera, settings);
  EXPECT_EQ(at(other, "id.object", 32, 1), 0);
  EXPECT_NEAR(at(other, "Z", 32, 1), 9000, 0.002);
}

// Row 25: 64 coloured lights, each with its shadow.
TEST(Segal1992Shadow, SixtyFourColouredShadowedLightsAddUpBitForBit) {
  ShadowScene shown = sphere_over_plane(1);
  shown.scene.lights.clear();
  shown.scene.nodes.pop_back();
  std::mt19937 random(64);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  for (int i = 0; i < 64; ++i) {
    Light light = projector("lamp " + std::to_string(i), 0.5, 0.5);
    light.color = {uniform(0, 1), uniform(0, 1), uniform(0, 1)};
    light.intensity = 3;
    light.shadow.resolution = 128;
    if (i % 4 == 1) light.type = LightType::spot;
    if (i % 4 == 2) light.type = LightType::directional, light.intensity = 0.05;
    if (i % 4 == 3) light.type = LightType::point, light.shadow.resolution = 64;
    add_light(shown.scene, light, {uniform(-4, 4), uniform(4, 6), uniform(-4, 4)}, {0, 1, 0});
  }
  RenderSettings settings = test_settings(120, 120);
  settings.layers = {Layer::light, Layer::visibility};
  const LayeredImage image = render(make_renderer(shown.scene), shown.camera, settings);
  for (const char* channel : {"R", "G", "B"}) {
    const std::span<const float> ambient = values_of(image, std::string("ambient.") + channel);
    std::vector<float> sum(ambient.begin(), ambient.end());
    for (const Light& light : shown.scene.lights) {
      const std::span<const float> part = values_of(image, "light." + light.name + "." + channel);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += part[i];
    }
    EXPECT_TRUE(std::ranges::equal(sum, values_of(image, channel))) << channel;
  }
  for (const Light& light : shown.scene.lights) {
    const std::span<const float> alpha = values_of(image, "visibility." + light.name);
    EXPECT_GT(std::ranges::count(alpha, 0.0F), 50) << light.name;
    EXPECT_GT(std::ranges::count(alpha, 1.0F), 50) << light.name;
  }
}

// Row 26: figure 4, shadow map × spot map.
TEST(Segal1992Shadow, SpotMapTimesVisibilityIsTheResult) {
  ShadowScene shown = torus_and_box(4.0 / 3);
  Light light = projector("light", 0.5, 0.5);
  light.slide = add_linear_picture(shown.scene, 64, 64, [](int x, int y) {
    const double r = std::hypot(x - 31.5, y - 31.5) / 32;
    return glm::vec3(static_cast<float>(std::max(0.0, 1 - r * r)));
  });
  light.slide_is_intensity = true;
  shown.scene.lights[0] = light;
  const Renderer renderer = make_renderer(shown.scene);
  RenderSettings settings = papers_settings(160, 120);
  settings.layers = {Layer::visibility};
  const LayeredImage result = render(renderer, shown.camera, settings);
  settings.shadows = ShadowTechnique::none;
  const LayeredImage spot_alone = render(renderer, shown.camera, settings);
  int shadowed = 0;
  for (std::size_t i = 0; i < result.channels[0].values.size(); ++i) {
    const float expected = values_of(spot_alone, "R")[i] * values_of(result, "visibility.light")[i];
    ASSERT_FLOAT_EQ(values_of(result, "R")[i], expected);
    shadowed += expected == 0 && values_of(spot_alone, "R")[i] > 0.1F ? 1 : 0;
  }
  EXPECT_GT(shadowed, 300);
  // The picture on the left of the figure: what the light sees.
  const LayeredImage map = renderer.depth_map("light").value();
  EXPECT_EQ(map.width, 2048);
  settings.layers = {Layer::depth};
  settings.width = settings.height = 128;
  const LayeredImage from_light = render(renderer, renderer.light_view("light").value(), settings);
  EXPECT_NEAR(at(map, "Z", 1024, 1024), at(from_light, "Z", 64, 64), 0.02);
}

// A sheet's shadow on a floor seen from above, the map's texels about ten pixels wide.
LayeredImage visibility_of(const ShadowSettings& settings) {
  Scene scene;
  add_object(scene, "floor", floor(2));
  Mesher mesh;
  mesh.quad({-1, 1, 1}, {0.37F, 1, 1}, {0.11F, 1, -1}, {-1, 1, -1});
  add_object(scene, "sheet", mesh.primitive);
  Light light = sun("light");
  light.fit = false;
  light.projection = Projection::orthographic(2, 2, 0, 20);
  light.shadow = settings;
  light.shadow.resolution = 40;
  add_light(scene, light, {0, 5, 0}, {0, 0, 0}, {0, 0, -1});
  const View below_sheet = {Pose::look_at({0, 0.5, 0}, {0, 0, 0}, {0, 0, -1}).value(),
                            Projection::orthographic(0.9, 0.9, 0, 1)};
  RenderSettings wanted = test_settings(180, 180);
  wanted.layers = {Layer::visibility};
  return render(make_renderer(std::move(scene)), below_sheet, wanted);
}

// Row 27: percentage-closer filtering.
TEST(Segal1992Shadow, PercentageCloserFilteringGivesMultiplesOfOneOverTheTaps) {
  for (int kernel = 2; kernel <= 9; ++kernel) {
    ShadowSettings settings;
    settings.filter = ShadowFilter::percentage_closer;
    settings.kernel = kernel;
    const LayeredImage image = visibility_of(settings);
    const auto taps = static_cast<float>(kernel * kernel);
    std::vector<int> counts(static_cast<std::size_t>(kernel * kernel + 1));
    for (const float alpha : values_of(image, "visibility.light")) {
      const float lit = std::round(alpha * taps);
      ASSERT_FLOAT_EQ(alpha, lit / taps) << kernel;
      ++counts[static_cast<std::size_t>(lit)];
    }
    const auto between =
        std::ranges::count_if(std::span(counts).subspan(1, counts.size() - 2), [](int n) { return n > 0; });
    EXPECT_GE(between, kernel) << kernel;
  }
  // Bilinear taps: finer than multiples of 1/4.
  ShadowSettings bilinear;
  bilinear.filter = ShadowFilter::bilinear;
  const LayeredImage ramp = visibility_of(bilinear);
  int fine = 0;
  for (const float alpha : values_of(ramp, "visibility.light")) {
    fine += alpha * 4 != std::round(alpha * 4) ? 1 : 0;
  }
  EXPECT_GT(fine, 500);
}

// Row 29: one comparison, of what is stored with what is tested. (stored distance, tested distance, bias) → lit.
TEST(Segal1992Shadow, TheComparisonFollowsItsTable) {
  struct Row {
    double stored, tested, bias;
    bool is_lit;
  };
  constexpr Row kTable[] = {
      {2, 2, 0, true},           {2, 1.5, 0, true},        {2, 2.5, 0, false},    {2, 2.002, 0, false},
      {2, 2.4, 0.5, true},       {2, 2.6, 0.5, false},     {2, 1.9, -0.2, false}, {2, 1.7, -0.2, true},
      {9000, 9000.01, 0, false}, {9000, 8999.99, 0, true}, {0.1, 9000, 0, false}, {9000, 0.1, 0, true},
  };
  for (const Row& row : kTable) {
    // Reversed depths, which grow toward the light: far − distance, as an orthographic map keeps them.
    constexpr double kFar = 10000;
    const auto reversed = [](double distance) { return static_cast<float>(kFar - distance); };
    EXPECT_EQ(shadow::is_lit(reversed(row.stored), reversed(row.tested), static_cast<float>(row.bias)),
              row.is_lit)
        << row.stored << " " << row.tested << " " << row.bias;
    if (row.bias == 0) {  // and 1/distance, as a perspective one does
      EXPECT_EQ(shadow::is_lit(static_cast<float>(1 / row.stored), static_cast<float>(1 / row.tested), 0),
                row.is_lit);
    }
  }
  // Nothing seen by the map: lit.
  EXPECT_TRUE(shadow::is_lit(-std::numeric_limits<float>::max(), 1e-6F, 0));
}

}  // namespace
}  // namespace laterna
