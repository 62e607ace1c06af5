// Bentley, A comparison of shadow algorithms, WPI 1995: the shadow z-buffer and its lessons.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reference/bias_sweep.h"
#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"
#include "reference/shadow_scenes.h"

namespace laterna {
namespace {

using namespace reference;

ShadowErrors errors_of(const Renderer& renderer, const View& camera, const std::string& light,
                       int side = 320) {
  return find_shadow_errors(draw_shadow_masks(renderer, camera, test_settings(side, side * 3 / 4), light, 3));
}

void expect_right(const ShadowErrors& errors) {
  SCOPED_TRACE(to_string(errors));
  EXPECT_EQ(errors.far_false_dark, 0);
  EXPECT_EQ(errors.far_false_lit, 0);
  EXPECT_GE(errors.edge_share(), 0.995);
  EXPECT_GT(errors.edge_pixels, 100);
}

// Row 99: the object phase for every light.
TEST(Bentley, EveryLightHasItsOwnShadowBuffer) {
  ShadowScene shown = sphere_over_plane(4.0 / 3);
  Light lantern = projector("lantern", 0.6, 0.6);
  lantern.intensity = 30;
  add_light(shown.scene, lantern, {-3, 5, 2}, {0, 0.5, 0});
  add_light(shown.scene, spot("spot", 35), {1, 6, -2}, {0, 0, 0});
  Light bulb = spot("bulb", 30);
  bulb.type = LightType::point;
  add_light(shown.scene, bulb, {2, 4, 3}, {0, 0, 0});
  const Renderer renderer = make_renderer(shown.scene);
  for (const char* light : {"light", "lantern", "spot", "bulb"}) {
    SCOPED_TRACE(light);
    expect_right(errors_of(renderer, shown.camera, light));
  }
}

// Row 100: the fudge factor.
TEST(Bentley, WithoutAFudgeFactorSurfacesShadeThemselvesAndTheAutomaticOneStopsThat) {
  ShadowSettings none;
  none.constant_bias = 0;
  EXPECT_GT(effect_of_bias(none).acne, 3000);
  ShadowSettings large;
  large.constant_bias = 0.3;
  const BiasEffect detached = effect_of_bias(large);
  EXPECT_EQ(detached.acne, 0);
  EXPECT_NEAR(detached.gap_texels, expected_gap_texels(0.3), 2);
  const BiasEffect automatic = effect_of_bias({});
  EXPECT_EQ(automatic.acne, 0);
  EXPECT_LT(automatic.gap_texels, 2);
}

// Row 101: filtering depths and comparing the mean is wrong; comparing first and filtering the answers is right.
TEST(Bentley, AveragedDepthsLightAPixelThatPercentageCloserFilteringGetsRight) {
  // A sheet 1 m over a block 3 m over the floor. On the block, in the sheet's shadow at the sheet's edge, the 3 × 3 mean
  // of the stored depths, some of the sheet and some of the block's and the floor's, lies behind the block.
  Scene scene;
  add_object(scene, "floor", floor(4));
  add_object(scene, "block", box({0.5F, 1.5F, 0}, {0.5F, 1.5F, 2}));  // its left side at x = 0
  Mesher mesh;
  mesh.quad({-0.02F, 4, 1}, {0.24F, 4, 1}, {0.24F, 4, -1}, {-0.02F, 4, -1});
  add_object(scene, "sheet", mesh.primitive);
  Light light = sun("light");
  light.fit = false;
  light.projection = Projection::orthographic(2, 2, 0, 20);
  light.shadow.resolution = 40;  // texels of 0.1 m, from whole tenths of a metre
  light.shadow.filter = ShadowFilter::percentage_closer;
  light.shadow.kernel = 3;
  add_light(scene, light, {0, 8, 0}, {0, 0, 0}, {0, 0, -1});
  const Renderer renderer = make_renderer(std::move(scene));

  // Between sheet and block, looking down on the block's top near its left side.
  const View between = {Pose::look_at({0, 3.5, 0}, {0, 3, 0}, {0, 0, -1}).value(),
                        Projection::orthographic(0.2, 0.2, 0, 1)};
  RenderSettings settings = test_settings(40, 40);
  settings.layers = {Layer::visibility, Layer::position, Layer::object};
  const LayeredImage image = render(renderer, between, settings);
  settings.shadows = ShadowTechnique::raytraced;
  const LayeredImage truth = render(renderer, between, settings);
  const LayeredImage map = renderer.depth_map("light").value();
  const View view = renderer.light_view("light").value();

  int corrected = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      if (at(image, "id.object", x, y) != 1) continue;
      const glm::dvec4 world(at(image, "P.X", x, y), at(image, "P.Y", x, y), at(image, "P.Z", x, y), 1);
      const glm::dvec4 q = view.image_from_world() * world;
      const int i = static_cast<int>(q.x * map.width);
      const int j = static_cast<int>(q.y * map.height);
      double mean = 0;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) mean += at(map, "Z", i + dx, j + dy) / 9;
      }
      const double distance = -(view.view_from_world() * world).z;
      const bool averaged_is_lit = distance <= mean + 0.01;
      const bool is_lit = at(truth, "visibility.light", x, y) == 1;
      const bool filtered_is_lit = at(image, "visibility.light", x, y) >= 0.5F;
      if (averaged_is_lit != is_lit && filtered_is_lit == is_lit) ++corrected;
      // Where PCF is wrong by its own blur, it is by less than its kernel; here the sheet covers more than half of it.
      ASSERT_EQ(filtered_is_lit, is_lit) << x << ", " << y;
    }
  }
  EXPECT_GT(corrected, 20);
}

// Whether depth jumps between a pixel's neighbours.
bool is_silhouette(const LayeredImage& image, int x, int y) {
  if (x == 0 || y == 0 || x + 1 == image.width || y + 1 == image.height) return true;
  const auto [least, most] = std::minmax({at(image, "Z", x - 1, y), at(image, "Z", x + 1, y),
                                          at(image, "Z", x, y - 1), at(image, "Z", x, y + 1)});
  return most - least > 0.1F;
}

// Row 102: the scene with each light's eyes, in colour and depth; what the light sees is lit.
TEST(Bentley, TheLightsEyeViewSeesNoShadowAndItsDepthIsTheMaps) {
  ShadowScene shown = torus_and_box(1);
  add_light(shown.scene, sun("sun"), {-2, 5, 3}, {0, 0, 0});
  for (const char* name : {"light", "sun"}) {
    const Renderer renderer = make_renderer(shown.scene);
    const View view = renderer.light_view(name).value();
    const LayeredImage map = renderer.depth_map(name).value();
    RenderSettings settings = test_settings(map.width / 8, map.height / 8);
    settings.layers = {Layer::depth, Layer::visibility, Layer::object};
    const LayeredImage image = render(renderer, view, settings);
    const std::string alpha = std::string("visibility.") + name;
    int seen = 0;
    int dark = 0;
    int same = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const float z = at(image, "Z", x, y);
        // The pixel's centre is the corner of four texels.
        const float stored = at(map, "Z", 8 * x + 4, 8 * y + 4);
        if (at(image, "id.object", x, y) < 0) continue;
        ++seen;
        // On a silhouette a pixel may show what lies a 256th of a pixel behind it.
        dark += !is_silhouette(image, x, y) && at(image, alpha, x, y) < 0.5F ? 1 : 0;
        same += std::abs(stored - z) < 0.05F ? 1 : 0;
      }
    }
    EXPECT_GT(seen, 10000) << name;
    EXPECT_EQ(dark, 0) << name;
    EXPECT_GT(same, 0.99 * seen) << name;  // all but silhouettes
    double brightest = 0;
    for (const float r : values_of(image, "R")) brightest = std::max<double>(brightest, r);
    EXPECT_GT(brightest, 0.5);
  }
}

// Row 103: every pair of caster and receiver, not just the ground.
TEST(Bentley, ShadowsFallOnAnyObject) {
  // A row of four bodies and a floor in a low sun: each but the last shades the next one and the floor.
  ShadowScene shown;
  add_object(shown.scene, "floor", floor(5));
  add_object(shown.scene, "sphere", sphere({-2.2F, 1.4F, 0.1F}, 0.5F, 64));
  add_object(shown.scene, "box", box({-0.8F, 0.6F, 0}, {0.3F, 0.6F, 0.5F}));
  add_object(shown.scene, "torus", torus({0.9F, 0.45F, 0}, 0.6F, 0.2F, 64));
  add_object(shown.scene, "post", box({2.2F, 0.5F, 0}, {0.1F, 0.5F, 0.1F}));
  add_light(shown.scene, sun("light"), {-4, 3, 0.3}, {0, 0, 0});
  shown.camera = look({-1, 4, 5}, {0, 0.4, 0}, 42, 4.0 / 3);
  expect_right(errors_of(make_renderer(shown.scene), shown.camera, "light", 400));
  // Pair by pair: with one caster alone, the shadow on one receiver alone.
  std::set<std::pair<int, int>> pairs;
  for (int caster = 1; caster <= 4; ++caster) {
    Scene scene = shown.scene;
    for (int other = 0; other <= 4; ++other)
      scene.nodes[static_cast<std::size_t>(other)].casts_shadow = other == caster;
    const Renderer renderer = make_renderer(scene);
    const ShadowMasks masks = draw_shadow_masks(renderer, shown.camera, test_settings(240, 180), "light", 3);
    for (int receiver = 0; receiver <= 4; ++receiver) {
      ShadowMasks one = masks;
      int dark = 0;
      for (std::size_t i = 0; i < one.samples.size(); ++i) {
        if (one.samples[i].object != receiver) one.samples[i].object = -1;
        dark += one.samples[i].object == receiver && !one.is_truly_lit[i] ? 1 : 0;
      }
      if (dark > 100 && receiver != caster) pairs.insert({caster, receiver});
      const ShadowErrors errors = find_shadow_errors(one);
      EXPECT_EQ(errors.far_false_dark + errors.far_false_lit, 0)
          << caster << " on " << receiver << ": " << to_string(errors);
    }
  }
  for (const std::pair<int, int>& pair : {std::pair{1, 0}, {2, 0}, {3, 0}, {4, 0}, {1, 2}, {2, 3}}) {
    EXPECT_TRUE(pairs.contains(pair)) << pair.first << " on " << pair.second;
  }
}

// Row 104: textured surfaces that shade themselves.
TEST(Bentley, ATexturedTorusShadesItselfWithoutAcne) {
  for (const bool is_standing : {false, true}) {
    ShadowScene shown;
    const int ring = add_object(shown.scene, "torus", torus({0, 0, 0}, 1, 0.4F, 128));
    shown.scene.materials[0].base_color_texture.picture = add_picture(shown.scene, 64, 32, [](int x, int y) {
      return glm::u8vec3((x / 4 + y / 4) % 2 == 0 ? 230 : 90, 160, 4 * x);
    });
    if (is_standing) {
      glm::dmat4& m = shown.scene.nodes[static_cast<std::size_t>(ring)].parent_from_node;
      m[1] = {0, 0, 1, 0};
      m[2] = {0, -1, 0, 0};
    }
    add_light(shown.scene, spot("light", 35), {2.8, 1.2, 1.5}, {0, 0, 0});
    shown.camera = look({-0.5, 2.5, 4}, {0, 0, 0}, 40, 4.0 / 3);
    const Renderer renderer = make_renderer(shown.scene);
    const ShadowErrors errors = errors_of(renderer, shown.camera, "light", 400);
    SCOPED_TRACE(to_string(errors));
    EXPECT_EQ(errors.far_false_dark, 0) << "acne";
    EXPECT_GE(errors.edge_share(), 0.995);
    EXPECT_GT(errors.edge_pixels, 100);
    // The texture is there, in light and in shadow's ambient alike.
    RenderSettings settings = test_settings(100, 75);
    settings.layers = {Layer::albedo};
    const LayeredImage image = render(renderer, shown.camera, settings);
    std::set<float> reds;
    for (const float r : values_of(image, "albedo.R")) reds.insert(r);
    EXPECT_GT(reds.size(), 20U);
  }
}

// Row 105: the shadow buffers serve any eye point.
TEST(Bentley, TheBuffersServeAnyEyePoint) {
  ShadowScene shown = torus_and_box(1);
  add_light(shown.scene, sun("sun"), {-2, 5, 3}, {0, 0, 0});
  const Renderer renderer = make_renderer(shown.scene);
  int drawn = 0;
  int kept = 0;
  for (const glm::dvec3 eye :
       {glm::dvec3(4, 3, 3), glm::dvec3(-4, 2, 3), glm::dvec3(0, 6, 0.1), glm::dvec3(1, 1, -5)}) {
    RenderSettings settings = test_settings(96, 96);
    const View camera = look(eye, {0, 0.5, 0}, 45, 1);
    RenderStatistics statistics;
    const LayeredImage image = renderer.render(camera, settings, {}, &statistics).value();
    drawn += statistics.maps_drawn;
    kept += statistics.maps_kept;
    EXPECT_EQ(count_different_pixels(image, render(make_renderer(shown.scene), camera, settings)), 0U);
  }
  EXPECT_EQ(drawn, 2);
  EXPECT_EQ(kept, 6);
}

}  // namespace
}  // namespace laterna
