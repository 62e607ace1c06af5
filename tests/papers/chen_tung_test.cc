// Chen and Tung, Real-time shadow rendering using projective texture: silhouettes thrown on receivers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <set>

#include "reference/picture_probes.h"
#include "reference/projector_scenes.h"
#include "reference/shadow_scenes.h"
#include "reference/shadow_truth.h"
#include "shadow/silhouette_texture.h"

namespace laterna {
namespace {

using namespace reference;

RenderSettings silhouette_settings(int width, int height) {
  RenderSettings settings = test_settings(width, height);
  settings.shadows = ShadowTechnique::silhouette;
  settings.layers = {Layer::visibility, Layer::object};
  return settings;
}

ShadowErrors errors_of(const Renderer& renderer, const View& camera, const std::string& light) {
  return find_shadow_errors(draw_shadow_masks(renderer, camera, silhouette_settings(320, 240), light, 3));
}

// Right but for edges, which lie within a texel.
void expect_right(const ShadowErrors& errors) {
  SCOPED_TRACE(to_string(errors));
  EXPECT_EQ(errors.far_false_dark, 0);
  EXPECT_EQ(errors.far_false_lit, 0);
  EXPECT_GT(errors.edge_pixels, 100);
}

Light lamp(const std::string& name) {
  Light light = spot(name, 30);
  light.type = LightType::point;
  return light;
}

void set_casts(Scene& scene, int node, bool casts) {
  scene.nodes[static_cast<std::size_t>(node)].casts_shadow = casts;
}

// ---------------------------------------------------------------------------------------------- one silhouette

ShadowScene cube_on_floor() {
  ShadowScene shown;
  add_object(shown.scene, "floor", floor(3));
  add_object(shown.scene, "cube", box({0, 0.5F, 0}, glm::vec3(0.5F)));
  shown.camera = look({0.5, 4, 5}, {0, 0.3, 0}, 45, 4.0 / 3);
  return shown;
}

// Row 31: no depth, and yet the truth on the receiver. The floor is an object like any other: it shades nobody above it.
TEST(ChenTung, TheShadowOfACubeOnAPlaneIsTheTruth) {
  ShadowScene shown = cube_on_floor();
  Light sharp = sun("sun");
  sharp.shadow.resolution = 1024;
  add_light(shown.scene, sharp, {-2, 5, 3}, {0, 0, 0});
  sharp = lamp("lamp");
  sharp.shadow.resolution = 1024;
  add_light(shown.scene, sharp, {1.5, 4, 1}, {0, 0, 0});
  sharp = spot("spot", 40);
  sharp.shadow.resolution = 1024;
  add_light(shown.scene, sharp, {-2, 4, -2}, {0, 0, 0});
  sharp = projector("lantern", 0.6, 0.6);
  sharp.shadow.resolution = 1024;
  add_light(shown.scene, sharp, {3, 4, 2}, {0, 0.4, 0});
  const Renderer renderer = make_renderer(shown.scene);
  for (const char* light : {"sun", "lamp", "spot", "lantern"}) {
    SCOPED_TRACE(light);
    expect_right(errors_of(renderer, shown.camera, light));
  }
}

// Row 31, the known limitation, and row 39, which lifts it.
TEST(ChenTung, BetweenLightAndCasterThereIsAShadowUnlessObjectsAreOrdered) {
  for (const bool orders : {false, true}) {
    Scene scene;
    add_object(scene, "high", floor(1, 3));
    add_object(scene, "low", floor(1, 1));
    Light light = sun("sun");
    light.shadow.orders_objects = orders;
    add_light(scene, light, {0, 9, 0}, {0, 0, 0}, {0, 0, -1});
    const LayeredImage image =
        render(make_renderer(std::move(scene)), look({0, 8, 0}, {0, 0, 0}, 25, 1, {0, 0, -1}),
               silhouette_settings(64, 64));
    EXPECT_EQ(at(image, "id.object", 32, 32), 0);
    EXPECT_EQ(at(image, "visibility.sun", 32, 32), orders ? 1 : 0);
  }
}

// Row 32: scale and bias × projection × light's view × inverse of the eye's view, on points of the eye's space.
TEST(ChenTung, TheTextureMatrixIsTheChainMultipliedOut) {
  const View light = look({1, 5, 2}, {0, 0, 0}, 50, 1.25);
  const View eye = look({3, 2, 6}, {0.2, 0.4, 0}, 40, 1.5);
  // Read as it is meant: 0.5 on the diagonal and in the last column. t counts from the top row.
  const glm::dmat4 bias =
      glm::translate(glm::dmat4(1), {0.5, 0.5, 0.5}) * glm::scale(glm::dmat4(1), {0.5, -0.5, 0.5});
  const glm::dmat4 chain =
      bias * light.clip_from_view() * light.view_from_world() * glm::inverse(eye.view_from_world());
  const glm::dmat4 of_library = light.image_from_world() * eye.pose.world_from_view();
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) EXPECT_NEAR(chain[column][row], of_library[column][row], 1e-12);
  }
  // Corners of the light's frustum are corners of the texture.
  const Projection& p = light.projection;
  for (const double z : {p.near, p.far}) {
    for (const double s : {0.0, 1.0}) {
      for (const double t : {0.0, 1.0}) {
        const glm::dvec4 corner(z * (s == 0 ? p.left : p.right), z * (t == 0 ? p.top : p.bottom), -z, 1);
        const glm::dvec4 in_eye = eye.view_from_world() * light.pose.world_from_view() * corner;
        const glm::dvec4 q = chain * in_eye;
        EXPECT_NEAR(q.x / q.w, s, 1e-9);
        EXPECT_NEAR(q.y / q.w, t, 1e-9);
      }
    }
  }
  // Equation 6 gives the same from the pixel and its depth alone.
  const raster::RasterView camera(eye, 300, 200);
  const shadow::SilhouetteTexture texture({light, 500, 400}, 0, camera.homogeneous_ray());
  for (const glm::dvec3 point : {glm::dvec3(0, 0, 0), glm::dvec3(0.5, 0.3, -0.7), glm::dvec3(-1, 1, 0.4)}) {
    const glm::dvec4 in_eye = eye.view_from_world() * glm::dvec4(point, 1);
    const glm::dvec4 pixel = eye.image_from_world() * glm::dvec4(point, 1);
    const auto place = texture.place_of(static_cast<float>(pixel.x / pixel.w * 300 - camera.origin_x),
                                        static_cast<float>(pixel.y / pixel.w * 200 - camera.origin_y),
                                        static_cast<float>(-1 / in_eye.z));
    const glm::dvec4 q = chain * in_eye;
    EXPECT_TRUE(place.is_ahead);
    EXPECT_NEAR(place.x, 500 * q.x / q.w, 2e-3);
    EXPECT_NEAR(place.y, 400 * q.y / q.w, 2e-3);
  }
}

// ---------------------------------------------------------------------------------------------- smoothing

// A straight edge through the middle; lit on the right.
shadow::ArrivingLight straight_edge(int side) {
  shadow::ArrivingLight picture{side, side, {}};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) picture.values.push_back(x < side / 2 ? 0.0F : 1.0F);
  }
  return picture;
}

// Row 36: the mean of the eight neighbours leaves the texel itself out.
TEST(ChenTung, OneSmoothingOfAStraightEdgeGivesFiveAndThreeEighths) {
  shadow::ArrivingLight picture = straight_edge(16);
  shadow::smooth(picture, 1, SmoothKernel::eight_neighbours);
  const auto row = [&](int x) { return picture.values[static_cast<std::size_t>(8 * 16 + x)]; };
  EXPECT_EQ(row(6), 0);
  EXPECT_EQ(row(7), 0.375F);
  EXPECT_EQ(row(8), 0.625F);
  EXPECT_EQ(row(9), 1);
  picture = straight_edge(16);
  shadow::smooth(picture, 1, SmoothKernel::binomial);
  EXPECT_EQ(row(7), 0.25F);
  EXPECT_EQ(row(8), 0.75F);
  picture = straight_edge(16);
  shadow::smooth(picture, 0, SmoothKernel::eight_neighbours);
  EXPECT_EQ(row(7), 0);
}

// Row 36, figure 6: n = 0…10. Across a straight edge each pass is a mean of a left, middle and right column weighted
// 3 : 2 : 3, or 1 : 2 : 1 of the proper kernel, whose variance after n passes is n times 3/4, or 1/2.
TEST(ChenTung, SmoothingSpreadsByTheRootOfThePasses) {
  for (const SmoothKernel kernel : {SmoothKernel::eight_neighbours, SmoothKernel::binomial}) {
    for (int n = 0; n <= 10; ++n) {
      shadow::ArrivingLight picture = straight_edge(64);
      shadow::smooth(picture, n, kernel);
      double variance = 0;
      double least_step = 1;
      // Away from the texture's sides, beyond which all is lit.
      for (int x = 17; x < 48; ++x) {
        const std::size_t i = static_cast<std::size_t>(32 * 64 + x);
        const double step = picture.values[i] - picture.values[i - 1];
        variance += step * (x - 32) * (x - 32);
        least_step = std::min(least_step, step);
      }
      EXPECT_NEAR(variance, n * (kernel == SmoothKernel::binomial ? 0.5 : 0.75), 1e-4) << n;
      EXPECT_GE(least_step, 0) << "never lighter again";
    }
  }
}

// The same in a picture: smoothed textures arrive on the floor.
TEST(ChenTung, SmoothShadowsArriveOnTheReceiver) {
  const auto levels = [](int passes) {
    Scene scene;
    add_object(scene, "floor", floor(3));
    const int board = add_object(scene, "board", box({0, 1, 0}, {0.5F, 0.05F, 0.5F}));
    scene.nodes[static_cast<std::size_t>(board)].visible = false;
    Light light = sun("sun");
    light.shadow.resolution = 64;
    light.shadow.filter = ShadowFilter::nearest;
    light.shadow.smooth = passes;
    add_light(scene, light, {0, 5, 0}, {0, 0, 0}, {0, 0, -1});
    const LayeredImage image =
        render(make_renderer(std::move(scene)), look({0, 5, 0}, {0, 0, 0}, 30, 1, {0, 0, -1}),
               silhouette_settings(256, 256));
    const std::span<const float> row = row_of(image, "visibility.sun", 128);
    return std::set<float>(row.begin(), row.end());
  };
  EXPECT_EQ(levels(0), (std::set<float>{0, 1}));
  EXPECT_EQ(levels(1), (std::set<float>{0, 0.375F, 0.625F, 1}));
  EXPECT_GT(levels(5).size(), 8U);
}

// ---------------------------------------------------------------------------------------------- many objects

// Figure 7: models on a floor, each an occluder and a receiver.
ShadowScene figure_7() {
  ShadowScene shown;
  add_object(shown.scene, "floor", floor(5));
  add_object(shown.scene, "ball", sphere({-2.2F, 1.5F, 0.1F}, 0.5F, 48));
  add_object(shown.scene, "box", box({-0.9F, 0.6F, 0}, {0.3F, 0.6F, 0.5F}));
  add_object(shown.scene, "post", box({0.9F, 0.5F, 0.2F}, {0.12F, 0.5F, 0.12F}));
  add_object(shown.scene, "pebble", sphere({1.8F, 0.3F, 0.5F}, 0.3F, 48));
  add_object(shown.scene, "slab", box({2.6F, 0.7F, 0}, {0.1F, 0.7F, 1}));
  shown.camera = look({-1, 4, 5.5}, {0, 0.4, 0}, 46, 4.0 / 3);
  return shown;
}

void add_sharp(Scene& scene, Light light, glm::dvec3 position) {
  light.shadow.resolution = 1024;
  add_light(scene, light, position, {0, 0.3, 0});
}

// Rows 37 and 42: every pair, in several lights.
TEST(ChenTung, EveryOccluderShadesEveryReceiverInSeveralLights) {
  ShadowScene shown = figure_7();
  add_sharp(shown.scene, sun("sun"), {-4, 3, 0.3});
  add_sharp(shown.scene, lamp("lamp"), {-6, 4, 2});
  add_sharp(shown.scene, spot("spot", 30), {5, 4, -3});
  const Renderer renderer = make_renderer(shown.scene);
  for (const char* light : {"sun", "lamp", "spot"}) {
    SCOPED_TRACE(light);
    expect_right(errors_of(renderer, shown.camera, light));
  }
  std::set<std::pair<int, int>> pairs;
  for (int caster = 1; caster <= 5; ++caster) {
    Scene scene = shown.scene;
    for (int other = 0; other <= 5; ++other) set_casts(scene, other, other == caster);
    const LayeredImage image =
        render(make_renderer(std::move(scene)), shown.camera, silhouette_settings(320, 240));
    std::array<int, 6> dark{};
    for (std::size_t i = 0; i < values_of(image, "id.object").size(); ++i) {
      const int object = static_cast<int>(values_of(image, "id.object")[i]);
      if (object >= 0 && values_of(image, "visibility.sun")[i] == 0) ++dark[static_cast<std::size_t>(object)];
    }
    EXPECT_EQ(dark[static_cast<std::size_t>(caster)], 0) << "no object shades itself";
    for (int receiver = 0; receiver <= 5; ++receiver) {
      if (dark[static_cast<std::size_t>(receiver)] > 20) pairs.insert({caster, receiver});
    }
  }
  for (const std::pair<int, int>& pair : {std::pair{1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}, {1, 2}})
    EXPECT_TRUE(pairs.contains(pair)) << pair.first << " on " << pair.second;
}

// Rows 38 and 47: the picture is the same without culling, and less is drawn with it.
TEST(ChenTung, CullingChangesNothingButTheNumberOfSilhouettes) {
  ShadowScene shown = figure_7();
  // Behind a wall that hides them from the camera, and far beside what it sees: occluders whose shadows nobody sees.
  add_object(shown.scene, "screen", wall(2, 2, -3));
  for (int i = 0; i < 6; ++i) {
    const float x = static_cast<float>(i) - 2.5F;
    add_object(shown.scene, "hidden " + std::to_string(i), box({x / 3, 0.5F, -4}, {0.1F, 0.2F, 0.1F}));
    add_object(shown.scene, "beside " + std::to_string(i), box({40 + x, 0.5F, 0}, {0.1F, 0.2F, 0.1F}));
  }
  Scene unculled = shown.scene;
  for (Scene* scene : {&shown.scene, &unculled}) {
    for (const int smooth : {0, 3}) {
      Light light = smooth == 0 ? sun("sun") : lamp("lamp");
      light.shadow.resolution = 128;
      light.shadow.smooth = smooth;
      light.shadow.culls_occluders = scene == &shown.scene;
      add_light(*scene, light, {-4, 3, 0.6}, {0, 0, 0});
    }
  }
  const auto draw = [&](const Scene& scene, RenderStatistics& statistics) {
    return make_renderer(scene).render(shown.camera, silhouette_settings(320, 240), {}, &statistics).value();
  };
  RenderStatistics culled;
  RenderStatistics all;
  EXPECT_EQ(count_different_pixels(draw(shown.scene, culled), draw(unculled, all)), 0U);
  ASSERT_EQ(culled.silhouettes.size(), 2U);
  ASSERT_EQ(all.silhouettes.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(culled.silhouettes[i].light, i == 0 ? "sun" : "lamp");
    EXPECT_EQ(culled.silhouettes[i].objects, 19U);
    EXPECT_LT(culled.silhouettes[i].pairs, all.silhouettes[i].pairs);
    EXPECT_LE(culled.silhouettes[i].silhouettes_drawn, 8U);
    EXPECT_GE(culled.silhouettes[i].silhouettes_drawn, 5U);
    EXPECT_EQ(all.silhouettes[i].silhouettes_drawn, all.silhouettes[i].silhouettes);
    EXPECT_GE(all.silhouettes[i].silhouettes, 18U) << "all but what is farthest";
  }
}

// Row 35: an area light as points: where shadows overlap it is darker, in five levels.
TEST(ChenTung, FourPointsAlongAStripLightGiveFiveLevelsOverOneMetre) {
  Scene scene;
  add_object(scene, "floor", floor(4));
  const int board = add_object(scene, "board", box({-2, 2, 0}, {2, 0.001F, 3}));  // its edge at x = 0
  scene.nodes[static_cast<std::size_t>(board)].visible = false;
  for (int i = 0; i < 4; ++i) {
    Light light = lamp("point " + std::to_string(i));
    light.shadow.filter = ShadowFilter::nearest;
    add_light(scene, light, {-0.5 + i / 3.0, 4, 0}, {0, 0, 0});
  }
  // 2 mm a pixel, from under the board.
  const View camera = {Pose::look_at({0, 1, 0}, {0, 0, 0}, {0, 0, -1}).value(),
                       Projection::orthographic(1, 0.01, 0, 2)};
  const LayeredImage image = render(make_renderer(std::move(scene)), camera, silhouette_settings(1000, 10));
  std::set<float> levels;
  int first = -1;
  int last = -1;
  for (int x = 0; x < 1000; ++x) {
    float arriving = 0;
    for (int i = 0; i < 4; ++i) arriving += 0.25F * at(image, "visibility.point " + std::to_string(i), x, 5);
    levels.insert(arriving);
    if (arriving > 0 && first < 0) first = x;
    if (arriving < 1) last = x;
  }
  EXPECT_EQ(levels, (std::set<float>{0, 0.25F, 0.5F, 0.75F, 1}));
  EXPECT_NEAR(0.002 * (last + 1 - first), 1.0, 0.05);
}

// ---------------------------------------------------------------------------------------------- receivers

// Row 41: 256 × 256 heights.
TEST(ChenTung, TerrainReceivesTheTrueShadow) {
  ShadowScene shown;
  Primitive terrain;
  const auto height = [](double x, double z) { return 0.25 * std::sin(1.3 * x) * std::cos(1.7 * z + 0.4); };
  for (int j = 0; j < 256; ++j) {
    for (int i = 0; i < 256; ++i) {
      const double x = (i - 127.5) / 40;
      const double z = (j - 127.5) / 40;
      terrain.positions.emplace_back(x, height(x, z), z);
    }
  }
  for (std::uint32_t j = 0; j + 1 < 256; ++j) {
    for (std::uint32_t i = 0; i + 1 < 256; ++i) {
      const std::uint32_t a = j * 256 + i;
      for (const std::uint32_t k : {a, a + 256, a + 257, a, a + 257, a + 1}) terrain.indices.push_back(k);
    }
  }
  // As the paper has it, the ground receives and does not cast: a box cannot tell a hill from what stands on it.
  set_casts(shown.scene, add_object(shown.scene, "terrain", terrain), false);
  add_object(shown.scene, "ball", sphere({0.3F, 0.9F, 0}, 0.4F, 48));
  add_object(shown.scene, "post", box({-1.2F, 0.6F, 0.4F}, {0.1F, 0.8F, 0.1F}));
  add_sharp(shown.scene, sun("sun"), {-3, 4, 1});
  shown.camera = look({0.5, 3.5, 4.5}, {0, 0.1, 0}, 40, 4.0 / 3);
  const Renderer renderer = make_renderer(shown.scene);
  expect_right(errors_of(renderer, shown.camera, "sun"));
}

// Row 45: a receiver slides under a shadow that stays where it is.
TEST(ChenTung, AShadowStaysWhileItsReceiverMoves) {
  Scene scene;
  const int tray = add_object(scene, "tray", box({0, 0, 0}, {1.5F, 0.1F, 1.5F}));
  const int ball = add_object(scene, "ball", sphere({0, 1.2F, 0}, 0.3F, 32));
  scene.nodes[static_cast<std::size_t>(ball)].visible = false;
  Light light = sun("sun");
  add_light(scene, light, {0.5, 5, 1}, {0, 0, 0});
  Renderer renderer = make_renderer(std::move(scene));
  const View camera = look({0, 5, 0}, {0, 0, 0}, 25, 1, {0, 0, -1});
  const LayeredImage before = render(renderer, camera, silhouette_settings(128, 128));
  for (const double x : {0.2, 0.4}) {
    ASSERT_TRUE(renderer.set_transform(tray, glm::translate(glm::dmat4(1), {x, 0, 0.1})));
    const LayeredImage after = render(renderer, camera, silhouette_settings(128, 128));
    int dark = 0;
    for (std::size_t i = 0; i < values_of(before, "visibility.sun").size(); ++i) {
      dark += values_of(after, "visibility.sun")[i] < 0.5F ? 1 : 0;
      EXPECT_NEAR(values_of(before, "visibility.sun")[i], values_of(after, "visibility.sun")[i], 1e-3F);
    }
    EXPECT_GT(dark, 200);
  }
}

// Rows 43 and 44: skinned MD2 models as casters and receivers, where the paper's skins hid the shadow.
TEST(ChenTung, AShadowIsSeenOnTheSkinOfAnMd2Model) {
  const std::filesystem::path folder = std::filesystem::path(LATERNA_SHARED_DIR) / "scenes/md2";
  if (!std::filesystem::exists(folder / "sydney.md2")) GTEST_SKIP() << "no " << folder;
  LoadOptions options;
  options.metres_per_unit = 0.04;
  Scene scene = load_scene({folder / "sydney.md2", folder / "faerie.md2"}, options).value();
  std::vector<int> models;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].mesh >= 0) models.push_back(static_cast<int>(i));
  }
  ASSERT_EQ(models.size(), 2U);
  // The second file names no skin that is there.
  ASSERT_EQ(scene.pictures.size(), 1U);
  Picture skin;
  skin.name = "skin";
  skin.file = folder / "faerie2.bmp";
  scene.pictures.push_back(skin);
  const int mesh = scene.nodes[static_cast<std::size_t>(models[1])].mesh;
  const int material = scene.meshes[static_cast<std::size_t>(mesh)].primitives.at(0).material;
  scene.materials.at(static_cast<std::size_t>(material)).base_color_texture.picture = 1;
  // One behind the other, as the light sees them.
  int root = models[1];
  while (scene.nodes[static_cast<std::size_t>(root)].parent >= 0)
    root = scene.nodes[static_cast<std::size_t>(root)].parent;
  glm::dmat4& behind = scene.nodes[static_cast<std::size_t>(root)].parent_from_node;
  behind = glm::translate(glm::dmat4(1), {0, 0, -3}) * behind;
  Light light = sun("sun");
  light.shadow.opacity = 0.5F;
  light.shadow.technique = ShadowTechnique::silhouette;
  add_light(scene, light, {0.5, 0, 6}, {0, 0, 0});
  scene.ambient_is_set = true;
  RenderSettings settings = papers_settings(240, 240);
  settings.layers = {Layer::visibility, Layer::object, Layer::albedo};
  const View camera = look({2.5, 0.5, 1.5}, {0, 0, -3}, 30, 1);
  const LayeredImage image = render(make_renderer(scene), camera, settings);
  settings.shadows = ShadowTechnique::none;
  scene.lights.back().shadow.technique = ShadowTechnique::none;
  const LayeredImage lit = render(make_renderer(scene), camera, settings);
  int dark = 0;
  std::set<float> seen;
  for (std::size_t i = 0; i < values_of(image, "R").size(); ++i) {
    if (values_of(image, "id.object")[i] != 1 || values_of(image, "visibility.sun")[i] != 0) continue;
    ++dark;
    EXPECT_NEAR(values_of(image, "G")[i], 0.5F * values_of(lit, "G")[i], 1e-6);
    seen.insert(values_of(image, "G")[i]);
  }
  EXPECT_GT(dark, 300);
  EXPECT_GT(seen.size(), 50U) << "the skin is seen through the shadow";
}

// ---------------------------------------------------------------------------------------------- aliasing

// How far a shadow's edge is from where it is in truth, in metres, on the mean over rows of a picture and 16 places of the
// caster within a texel.
double mean_edge_error(ShadowTechnique technique, int resolution) {
  // The lantern's frame is 4 m wide on the floor. A sheet half-way up covers the left of it; its edge is slanted.
  constexpr double kSlope = 0.19;
  const double texel = 4.0 / resolution;
  double sum = 0;
  int count = 0;
  for (int step = 0; step < 16; ++step) {
    const double edge = 0.5 * texel * step / 16;
    Scene scene;
    add_object(scene, "floor", floor(3));
    Mesher sheet;
    const auto corner = [&](double z) { return glm::vec3(edge + kSlope * z, 2, z); };
    sheet.quad({-3, 2, 3}, corner(3), corner(-3), {-3, 2, -3});
    const int node = add_object(scene, "sheet", sheet.primitive);
    scene.nodes[static_cast<std::size_t>(node)].visible = false;
    Light light = projector("lantern", 0.5, 0.5);
    light.shadow.technique = technique;
    light.shadow.resolution = resolution;
    light.shadow.filter = ShadowFilter::nearest;
    add_light(scene, light, {0, 4, 0}, {0, 0, 0}, {0, 0, -1});
    const View camera = {Pose::look_at({0, 1, 0}, {0, 0, 0}, {0, 0, -1}).value(),
                         Projection::orthographic(0.32, 0.32, 0, 2)};
    const LayeredImage image = render(make_renderer(std::move(scene)), camera, silhouette_settings(512, 512));
    for (int y = 0; y < 512; ++y) {
      const std::vector<double> at = crossings(row_of(image, "visibility.lantern", y), 0.5);
      EXPECT_EQ(at.size(), 1U);
      if (at.size() != 1) return 0;
      const double x = (at[0] / 512 - 0.5) * 0.64;
      const double z = ((y + 0.5) / 512 - 0.5) * 0.64;
      sum += std::abs(x - (2 * edge + kSlope * z));
      ++count;
    }
  }
  return sum / count;
}

// Row 46: over four sizes of the texture.
TEST(ChenTung, EdgeErrorHalvesWithTheTexel) {
  for (const ShadowTechnique technique : {ShadowTechnique::silhouette, ShadowTechnique::map}) {
    double previous = 0;
    for (const int resolution : {64, 128, 256, 512}) {
      const double error = mean_edge_error(technique, resolution);
      if (previous > 0) {
        EXPECT_NEAR(previous / error, 2.0, 0.2) << resolution;
      }
      previous = error;
    }
  }
}

// ---------------------------------------------------------------------------------------------- limits

TEST(ChenTung, ALightInsideAnObjectSeesItAllRound) {
  Scene scene;
  add_object(scene, "room", box({0, 0, 0}, {2, 2, 2}));
  scene.materials[0].double_sided = true;
  add_object(scene, "outside", wall(2, 2, 6));
  scene.materials[1].double_sided = true;
  add_light(scene, lamp("lamp"), {0.3, 0.2, 0}, {0, 0, -1});
  const LayeredImage image =
      render(make_renderer(std::move(scene)), look({0, 0, 5}, {0, 0, 6}, 60, 1), silhouette_settings(32, 32));
  EXPECT_EQ(at(image, "id.object", 16, 16), 1);
  for (const float alpha : values_of(image, "visibility.lamp")) EXPECT_EQ(alpha, 0);
}

TEST(ChenTung, NothingBehindTheLightCastsAndNothingAtAllCanBeDrawn) {
  Scene scene;
  add_object(scene, "floor", floor(3));
  add_object(scene, "above", box({0, 6, 0}, {0.5F, 0.5F, 0.5F}));
  Mesher degenerate;
  degenerate.triangle({0, 1, 0}, {0, 1, 0}, {0, 1, 0});
  degenerate.triangle({0, 1, 0}, {0.5F, 1, 0}, {1, 1, 0});
  add_object(scene, "no area", degenerate.primitive);
  add_light(scene, spot("spot", 40), {0, 4, 0}, {0, 0, 0}, {0, 0, -1});
  add_light(scene, lamp("lamp"), {0, 4, 0}, {0, 0, 0}, {0, 0, -1});
  const LayeredImage image =
      render(make_renderer(std::move(scene)), look({0, 3, 3}, {0, 0, 0}, 40, 1), silhouette_settings(64, 64));
  for (const char* name : {"visibility.spot", "visibility.lamp"})
    EXPECT_EQ(at(image, name, 32, 40), 1) << name;
}

TEST(ChenTung, IsTheSameForEveryInstructionSetAndNumberOfThreads) {
  Scene scene = figure_7().scene;
  Light light = sun("sun");
  light.shadow.smooth = 2;
  add_light(scene, light, {-4, 3, 0.6}, {0, 0, 0});
  add_light(scene, lamp("lamp"), {1.5, 4, 1}, {0, 0, 0});
  const View camera = figure_7().camera;
  RenderSettings settings = silhouette_settings(160, 120);
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
