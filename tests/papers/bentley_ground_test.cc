// Bentley, A comparison of shadow algorithms, WPI 1995: the ground transformation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "light/floor.h"
#include "light/ground_transformation.h"
#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"
#include "reference/shadow_scenes.h"

namespace laterna {
namespace {

using namespace reference;

const ShadowPlane kGround = {{0, 0, 1}, 0};  // the paper's z = 0

glm::dvec3 shadow_of(const ShadowPlane& plane, const glm::dvec4& light, const glm::dvec3& point) {
  const glm::dvec4 p =
      light::ground_transformation(light::plane_equation(plane), light) * glm::dvec4(point, 1);
  return glm::dvec3(p) / p.w;
}

void expect_point(const glm::dvec3& point, const glm::dvec3& expected, double tolerance = 1e-12) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(point[k], expected[k], tolerance) << k;
}

// Row 94.
TEST(GroundTransformation, LightAtInfinity) {
  expect_point(shadow_of(kGround, {1, 2, 4, 0}, {2, 0, 1}), {1.75, -0.5, 0});
}

// Row 95. The text's fragment sets only one entry, which makes the matrix of a light at infinity: that gives row 94.
TEST(GroundTransformation, LocalLight) {
  expect_point(shadow_of(kGround, {1, 2, 4, 1}, {2, 0, 1}), {7.0 / 3, -2.0 / 3, 0});
  const glm::dmat4 local = light::ground_transformation(light::plane_equation(kGround), {1, 2, 4, 1});
  const glm::dmat4 infinite = light::ground_transformation(light::plane_equation(kGround), {1, 2, 4, 0});
  EXPECT_EQ(local[2][3], -1) << "the entry that the text leaves out";
  EXPECT_EQ(infinite[2][3], 0);
}

// Row 96: any plane is the same as turning the scene until it is z = 0.
TEST(GroundTransformation, AnyPlaneIsTheSameAsRotatingTheScene) {
  std::mt19937 random(96);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 100; ++i) {
    const glm::dmat4 turn = glm::translate(glm::dmat4(1), {any(random), any(random), any(random)}) *
                            glm::rotate(glm::dmat4(1), 3 * any(random),
                                        glm::normalize(glm::dvec3(any(random), any(random), 1.5)));
    const glm::dvec3 normal(turn * glm::dvec4(0, 0, 1, 0));
    // A plane's normal may have any length.
    const ShadowPlane plane = {3.0 * normal, glm::dot(normal, glm::dvec3(turn[3]))};
    const glm::dvec3 point(any(random), any(random), 1 + any(random));
    for (const double w : {0.0, 1.0}) {
      const glm::dvec4 light(any(random), any(random), 4 + any(random), w);
      const glm::dvec3 flat = shadow_of(kGround, light, point);
      EXPECT_NEAR(flat.z, 0, 1e-12);
      expect_point(shadow_of(plane, turn * light, glm::dvec3(turn * glm::dvec4(point, 1))),
                   glm::dvec3(turn * glm::dvec4(flat, 1)), 1e-9);
    }
  }
}

// ---------------------------------------------------------------------------------------------- in pictures

struct FloorMismatch {
  int counted = 0, dark = 0, different = 0;
};

// Pixels of an object on which the technique and rays differ.
FloorMismatch mismatch_on(const Renderer& renderer, const View& camera, int object, const std::string& light,
                          ShadowTechnique technique = ShadowTechnique::ground) {
  RenderSettings settings = test_settings(320, 240);
  settings.layers = {Layer::visibility, Layer::object};
  settings.shadows = technique;
  const LayeredImage image = render(renderer, camera, settings);
  settings.shadows = ShadowTechnique::raytraced;
  const LayeredImage truth = render(renderer, camera, settings);
  FloorMismatch found;
  const std::span<const float> objects = values_of(image, "id.object");
  const std::span<const float> alpha = values_of(image, "visibility." + light);
  const std::span<const float> true_alpha = values_of(truth, "visibility." + light);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i] != static_cast<float>(object)) continue;
    ++found.counted;
    found.dark += alpha[i] == 0 ? 1 : 0;
    found.different += alpha[i] != true_alpha[i] ? 1 : 0;
    EXPECT_TRUE(alpha[i] == 0 || alpha[i] == 1);
  }
  return found;
}

// Rays and edges are rounded differently: a pixel in ten thousand may lie on an edge.
void expect_truth_on(const Renderer& renderer, const View& camera, int object, const std::string& light) {
  const FloorMismatch found = mismatch_on(renderer, camera, object, light);
  EXPECT_GT(found.dark, 300) << light;
  EXPECT_LE(found.different, found.counted / 10000) << light << ", of " << found.counted;
}

Scene bodies_over_floor() {
  Scene scene;
  add_object(scene, "floor", floor(4));
  add_object(scene, "box", box({0.8F, 0.5F, 0}, {0.3F, 0.5F, 0.3F}));
  add_object(scene, "ball", sphere({-0.6F, 0.9F, 0.2F}, 0.4F, 32));
  add_object(scene, "ring", torus({0, 1.6F, 0.4F}, 0.5F, 0.12F, 32));
  return scene;
}

const View kCamera = look({0.5, 4, 6}, {0, 0.3, 0}, 45, 4.0 / 3);

Light lamp(const std::string& name) {
  Light light = spot(name, 30);
  light.type = LightType::point;
  return light;
}

// Row 96: every kind of light; overlapping polygons darken once; only what lies on the plane is shaded.
TEST(GroundShadow, IsTheTruthOnTheFloorForEveryKindOfLight) {
  Scene scene = bodies_over_floor();
  add_light(scene, sun("sun"), {-2, 5, 3}, {0, 0, 0});
  add_light(scene, lamp("lamp"), {1.5, 4, 1}, {0, 0, 0});
  add_light(scene, spot("spot", 40), {-2, 4, -2}, {0, 0, 0});
  add_light(scene, projector("lantern", 0.6, 0.6), {3, 4, 2}, {0, 0.4, 0});
  const Renderer renderer = make_renderer(std::move(scene));
  for (const char* light : {"sun", "lamp", "spot", "lantern"}) {
    SCOPED_TRACE(light);
    expect_truth_on(renderer, kCamera, 0, light);
    for (int body = 1; body <= 3; ++body)
      EXPECT_EQ(mismatch_on(renderer, kCamera, body, light).dark, 0) << "objects do not shade each other";
  }
}

TEST(GroundShadow, DarkensAPixelOnceWhateverLiesOverIt) {
  // Ten sheets, one over the other: see-through black of one half is a half, not a 1024th.
  Scene scene;
  add_object(scene, "floor", floor(4));
  for (int i = 0; i < 10; ++i)
    add_object(scene, "sheet " + std::to_string(i), floor(0.5F, 0.5F + 0.1F * static_cast<float>(i)));
  Light light = sun("sun");
  light.shadow.opacity = 0.5F;
  light.shadow.technique = ShadowTechnique::ground;
  add_light(scene, light, {0, 5, 0}, {0, 0, 0}, {0, 0, -1});
  for (std::size_t i = 1; i <= 10; ++i) scene.nodes[i].visible = false;
  const Renderer renderer = make_renderer(std::move(scene));
  RenderSettings settings = papers_settings(64, 64);
  settings.layers = {Layer::light};
  const LayeredImage image = render(renderer, look({0, 5, 0}, {0, 0, 0}, 40, 1, {0, 0, -1}), settings);
  const float shaded = at(image, "light.sun.R", 32, 32);
  EXPECT_GT(shaded, 0);
  EXPECT_NEAR(shaded, 0.5F * at(image, "light.sun.R", 3, 3), 1e-6);
}

// Row 96: planes by name, in any position; the floor is no plane then.
TEST(GroundShadow, FallsOnEveryPlaneThatIsNamed) {
  Scene scene = bodies_over_floor();
  add_object(scene, "wall", wall(4, 3, -1.5F));
  // A board that leans on nothing, below all else: x + y = −2.
  Mesher board;
  board.quad({-4, 2, 1}, {-3, 1, 1}, {-3, 1, -1}, {-4, 2, -1});
  const int leaning = add_object(scene, "board", board.primitive);
  Light light = sun("sun");
  light.shadow.planes = {{{0, 0, 1}, -1.5}, {{0, 2, 0}, 0}, {{1, 1, 0}, -std::sqrt(2.0)}};
  add_light(scene, light, {1.5, 2.5, 4}, {0, 0, 0});
  const View camera = look({-0.5, 3, 7}, {-0.5, 0.8, 0}, 50, 4.0 / 3);
  const Renderer renderer = make_renderer(scene);
  expect_truth_on(renderer, camera, 0, "sun");
  expect_truth_on(renderer, camera, 4, "sun");
  const FloorMismatch on_board = mismatch_on(renderer, camera, leaning, "sun");
  EXPECT_GT(on_board.counted, 300);
  EXPECT_EQ(on_board.different, 0);
  scene.lights[0].shadow.planes = {{{0, 0, 1}, -1.5}};
  const Renderer wall_only = make_renderer(scene);
  EXPECT_EQ(mismatch_on(wall_only, camera, 0, "sun").dark, 0);
  expect_truth_on(wall_only, camera, 4, "sun");
}

// Behind a local light a point and its image by the matrix lie on different sides: a mirrored ghost.
TEST(GroundShadow, WhatIsBesideOrAboveALocalLightHasNoGhost) {
  Scene scene;
  add_object(scene, "floor", floor(6));
  add_object(scene, "above", box({0.6F, 3, 0}, {0.4F, 0.2F, 0.4F}));
  // Reaches from near the floor to far above the light: its upper corners' images are ghosts.
  add_object(scene, "post", box({-1, 2, 0.3F}, {0.1F, 1.8F, 0.1F}));
  add_light(scene, lamp("lamp"), {0, 1.5, 0}, {0, 0, 0}, {0, 0, -1});
  const Renderer renderer = make_renderer(std::move(scene));
  const View camera = look({0, 9, 7}, {0, 0, 0}, 50, 4.0 / 3);
  expect_truth_on(renderer, camera, 0, "lamp");
}

TEST(GroundShadow, ALightInOrUnderThePlaneIsHandled) {
  for (const double height : {0.0, -2.0, 1e-9}) {
    Scene scene = bodies_over_floor();
    add_light(scene, lamp("lamp"), {1.5, height, 1}, {0, height, 0});
    const FloorMismatch found = mismatch_on(make_renderer(std::move(scene)), kCamera, 0, "lamp");
    // From under the floor nothing stands between it and the light.
    if (height <= 0) {
      EXPECT_EQ(found.dark, 0) << height;
    }
    EXPECT_GT(found.counted, 10000);
  }
}

// Cut-outs throw their holes' light.
TEST(GroundShadow, CutOutLeavesCastTheirTrueShadow) {
  const ShadowScene grove = poles_and_leaves(4.0 / 3);
  const Renderer renderer = make_renderer(grove.scene);
  const FloorMismatch found = mismatch_on(renderer, grove.camera, 0, "light");
  EXPECT_GT(found.dark, 300);
  EXPECT_LE(found.different, found.counted / 2000);
}

TEST(GroundShadow, NothingToFallOnAndNothingThatCasts) {
  Scene wall_only;
  add_object(wall_only, "wall", wall(1, 1, 0));
  add_light(wall_only, sun("sun"), {0, 5, 5}, {0, 0, 0});
  Scene bare;
  add_object(bare, "floor", floor(1));
  Mesher degenerate;
  degenerate.triangle({0, 1, 0}, {0, 1, 0}, {0, 1, 0});
  degenerate.triangle({0, 1, 0}, {0.5F, 1, 0}, {1, 1, 0});
  degenerate.triangle({-0.5F, 0, 0}, {0.5F, 0, 0}, {0, 0, 0.5F});  // coincides with the floor
  add_object(bare, "no area", degenerate.primitive);
  add_light(bare, sun("sun"), {0, 5, 5}, {0, 0, 0});
  for (const Scene& scene : {wall_only, bare}) {
    const FloorMismatch found =
        mismatch_on(make_renderer(scene), look({0, 2, 3}, {0, 0, 0}, 40, 1), 0, "sun");
    EXPECT_GT(found.counted, 1000);
    EXPECT_EQ(found.dark, 0);
  }
}

// Not the lowest of all, nor the largest triangle, nor the roof.
TEST(GroundShadow, TheFloorIsTheLowestLargeHorizontalPlaneThatFacesUp) {
  Scene scene;
  add_object(scene, "cellar", floor(1, -3));
  add_object(scene, "ceiling", [] {
    Mesher m;
    m.quad({-9, 4, -9}, {9, 4, -9}, {9, 4, 9}, {-9, 4, 9});  // faces down
    return m.primitive;
  }());
  for (int i = 0; i < 4; ++i) {
    Mesher tile;
    const float x = 2 * static_cast<float>(i);
    tile.quad({x, 0.5F, 2}, {x + 2, 0.5F, 2}, {x + 2, 0.5F, 0}, {x, 0.5F, 0});
    add_object(scene, "tile " + std::to_string(i), tile.primitive);
  }
  add_object(scene, "table", floor(1.4F, 1.2F));
  add_object(scene, "roof", floor(2.5F, 6));
  add_object(scene, "wall", wall(20, 20, -10));
  for (Material& material : scene.materials) material.double_sided = true;
  const OwnedFrame owned = make_frame(scene);
  const std::optional<ShadowPlane> found = light::find_floor(owned.frame);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->normal, glm::dvec3(0, 1, 0));
  EXPECT_NEAR(found->distance, 0.5, 1e-9);
}

// Row 97: a shadow for each of N lights, and no memory for any.
TEST(GroundShadow, EachOfManyLightsThrowsAShadowWithoutMemoryOfItsOwn) {
  for (const int count : {1, 2, 8}) {
    Scene scene = bodies_over_floor();
    for (int i = 0; i < count; ++i) {
      const double angle = 0.7 * i;
      const glm::dvec3 from(3 * std::cos(angle), 4, 3 * std::sin(angle));
      const std::string name = "light " + std::to_string(i);
      add_light(scene, i % 3 == 2 ? lamp(name) : sun(name), from, {0, 0, 0});
    }
    const Renderer renderer = make_renderer(std::move(scene));
    for (int i = 0; i < count; ++i) expect_truth_on(renderer, kCamera, 0, "light " + std::to_string(i));
    RenderSettings settings = test_settings(160, 120);
    settings.shadows = ShadowTechnique::ground;
    RenderStatistics statistics;
    static_cast<void>(renderer.render(kCamera, settings, {}, &statistics).value());
    EXPECT_EQ(statistics.maps_drawn, 0);
    EXPECT_TRUE(statistics.shadow_memory.empty());
  }
}

// Row 98: without its shadow nobody can tell how high the ball is.
TEST(GroundShadow, GroundsWhatSeemsToFloat) {
  const auto draw = [](float height, ShadowTechnique technique) {
    Scene scene;
    add_object(scene, "floor", floor(40));
    // The same picture of the ball: along the camera's ray through its centre, larger as it is farther.
    const glm::vec3 eye(0, 2, 5);
    const glm::vec3 on_floor(0, 0.4F, 0);
    const float share = height;
    add_object(scene, "ball", sphere(eye + (on_floor - eye) * share, 0.4F * share, 48));
    add_light(scene, sun("sun"), {0, 5, 0}, {0, 0, 0}, {0, 0, -1});
    RenderSettings settings = test_settings(160, 120);
    settings.shadows = technique;
    settings.layers = {Layer::visibility, Layer::object};
    return render(make_renderer(std::move(scene)), look({0, 2, 5}, {0, 0.4, 0}, 35, 4.0 / 3), settings);
  };
  // With parallel light from straight above and the ball along one ray, pictures without shadows are the same.
  const auto dark_rows = [](const LayeredImage& image) {
    int last = -1;
    for (int y = 0; y < image.height; ++y) {
      if (at(image, "id.object", image.width / 2, y) == 0 &&
          at(image, "visibility.sun", image.width / 2, y) == 0)
        last = y;
    }
    return last;
  };
  const LayeredImage standing = draw(1, ShadowTechnique::none);
  const LayeredImage floating = draw(0.7F, ShadowTechnique::none);
  std::size_t differing = 0;
  const std::span<const float> a = values_of(standing, "R"), b = values_of(floating, "R");
  for (std::size_t i = 0; i < a.size(); ++i) differing += std::abs(a[i] - b[i]) > 0.02F ? 1U : 0U;
  EXPECT_LT(differing, a.size() / 200);
  EXPECT_EQ(dark_rows(floating), -1);
  // With them, the nearer ball's shadow lies nearer: lower in the picture, and apart from it.
  EXPECT_GT(dark_rows(draw(0.7F, ShadowTechnique::ground)), dark_rows(draw(1, ShadowTechnique::ground)) + 10);
}

TEST(GroundShadow, IsTheSameForEveryInstructionSetAndNumberOfThreads) {
  Scene scene = poles_and_leaves(4.0 / 3).scene;
  add_light(scene, lamp("lamp"), {1.5, 4, 1}, {0, 0, 0});
  const View camera = poles_and_leaves(4.0 / 3).camera;
  RenderSettings settings = test_settings(160, 120);
  settings.shadows = ShadowTechnique::ground;
  settings.samples = 4;
  const LayeredImage expected = render(make_renderer(scene, 1, InstructionSet::scalar), camera, settings);
  for (const InstructionSet set : supported_instruction_sets()) {
    for (const int threads : {1, 3}) {
      const LayeredImage image = render(make_renderer(scene, threads, set), camera, settings);
      EXPECT_EQ(count_different_pixels(expected, image), 0U) << name_of(set) << ", " << threads;
    }
  }
}

}  // namespace
}  // namespace laterna
