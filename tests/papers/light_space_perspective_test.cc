// Row 93 of the papers' list, warped shadow maps: Wimmer, Scherzer and Purgathofer, Light space perspective shadow maps,
// 2004.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "reference/everything.h"
#include "reference/picture_probes.h"
#include "reference/shadow_scenes.h"

namespace laterna {
namespace {

using namespace reference;

struct Street {
  Scene scene;
  View camera;
};

// Boxes on both sides of a street of flagstones, in the sun, seen from its beginning.
Street street(const ShadowSettings& settings, const glm::dvec3& toward_sun = {3, 4, 2}) {
  Street made;
  for (int i = 0; i < 12; ++i) {
    for (int j = -6; j < 6; ++j) {
      const float x = 10.0F * static_cast<float>(j), z = -10.0F * static_cast<float>(i);
      Mesher flagstone;
      flagstone.quad({x, 0, z + 10}, {x + 10, 0, z + 10}, {x + 10, 0, z}, {x, 0, z});
      add_object(made.scene, "stone", flagstone.primitive);
    }
  }
  for (float z = 3; z < 110; z *= 1.35F) {
    const float size = 0.03F * z;
    add_object(made.scene, "left", box({-3 * size, 3 * size, -z}, {size, 3 * size, size}));
    add_object(made.scene, "right", box({4 * size, 2 * size, -z}, {size, 2 * size, size}));
  }
  Light light = sun("light");
  light.shadow = settings;
  add_light(made.scene, light, toward_sun, {0, 0, 0});
  made.camera = look({0, 1.7, 0}, {0, 0.5, -10}, 50, 4.0 / 3);
  return made;
}

ShadowSettings warped(ShadowFilter filter = ShadowFilter::refined) {
  ShadowSettings settings;
  settings.warp = ShadowWarp::light_space_perspective;
  settings.resolution = 512;
  settings.filter = filter;
  return settings;
}

RenderSettings wanted() {
  RenderSettings settings = test_settings(320, 240);
  settings.layers = {Layer::visibility};
  return settings;
}

// Row 93: light stays parallel, and texels are finer toward the camera.
TEST(LightSpacePerspective, KeepsLightParallelAndTexelsFineNearTheCamera) {
  const Street made = street(warped());
  const Renderer renderer = make_renderer(made.scene);
  const ShadowMapView map = renderer.shadow_map_views("light", made.camera, wanted()).value().at(0);
  const glm::dvec3 toward = glm::normalize(glm::dvec3(3, 4, 2));
  const auto texel_at = [&](const glm::dvec3& point) {
    const glm::dvec4 q = map.image_from_world * glm::dvec4(point, 1);
    EXPECT_GT(q.w, 0);
    return glm::dvec3(q) / q.w * glm::dvec3(map.width, map.height, 1);
  };
  double finest = 0, coarsest = 1e9;
  for (const double z : {-4.0, -10.0, -30.0, -100.0}) {
    const glm::dvec3 point(0.02 * z, 0, z);
    const glm::dvec3 here = texel_at(point), nearer = texel_at(point + 5.0 * toward);
    EXPECT_NEAR(here.x, nearer.x, 1e-6);
    EXPECT_NEAR(here.y, nearer.y, 1e-6);
    EXPECT_GT(here.z, nearer.z) << "depth grows away from the light";
    for (const double s : {here.x, here.y}) {
      EXPECT_GT(s, 0);
      EXPECT_LT(s, 512);
    }
    const double texels_per_metre = glm::length(texel_at(point + glm::dvec3(0.01, 0, 0)) - here) / 0.01;
    EXPECT_LT(texels_per_metre, coarsest) << "at " << z;
    finest = std::max(finest, texels_per_metre);
    coarsest = texels_per_metre;
  }
  EXPECT_GT(finest, 3 * coarsest);
}

int count_wrong(const LayeredImage& image, const LayeredImage& truth) {
  const auto a = values_of(image, "visibility.light"), b = values_of(truth, "visibility.light");
  int wrong = 0;
  for (std::size_t i = 0; i < a.size(); ++i) wrong += (a[i] >= 0.5F) != (b[i] >= 0.5F) ? 1 : 0;
  return wrong;
}

TEST(LightSpacePerspective, IsNearerToTheTruthThanAnUnwarpedMapOfTheSameSize) {
  RenderSettings rays = wanted();
  rays.shadows = ShadowTechnique::raytraced;
  for (const glm::dvec3 toward : {glm::dvec3(3, 4, 2), glm::dvec3(-4, 3, -3), glm::dvec3(1, 6, 5)}) {
    const Street made = street({}, toward);
    const LayeredImage truth = render(make_renderer(made.scene), made.camera, rays);
    for (const ShadowFilter filter : {ShadowFilter::refined, ShadowFilter::bilinear}) {
      ShadowSettings plain = warped(filter);
      plain.warp = ShadowWarp::none;
      const int without =
          count_wrong(render(make_renderer(street(plain, toward).scene), made.camera, wanted()), truth);
      const int with = count_wrong(
          render(make_renderer(street(warped(filter), toward).scene), made.camera, wanted()), truth);
      EXPECT_LT(2 * with, without) << "filter " << static_cast<int>(filter) << " sun " << toward.x;
      // The refined filter finds what texels missed through its neighbours: a few pixels are left to better.
      EXPECT_GT(without, filter == ShadowFilter::refined ? 3 : 100);
    }
  }
}

// The receiver's plane is a plane of the warped world too: nothing shades itself.
TEST(LightSpacePerspective, NothingShadesItself) {
  for (const ShadowFilter filter : {ShadowFilter::refined, ShadowFilter::nearest, ShadowFilter::bilinear,
                                    ShadowFilter::percentage_closer}) {
    for (const glm::dvec3 toward : {glm::dvec3(3, 4, 2), glm::dvec3(0.3, 0.4, -5), glm::dvec3(0, 1, 8)}) {
      Scene scene;
      add_object(scene, "floor", floor(30));
      Light light = sun("light");
      light.shadow = warped(filter);
      add_light(scene, light, toward, {0, 0, 0});
      const LayeredImage image =
          render(make_renderer(std::move(scene)), look({1, 3, 12}, {0, 0, 0}, 50, 4.0 / 3), wanted());
      int lit = 0, dark = 0;
      const auto alpha = values_of(image, "visibility.light"), seen = values_of(image, "A");
      for (std::size_t i = 0; i < alpha.size(); ++i) {
        if (seen[i] == 0) continue;
        ++(alpha[i] == 1 ? lit : dark);
      }
      EXPECT_EQ(dark, 0) << "filter " << static_cast<int>(filter) << " sun " << toward.z;
      EXPECT_GT(lit, 30000);
    }
  }
}

// Cut-outs are cut where their holes are in the world.
TEST(LightSpacePerspective, LeavesCastShadowsOfLeaves) {
  ShadowScene shown = poles_and_leaves(4.0 / 3);
  RenderSettings rays = wanted();
  rays.shadows = ShadowTechnique::raytraced;
  const LayeredImage truth = render(make_renderer(shown.scene), shown.camera, rays);
  shown.scene.lights[0].shadow.resolution = 1024;
  const int without = count_wrong(render(make_renderer(shown.scene), shown.camera, wanted()), truth);
  shown.scene.lights[0].shadow.warp = ShadowWarp::light_space_perspective;
  const int with = count_wrong(render(make_renderer(shown.scene), shown.camera, wanted()), truth);
  EXPECT_LE(with, without + 20);
  EXPECT_LT(with, 320 * 240 / 100);
}

TEST(LightSpacePerspective, IsTheSameForAnyThreadsAndInstructionSet) {
  const Street made = street(warped());
  const LayeredImage expected = render(make_renderer(made.scene, 1), made.camera, wanted());
  EXPECT_TRUE(same_bits(expected, render(make_renderer(made.scene, 5), made.camera, wanted())));
  for (const InstructionSet set : supported_instruction_sets())
    EXPECT_TRUE(same_bits(expected, render(make_renderer(made.scene, 1, set), made.camera, wanted())))
        << name_of(set);
}

// With the sun in the camera's back or face there is no perspective to be had: a plain map of what is seen.
TEST(LightSpacePerspective, GivesWayToAPlainMapWhereTheSunIsAlongTheGaze) {
  for (const double sign : {1.0, -1.0}) {
    Scene scene;
    add_object(scene, "floor", floor(6));
    add_object(scene, "box", box({0, 1, 0}, {0.5F, 0.5F, 0.5F}));
    const View camera = look({0, 5, 4}, {0, 0, 0}, 50, 4.0 / 3);
    Light light = sun("light");
    light.shadow = warped();
    add_light(scene, light, sign * glm::dvec3(0, 5, 4), {0, 0, 0});
    RenderSettings rays = wanted();
    rays.shadows = ShadowTechnique::raytraced;
    const LayeredImage image = render(make_renderer(scene), camera, wanted());
    scene.lights[0].shadow = {};
    EXPECT_LT(count_wrong(image, render(make_renderer(scene), camera, rays)), 60) << sign;
  }
}

TEST(LightSpacePerspective, IsRefusedToOtherLightsAndTechniques) {
  Light lamp = spot("lamp", 30);
  EXPECT_EQ(find_fault(ShadowWarp::none, lamp), "");
  EXPECT_NE(find_fault(ShadowWarp::light_space_perspective, lamp), "");
  Light light = sun("light");
  EXPECT_EQ(find_fault(ShadowWarp::light_space_perspective, light), "");
  light.shadow.technique = ShadowTechnique::cascades;
  EXPECT_NE(find_fault(ShadowWarp::light_space_perspective, light), "");
  lamp.shadow.warp = ShadowWarp::light_space_perspective;
  Scene scene;
  add_light(scene, lamp, {0, 3, 0}, {0, 0, 0}, {0, 0, 1});
  const std::vector<Diagnostic> faults = validate(scene);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(
      to_string(faults[0]),
      "lights[0].shadow.warp: only the map of a directional light that is fitted to the scene can be warped");
}

}  // namespace
}  // namespace laterna
