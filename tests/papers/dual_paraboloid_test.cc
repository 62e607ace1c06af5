// Dual paraboloid shadow maps: Brabec, Annen and Seidel, Shadow mapping for hemispherical and omnidirectional light sources,
// 2002.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "reference/picture_probes.h"
#include "reference/shadow_scenes.h"
#include "reference/shadow_truth.h"
#include "shadow/paraboloid_map.h"

namespace laterna {
namespace {

using namespace reference;
using shadow::ParaboloidPair;

glm::dvec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

// ---------------------------------------------------------------------------------------------- the projection

// (x, y) / (1 + z): the axis is in the middle, the equator on the unit circle, 60° off the axis at tan 30°.
TEST(DualParaboloid, DirectionsLieWhereTheMirrorShowsThem) {
  const ParaboloidPair pair(Pose{}, 100, 3);
  EXPECT_EQ(pair.side(), 106);
  const auto expect_at = [&](const glm::dvec3& local, int map, double x, double y) {
    EXPECT_EQ(ParaboloidPair::map_of(local), map);
    const glm::dvec2 texel = pair.texel_of(local, map);
    EXPECT_NEAR(texel.x, 53 + 50 * x, 1e-9);
    EXPECT_NEAR(texel.y, 53 + 50 * y, 1e-9);
  };
  expect_at({0, 0, 1}, 0, 0, 0);
  expect_at({0, 0, -1}, 1, 0, 0);
  expect_at({1, 0, 0}, 0, 1, 0);
  expect_at({0, -1, 0}, 0, 0, -1);
  const double s = std::sqrt(3.0) / 2;
  expect_at({s, 0, 0.5}, 0, 1 / std::sqrt(3.0), 0);
  expect_at({0, s, -0.5}, 1, 0, 1 / std::sqrt(3.0));
  EXPECT_NEAR(pair.texel_angle({0, 0, 1}), 0.04, 1e-12);
  EXPECT_NEAR(pair.texel_angle({1, 0, 0}), 0.02, 1e-12) << "texels at the rim are half as wide";
}

TEST(DualParaboloid, TexelsAndDirectionsAreInverse) {
  const ParaboloidPair pair(Pose{}, 64, 2);
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const glm::dvec3 way = random_direction(random);
    const int map = ParaboloidPair::map_of(way);
    EXPECT_LT(glm::distance(pair.direction_of(pair.texel_of(way, map), map), way), 1e-12);
  }
}

TEST(DualParaboloid, BoundsHoldEveryTexelOfACone) {
  const ParaboloidPair pair(Pose{}, 40, 2);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> cosines(0.0, 1.0);
  int bounded = 0;
  for (int i = 0; i < 400; ++i) {
    const glm::dvec3 axis = random_direction(random);
    const double cosine = 1 - std::pow(cosines(random), 3);
    for (int map = 0; map < 2; ++map) {
      const ParaboloidPair::Texels texels = pair.find_cone(axis, cosine, map);
      bounded += texels.is_empty() || texels.x_end - texels.x_first < pair.side() ? 1 : 0;
      for (int y = 0; y < pair.side(); ++y) {
        for (int x = 0; x < pair.side(); ++x) {
          if (glm::dot(pair.direction_of({x + 0.5, y + 0.5}, map), axis) < cosine) continue;
          const bool is_in =
              x >= texels.x_first && x < texels.x_end && y >= texels.y_first && y < texels.y_end;
          ASSERT_TRUE(is_in) << i << " " << map << " " << x << " " << y;
        }
      }
    }
  }
  EXPECT_GT(bounded, 300) << "and are of use";
}

// ---------------------------------------------------------------------------------------------- scenes

Light bulb() {
  Light light;
  light.name = "light";
  light.type = LightType::point;
  light.intensity = 50;
  light.shadow.layout = ShadowLayout::dual_paraboloid;
  return light;
}

// The torus and the box about a bulb; the maps' seam, the plane z = 0.3, runs through both.
ShadowScene under_a_bulb(const ShadowSettings& settings) {
  ShadowScene shown;
  add_object(shown.scene, "floor", floor(4));
  add_object(shown.scene, "box", box({1.2F, 0.5F, 0.3F}, {0.4F, 0.5F, 0.4F}));
  add_object(shown.scene, "torus", torus({-0.4F, 0.6F, 0.2F}, 0.6F, 0.15F, 64));
  add_object(shown.scene, "wall", wall(4, 4, -2));
  Light light = bulb();
  light.shadow = settings;
  add_light(shown.scene, light, {0.1, 2.2, 0.3}, {0.1, 2.2, -1});
  shown.camera = look({-1.5, 2.4, 4.5}, {0.2, 0.5, 0}, 50, 4.0 / 3);
  return shown;
}

ShadowScene lit_floor(const ShadowSettings& settings) {
  ShadowScene shown;
  add_object(shown.scene, "floor", floor(400));
  Light light = bulb();
  light.shadow = settings;
  add_light(shown.scene, light, {0.1, 1.1, 0.3}, {0.1, 1.1, -1});
  shown.camera = look({-1.5, 4.4, 5.5}, {0.2, 0, -1}, 50, 4.0 / 3);
  return shown;
}

ShadowErrors errors_of(const ShadowScene& shown) {
  return find_shadow_errors(
      draw_shadow_masks(make_renderer(shown.scene), shown.camera, test_settings(320, 240), "light", 3));
}

LayeredImage draw_visibility(const ShadowScene& shown, RenderSettings settings, int threads = 0,
                             std::optional<InstructionSet> set = {}) {
  settings.layers = {Layer::visibility};
  return render(make_renderer(shown.scene, threads, set), shown.camera, settings);
}

std::size_t count_below(const LayeredImage& image, double least) {
  std::size_t count = 0;
  for (const float alpha : values_of(image, "visibility.light")) count += alpha < least ? 1 : 0;
  return count;
}

// ---------------------------------------------------------------------------------------------- against the truth

TEST(DualParaboloid, SharpShadowsAreThoseOfRays) {
  const ShadowScene shown = under_a_bulb(bulb().shadow);
  const ShadowErrors errors = errors_of(shown);
  SCOPED_TRACE(to_string(errors));
  EXPECT_GT(errors.edge_pixels, 300);
  EXPECT_LT(errors.wrong_share(), 0.0005);
}

// Most of the sphere's triangles are smaller than texels: those at its outline are found as neighbours of what texels saw.
TEST(DualParaboloid, FineMeshesThrowSmoothShadows) {
  ShadowScene shown;
  add_object(shown.scene, "floor", floor(4));
  add_object(shown.scene, "sphere", sphere({0.3F, 1, 0.2F}, 0.5F, 128));
  Light light = bulb();
  light.shadow.resolution = 256;
  add_light(shown.scene, light, {0.1, 2.5, 0.3}, {0.1, 2.5, -1});
  shown.camera = look({-1.5, 3.4, 4.5}, {0.2, 0.3, 0}, 35, 4.0 / 3);
  const ShadowErrors errors = errors_of(shown);
  SCOPED_TRACE(to_string(errors));
  EXPECT_GT(errors.edge_pixels, 300);
  EXPECT_LT(errors.wrong_share(), 0.0005);
}

TEST(DualParaboloid, ThereIsNeitherAcneNorALeak) {
  const ShadowScene shown = under_a_bulb(bulb().shadow);
  const ShadowErrors errors = errors_of(shown);
  SCOPED_TRACE(to_string(errors));
  EXPECT_EQ(errors.far_false_dark, 0) << "acne";
  EXPECT_EQ(errors.far_false_lit, 0) << "leaks";
  EXPECT_GT(errors.edge_pixels, 300);
}

// Plain filters are as wrong at edges as the cube's, within what texels of other sizes make.
TEST(DualParaboloid, PlainFiltersAreNoWorseThanTheCubes) {
  for (const ShadowFilter filter :
       {ShadowFilter::nearest, ShadowFilter::bilinear, ShadowFilter::percentage_closer}) {
    ShadowSettings settings = bulb().shadow;
    settings.filter = filter;
    const auto wrong = [&](ShadowLayout layout) {
      settings.layout = layout;
      const ShadowErrors errors = errors_of(under_a_bulb(settings));
      const bool is_new = layout == ShadowLayout::dual_paraboloid;
      EXPECT_TRUE(!is_new || errors.far_false_dark + errors.far_false_lit == 0) << to_string(errors);
      return errors.wrong_share();
    };
    const double cube = wrong(ShadowLayout::cube);
    EXPECT_LE(wrong(ShadowLayout::dual_paraboloid), 1.5 * cube) << static_cast<int>(filter);
  }
}

// A floor that the seam runs across, and nothing else: any dark pixel is acne, or the seam.
TEST(DualParaboloid, TheSeamIsNotSeen) {
  for (const ShadowFilter filter : {ShadowFilter::refined, ShadowFilter::nearest, ShadowFilter::bilinear,
                                    ShadowFilter::percentage_closer}) {
    for (const int resolution : {64, 512}) {
      ShadowSettings settings = bulb().shadow;
      settings.filter = filter;
      settings.resolution = resolution;
      settings.kernel = filter == ShadowFilter::percentage_closer ? 9 : 3;
      const LayeredImage image = draw_visibility(lit_floor(settings), test_settings(320, 240));
      EXPECT_EQ(count_below(image, 1), 0U) << static_cast<int>(filter) << ", " << resolution;
    }
  }
}

// A roof under the bulb darkens the floor on both sides of the seam: no lit line parts them.
TEST(DualParaboloid, NoLightComesThroughTheSeam) {
  for (const ShadowFilter filter : {ShadowFilter::refined, ShadowFilter::nearest, ShadowFilter::bilinear}) {
    ShadowScene shown;
    add_object(shown.scene, "floor", floor(4));
    add_object(shown.scene, "roof", floor(1, 1));
    Light light = bulb();
    light.shadow.filter = filter;
    light.shadow.resolution = 256;
    add_light(shown.scene, light, {0, 2, 0}, {0, 2, -1});
    shown.camera = look({0, 0.5, 1.5}, {0, 0, 0}, 20, 4.0 / 3);
    const LayeredImage image = draw_visibility(shown, test_settings(160, 120));
    for (const float alpha : values_of(image, "visibility.light"))
      ASSERT_EQ(alpha, 0) << static_cast<int>(filter);
  }
}

TEST(DualParaboloid, HolesOfCutOutsLetLightThrough) {
  ShadowScene shown = poles_and_leaves(4.0 / 3);
  for (Light& light : shown.scene.lights) {
    light.type = LightType::point;
    light.shadow.layout = ShadowLayout::dual_paraboloid;
  }
  const ShadowErrors errors = errors_of(shown);
  SCOPED_TRACE(to_string(errors));
  EXPECT_GT(errors.edge_pixels, 300);
  EXPECT_LT(errors.wrong_share(), 0.01);
}

TEST(DualParaboloid, BackFacesAloneDarkenWhatIsBehindThem) {
  ShadowSettings settings = bulb().shadow;
  settings.caster_faces = CasterFaces::back_only;
  const ShadowScene shown = under_a_bulb(settings);
  const ShadowErrors errors = errors_of(shown);
  SCOPED_TRACE(to_string(errors));
  EXPECT_GT(errors.edge_pixels, 300);
  EXPECT_LT(errors.wrong_share(), 0.01);
}

TEST(DualParaboloid, WideSpotsHaveThemToo) {
  ShadowScene shown = under_a_bulb(bulb().shadow);
  shown.scene.lights[0].type = LightType::spot;
  shown.scene.lights[0].outer_cone = Angle::degrees(85);
  shown.scene.lights[0].inner_cone = Angle::degrees(80);
  const ShadowErrors errors = errors_of(shown);
  SCOPED_TRACE(to_string(errors));
  EXPECT_GT(errors.edge_pixels, 300);
  EXPECT_LT(errors.wrong_share(), 0.0005);
}

TEST(DualParaboloid, ThreadsAndInstructionSetsGiveTheSameBits) {
  for (const ShadowFilter filter : {ShadowFilter::refined, ShadowFilter::percentage_closer}) {
    ShadowSettings settings = bulb().shadow;
    settings.filter = filter;
    const ShadowScene shown = under_a_bulb(settings);
    const LayeredImage first = draw_visibility(shown, test_settings(160, 120), 1, InstructionSet::scalar);
    EXPECT_GT(count_below(first, 0.5), 500U);
    for (const InstructionSet set : supported_instruction_sets()) {
      for (const int threads : {1, 3}) {
        const LayeredImage other = draw_visibility(shown, test_settings(160, 120), threads, set);
        EXPECT_EQ(count_different_pixels(first, other), 0U) << name_of(set) << ", " << threads << " threads";
      }
    }
  }
}

// ---------------------------------------------------------------------------------------------- where there are none

TEST(DualParaboloid, OnlyLightsThatShineAllRoundHaveThem) {
  Scene scene = under_a_bulb(bulb().shadow).scene;
  EXPECT_TRUE(validate(scene).empty());
  scene.lights[0].type = LightType::spot;
  scene.lights[0].outer_cone = Angle::degrees(75);
  std::vector<Diagnostic> faults = validate(scene);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].place, "lights[0].shadow.layout");
  EXPECT_EQ(
      faults[0].message,
      "only point lights and spots wider than 150 degrees have maps of all directions: others have one map");
  scene.lights[0].outer_cone = Angle::degrees(75.5);
  EXPECT_TRUE(validate(scene).empty());
  scene.lights[0].shadow.filter = ShadowFilter::averaged_depths;
  faults = validate(scene);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].message,
            "\"averaged_depths\" means depths along one axis, and these maps have none: use \"cube\"");
}

}  // namespace
}  // namespace laterna
