// Wikipedia, Shadow mapping (2010): light space, the depth map, what is drawn into it and when.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "laterna/measure.h"
#include "reference/bias_sweep.h"
#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"
#include "reference/shadow_scenes.h"

namespace laterna {
namespace {

using namespace reference;

// Row 74: a perspective view as wide as the light's cone, a "square spotlight".
TEST(WikipediaShadowMapping, TheSpotlightsViewHoldsItsCone) {
  for (const double half_angle : {5.0, 30.0, 45.0, 70.0}) {
    ShadowScene shown = torus_and_box(1);
    shown.scene.lights[0] = spot("light", half_angle);
    const Renderer renderer = make_renderer(shown.scene);
    const View view = renderer.light_view("light").value();
    EXPECT_FALSE(view.projection.is_orthographic);
    EXPECT_NEAR(view.projection.aspect(), 1, 1e-12);
    const double radians = Angle::degrees(half_angle).in_radians();
    double widest = 0;
    for (int i = 0; i < 360; ++i) {
      const double around = Angle::degrees(i).in_radians();
      const glm::dvec3 direction = std::cos(radians) * view.pose.forward_ws() +
                                   std::sin(radians) * (std::cos(around) * view.pose.right_ws() +
                                                        std::sin(around) * view.pose.up_ws());
      const glm::dvec4 q = view.image_from_world() * glm::dvec4(view.pose.position_ws + 7.0 * direction, 1);
      for (const double coordinate : {q.x / q.w, q.y / q.w}) {
        EXPECT_GT(coordinate, 0) << half_angle;
        EXPECT_LT(coordinate, 1) << half_angle;
        widest = std::max(widest, coordinate);
      }
    }
    EXPECT_GT(widest, 0.97) << "texels wasted on what the cone does not light";
  }
}

// Row 75: an orthographic view for a sun, fitted to the casters; the shadow on a plane is an affine image of the caster.
TEST(WikipediaShadowMapping, TheSunsShadowIsAnAffineImageOfTheCaster) {
  Scene scene;
  add_object(scene, "floor", floor(4));
  // A parallelogram in the air, no side along an axis.
  const glm::dvec3 corner(-0.6, 1.1, 0.4);
  const glm::dvec3 u(1.1, 0.4, -0.3);
  const glm::dvec3 v(0.2, 0.3, -1.2);
  Mesher mesh;
  mesh.quad(glm::vec3(corner), glm::vec3(corner + u), glm::vec3(corner + u + v), glm::vec3(corner + v));
  const int caster = add_object(scene, "caster", mesh.primitive);
  scene.nodes[static_cast<std::size_t>(caster)].visible = false;  // its shadow alone is seen
  const glm::dvec3 toward(2, 5, 1);
  add_light(scene, sun("light"), toward, {0, 0, 0});
  const Renderer renderer = make_renderer(std::move(scene));

  const View view = renderer.light_view("light").value();
  EXPECT_TRUE(view.projection.is_orthographic);
  for (const glm::dvec3 p :
       {corner, corner + u, corner + v, corner + u + v, glm::dvec3(-4, 0, -4), glm::dvec3(4, 0, 4)}) {
    const glm::dvec4 q = view.image_from_world() * glm::dvec4(p, 1);
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(q[k], 0);
      EXPECT_LE(q[k], 1);
    }
  }

  // Straight from above. A floor point p is dark where p + t · toward meets the parallelogram: solve for (s, r, t).
  const View above = {Pose::look_at({0, 8, 0}, {0, 0, 0}, {0, 0, -1}).value(),
                      Projection::orthographic(2, 2, 0, 10)};
  RenderSettings settings = test_settings(400, 400);
  settings.layers = {Layer::visibility};
  const LayeredImage image = render(renderer, above, settings);
  const glm::dmat3 solve = glm::inverse(glm::dmat3(u, v, -toward));
  int dark = 0;
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 400; ++x) {
      const glm::dvec3 p((x + 0.5) / 100 - 2, 0, (y + 0.5) / 100 - 2);
      const glm::dvec3 srt = solve * (p - corner);
      const double to_edge = std::min(std::min(srt.x, 1 - srt.x), std::min(srt.y, 1 - srt.y));
      if (std::abs(to_edge) < 0.01) continue;  // about a pixel
      ASSERT_EQ(at(image, "visibility.light", x, y), to_edge > 0 ? 0 : 1) << x << ", " << y;
      dark += to_edge > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(dark, 8000);
}

// Row 76: nothing is lit or coloured while a depth map is drawn.
TEST(WikipediaShadowMapping, DrawingADepthMapShadesNothing) {
  ShadowScene shown = torus_and_box(1);
  std::atomic<int> calls = 0;
  Light& light = shown.scene.lights[0];
  light.attenuation = Attenuation::custom;
  light.custom_attenuation = [&](float) {
    ++calls;
    return 1.0F;
  };
  const Renderer renderer = make_renderer(shown.scene);
  const LayeredImage map = renderer.depth_map("light").value();
  EXPECT_LT(at(map, "Z", map.width / 2, map.height / 2), 10);
  EXPECT_EQ(calls, 0);
  EXPECT_EQ(map.channels.size(), 1U);
  render(renderer, shown.camera, test_settings(64, 64));
  EXPECT_GT(calls, 64 * 64 / 2);
}

// Row 77: a map is drawn anew only when its light or a caster has changed.
TEST(WikipediaShadowMapping, MapsAreKeptWhileOnlyTheCameraMoves) {
  ShadowScene shown = torus_and_box(1);
  shown.scene.lights[0].shadow.resolution = 256;
  Renderer renderer = make_renderer(shown.scene);
  RenderSettings settings = test_settings(48, 48);
  int drawn = 0;
  const auto frame = [&](double angle, bool keeps) {
    settings.keep_shadow_maps = keeps;
    RenderStatistics statistics;
    const View camera = look({5 * std::sin(angle), 3, 5 * std::cos(angle)}, {0, 0.5, 0}, 40, 1);
    LayeredImage image = renderer.render(camera, settings, {}, &statistics).value();
    if (keeps) drawn += statistics.maps_drawn;
    return image;
  };
  for (int i = 0; i < 100; ++i) {
    const LayeredImage kept = frame(i * 0.06, true);
    if (i % 20 == 0) {
      EXPECT_EQ(count_different_pixels(kept, frame(i * 0.06, false)), 0U);
    }
  }
  EXPECT_EQ(drawn, 1);
  ASSERT_TRUE(renderer.set_transform(1, renderer.scene().nodes[2].parent_from_node));  // a caster
  const LayeredImage moved = frame(0, true);
  EXPECT_EQ(drawn, 2);
  EXPECT_EQ(count_different_pixels(moved, frame(0, false)), 0U);
  frame(1, true);
  EXPECT_EQ(drawn, 2);
  ASSERT_TRUE(
      renderer.set_transform(3, look({2, 6, 1}, {0, 0, 0}, 40, 1).pose.world_from_view()));  // the light
  const LayeredImage relit = frame(0, true);
  EXPECT_EQ(drawn, 3);
  EXPECT_EQ(count_different_pixels(relit, frame(0, false)), 0U);
}

// Row 78: one map per light, and what it costs.
TEST(WikipediaShadowMapping, TheMemoryReportListsEachLightsMaps) {
  ShadowScene shown = torus_and_box(1);
  shown.scene.lights[0].shadow.resolution = 512;
  Light lantern = projector("lantern", 0.4, 0.4);
  lantern.shadow.resolution = 1024;
  lantern.shadow.filter = ShadowFilter::bilinear;
  add_light(shown.scene, lantern, {0, 5, 2}, {0, 0, 0});
  Light bulb = spot("bulb", 30);
  bulb.type = LightType::point;
  bulb.shadow.resolution = 256;
  add_light(shown.scene, bulb, {0, 3, 3}, {0, 0, 0});
  Light fill = spot("fill", 40);
  fill.shadow.technique = ShadowTechnique::none;
  add_light(shown.scene, fill, {0, 3, -3}, {0, 0, 0});
  RenderStatistics statistics;
  ASSERT_TRUE(make_renderer(shown.scene).render(shown.camera, test_settings(16, 16), {}, &statistics));
  ASSERT_EQ(statistics.shadow_memory.size(), 3U);
  const auto& memory = statistics.shadow_memory;
  EXPECT_EQ(memory[0].light, "light");
  EXPECT_EQ(memory[0].maps, 1);
  EXPECT_EQ(memory[0].bytes, 512U * 512 * 8);  // depth and triangle of each texel
  EXPECT_EQ(memory[1].light, "lantern");
  EXPECT_EQ(memory[1].maps, 1);
  EXPECT_EQ(memory[1].bytes, 1024U * 1024 * 4);
  EXPECT_EQ(memory[2].light, "bulb");
  EXPECT_EQ(memory[2].maps, 6);
  EXPECT_GE(memory[2].bytes, 6U * 256 * 256 * 8);
  EXPECT_LT(memory[2].bytes, 6U * 384 * 384 * 8);
  EXPECT_EQ(statistics.maps_drawn, 8);
}

// Row 79: objects that do not cast still receive.
TEST(WikipediaShadowMapping, ObjectsThatDoNotCastStillReceive) {
  Scene scene;
  const int ground = add_object(scene, "floor", floor(3));
  const int low = add_object(scene, "low", box({0, 0.8F, 0}, {0.6F, 0.02F, 0.6F}));
  const int high = add_object(scene, "high", box({0, 1.6F, 0}, {0.3F, 0.02F, 0.3F}));
  add_light(scene, sun("light"), {0, 5, 0}, {0, 0, 0}, {0, 0, -1});
  // Where the light falls straight down: floor points beneath `low` alone and beneath both, a point on `low` beneath
  // `high`, each from its own side.
  const auto alpha = [&](glm::dvec3 eye, glm::dvec3 target) {
    RenderSettings settings = test_settings(9, 9);
    settings.layers = {Layer::visibility};
    return at(render(make_renderer(scene), look(eye, target, 1, 1), settings), "visibility.light", 4, 4);
  };
  const auto floor_under_low = [&] { return alpha({0.45, 0.4, 3}, {0.45, 0, 0.45}); };
  const auto floor_under_both = [&] { return alpha({0.1, 0.4, 3}, {0.1, 0, 0.1}); };
  const auto on_low = [&] { return alpha({0.1, 1.2, 3}, {0.1, 0.82, 0.1}); };
  EXPECT_EQ(floor_under_low(), 0);
  EXPECT_EQ(on_low(), 0);
  scene.nodes[static_cast<std::size_t>(ground)].casts_shadow = false;
  EXPECT_EQ(floor_under_low(), 0);  // also where nothing that casts is as far from the light
  scene.nodes[static_cast<std::size_t>(low)].casts_shadow = false;
  EXPECT_EQ(floor_under_low(), 1);
  EXPECT_EQ(floor_under_both(), 0);  // the other's
  EXPECT_EQ(on_low(), 0);            // it still receives
  scene.nodes[static_cast<std::size_t>(low)].receives_shadow = false;
  EXPECT_EQ(on_low(), 1);
  scene.nodes[static_cast<std::size_t>(high)].casts_shadow = false;
  EXPECT_EQ(floor_under_both(), 1);
}

// Row 80: an offset that grows with the slope.
TEST(WikipediaShadowMapping, SlopeScaledOffsetsTradeAcneForAGap) {
  int acne_before = 1 << 30;
  double gap_before = -1;
  BiasEffect last;
  int acne_at_zero = 0;
  for (const double slope : {0.0, 0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0}) {
    ShadowSettings settings;
    settings.slope_bias = slope;
    last = effect_of_bias(settings);
    EXPECT_LE(last.acne, acne_before) << slope;
    EXPECT_GE(last.gap_texels, gap_before) << slope;
    if (slope == 0) acne_at_zero = last.acne;
    acne_before = last.acne;
    gap_before = last.gap_texels;
    // Bilinear taps lie up to a texel beside the sample.
    if (slope >= 1) {
      EXPECT_EQ(last.acne, 0) << slope;
    }
  }
  EXPECT_GT(acne_at_zero, 3000);
  EXPECT_GT(last.gap_texels, 4);
  // Both together.
  ShadowSettings both;
  both.constant_bias = 0.005;
  both.slope_bias = 1.0;
  EXPECT_EQ(effect_of_bias(both).acne, 0);
}

// Row 81: only back faces in the map: closed meshes do not shade their lit sides at zero bias.
TEST(WikipediaShadowMapping, BackFacesAloneLeaveNoAcneOnClosedMeshesAtZeroBias) {
  const auto errors_with = [](CasterFaces faces) {
    ShadowScene shown = sphere_over_plane(1);
    // The floor is an open sheet: it only receives.
    shown.scene.nodes[0].casts_shadow = false;
    ShadowSettings& shadow = shown.scene.lights[0].shadow;
    shadow.filter = ShadowFilter::nearest;
    shadow.constant_bias = 0;
    shadow.resolution = 512;
    shadow.caster_faces = faces;
    ShadowMasks masks =
        draw_shadow_masks(make_renderer(shown.scene), shown.camera, test_settings(240, 240), "light", 1);
    // n·l beyond the texel-slope limit: where a texel covers less depth than the sphere is thick there. At n·l the sphere
    // of radius 1 is 2 n·l thick along the light, and a texel spans a footprint times the slope.
    for (ShadowSample& sample : masks.samples) {
      const double cosine = sample.footprint / std::hypot(sample.footprint, sample.depth_slope);
      if (sample.object == 1 && 2 * cosine <= sample.depth_slope + sample.footprint) sample.object = -1;
    }
    return find_shadow_errors(masks);
  };
  EXPECT_GT(errors_with(CasterFaces::both).far_false_dark, 1000);
  const ShadowErrors back = errors_with(CasterFaces::back_only);
  EXPECT_EQ(back.far_false_dark, 0) << to_string(back);
  EXPECT_EQ(back.far_false_lit, 0) << to_string(back);
}

// Row 81: open sheets are flagged.
TEST(WikipediaShadowMapping, OpenSheetsAreFlaggedWhereBackFacesAloneCast) {
  ShadowScene shown = torus_and_box(1);  // on a floor
  EXPECT_TRUE(make_renderer(shown.scene).scene().warnings.empty());
  shown.scene.lights[0].shadow.caster_faces = CasterFaces::back_only;
  const Renderer renderer = make_renderer(shown.scene);
  ASSERT_EQ(renderer.scene().warnings.size(), 1U);
  EXPECT_EQ(
      renderer.scene().warnings[0].message,
      "mesh \"floor\" is not closed: light \"light\" draws only back faces into its shadow map, and where it "
      "falls on the mesh's front there is no shadow");
  shown.scene.nodes[0].casts_shadow = false;
  EXPECT_TRUE(make_renderer(shown.scene).scene().warnings.empty());
}

// Row 82: the map's own matrix and a homogeneous divide lead back to the texel that saw a point.
TEST(WikipediaShadowMapping, LightSpaceCoordinatesLeadToTheTexelThatSawThePoint) {
  for (const LightType type : {LightType::spot, LightType::directional, LightType::projector}) {
    ShadowScene shown = torus_and_box(4.0 / 3);
    shown.scene.lights[0].type = type;
    const Renderer renderer = make_renderer(shown.scene);
    RenderSettings settings = test_settings(200, 150);
    settings.shadows = ShadowTechnique::raytraced;
    settings.layers = {Layer::visibility, Layer::position, Layer::object};
    const LayeredImage image = render(renderer, shown.camera, settings);
    const LayeredImage map = renderer.depth_map("light").value();
    const View view = renderer.light_view("light").value();
    int lit = 0;
    int agree = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        if (at(image, "id.object", x, y) != 0 || at(image, "visibility.light", x, y) != 1) continue;
        const glm::dvec4 world(at(image, "P.X", x, y), at(image, "P.Y", x, y), at(image, "P.Z", x, y), 1);
        const glm::dvec4 q = view.image_from_world() * world;
        const double s = q.x / q.w;
        const double t = q.y / q.w;
        if (s < 0 || t < 0 || s >= 1 || t >= 1) continue;
        const double distance = -(view.view_from_world() * world).z;
        const float stored = at(map, "Z", static_cast<int>(s * map.width), static_cast<int>(t * map.height));
        ++lit;
        agree += std::abs(stored - distance) < 0.01 ? 1 : 0;  // a floor: less than a texel's slope
      }
    }
    EXPECT_GT(lit, 3000);
    EXPECT_GT(agree, 0.995 * lit);  // all but texels that straddle an edge
  }
}

// Row 83: scale and bias folded into the matrix or applied after the divide, depth in [−1, 1] or [0, 1].
TEST(WikipediaShadowMapping, ScaleAndBiasGiveTheSameCoordinatesFoldedOrNot) {
  std::mt19937 random(83);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  const Pose pose = Pose::look_at({1, 4, 3}, {0, 0, 0}, {0, 1, 0}).value();
  for (const Projection& projection :
       {Projection::perspective(Angle::degrees(60), 1.5, 0.1, 50), Projection::orthographic(3, 2, 1, 20)}) {
    const View view = {pose, projection};
    glm::dmat4 zero_to_one(1.0);  // clip depth [0, w] from [−w, w]
    zero_to_one[2][2] = 0.5;
    zero_to_one[3][2] = 0.5;
    glm::dmat4 bias_of_zero_to_one = image_from_clip();  // leaves depth as it is
    bias_of_zero_to_one[2][2] = 1;
    bias_of_zero_to_one[3][2] = 0;
    for (int i = 0; i < 200; ++i) {
      const glm::dvec4 world(coordinate(random), coordinate(random), coordinate(random), 1);
      const glm::dvec4 clip = view.clip_from_world() * world;
      const glm::dvec3 ndc = glm::dvec3(clip) / clip.w;
      const glm::dvec3 unfolded = {0.5 * ndc.x + 0.5, 0.5 - 0.5 * ndc.y,
                                   0.5 * ndc.z + 0.5};  // row 0 is the top
      const glm::dvec4 q = view.image_from_world() * world;
      EXPECT_LT(glm::distance(glm::dvec3(q) / q.w, unfolded), 1e-12);
      const glm::dvec4 other = bias_of_zero_to_one * (zero_to_one * view.clip_from_world()) * world;
      EXPECT_LT(glm::distance(glm::dvec3(other) / other.w, unfolded), 1e-12);
    }
  }
}

}  // namespace
}  // namespace laterna
