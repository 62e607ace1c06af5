// Shadow maps in two layers, of what stands and of what moves: pictures of a series are those of renderers made at their times,
// and only what moved is done again (rows 77 and 105).
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <random>

#include "reference/everything.h"
#include "reference/shapes.h"
#include "render/tiles_in_view.h"

namespace laterna {
namespace {

using reference::same_bits;

constexpr int kWidth = 96, kHeight = 72;
const View kViewOfLayers = reference::look({4, 5, 7}, {0, 0.5, 0}, 45, static_cast<double>(kWidth) / kHeight);

void move(Scene& scene, int node, std::vector<double> times, std::vector<double> places) {
  scene.nodes[static_cast<std::size_t>(node)].transform = Transform{};
  Clip& clip = scene.clips.emplace_back();
  clip.is_path = true;
  clip.at_end = AtEnd::hold;
  clip.keys.push_back({KeyInterpolation::linear, std::move(times), std::move(places)});
  ClipChannel channel;
  channel.target = node;
  channel.keys = 0;
  clip.channels.push_back(channel);
}

Light lamp(const std::string& name, LightType type, ShadowTechnique technique = ShadowTechnique::map) {
  Light light;
  light.name = name;
  light.type = type;
  light.intensity = type == LightType::directional ? 2 : 40;
  light.outer_cone = Angle::degrees(35);
  light.inner_cone = Angle::degrees(20);
  light.shadow.technique = technique;
  light.shadow.resolution = 320;
  return light;
}

// Columns on a floor, and a ball that rolls in between from x = −3 to 3 in a second.
struct Hall {
  Scene scene;
  int ball = -1;
};

Hall hall() {
  Hall hall;
  reference::add_object(hall.scene, "floor", reference::floor(6));
  for (int i = 0; i < 9; ++i) {
    reference::add_object(hall.scene, "column",
                          reference::box({-4.0F + static_cast<float>(i), 0.8F, i % 2 == 0 ? -1.0F : 1.2F},
                                         {0.15F, 0.8F, 0.15F}));
  }
  hall.ball = reference::add_object(hall.scene, "ball", reference::sphere({0, 0.5F, 0}, 0.4F, 12));
  move(hall.scene, hall.ball, {0, 1}, {-3, 0, 0, 3, 0, 0});
  return hall;
}

RenderSettings settings_of_layers() {
  RenderSettings settings = reference::test_settings(kWidth, kHeight);
  settings.layers = {Layer::visibility};
  return settings;
}

struct Drawn {
  LayeredImage picture;
  RenderStatistics statistics;
};

Drawn draw(const Renderer& renderer, const View& view = kViewOfLayers) {
  Drawn drawn;
  Result<LayeredImage> picture = renderer.render(view, settings_of_layers(), {}, &drawn.statistics);
  EXPECT_TRUE(picture);
  if (picture) drawn.picture = std::move(*picture);
  return drawn;
}

// At each time the picture is that of a renderer that knows of no other time. Returns what was drawn.
std::vector<RenderStatistics> check_series(const Scene& scene, const std::vector<double>& times,
                                           const RendererOptions& options = {}) {
  std::vector<RenderStatistics> statistics;
  Renderer series = Renderer::create(scene, options).value();
  for (const double time : times) {
    EXPECT_TRUE(series.set_time(time));
    Drawn drawn = draw(series);
    RendererOptions fresh = options;
    fresh.time = time;
    EXPECT_TRUE(same_bits(drawn.picture, draw(Renderer::create(scene, fresh).value()).picture))
        << "at " << time << " s";
    statistics.push_back(drawn.statistics);
  }
  return statistics;
}

RendererOptions at(double time) {
  RendererOptions options;
  options.time = time;
  return options;
}

const std::vector<double> kTimes = {0, 0.1, 0.45, 0.5, 0.5, 0.95, 0.2};

TEST(CasterLayers, ASeriesIsThatOfFreshRenderersWithEveryTechnique) {
  const auto check = [](const Light& light, glm::dvec3 position) {
    Hall h = hall();
    reference::add_light(h.scene, light, position, {0, 0, 0});
    SCOPED_TRACE(light.name);
    check_series(h.scene, kTimes);
  };
  check(lamp("projector", LightType::projector), {2, 5, 3});
  check(lamp("spot", LightType::spot), {1, 5, 2});
  check(lamp("bulb", LightType::point), {0.5, 2.5, 0.3});
  check(lamp("sun", LightType::directional), {2, 5, 3});
  check(lamp("cascades", LightType::directional, ShadowTechnique::cascades), {2, 5, 3});
  check(lamp("variance", LightType::spot, ShadowTechnique::variance), {1, 5, 2});
  check(lamp("exact", LightType::point, ShadowTechnique::exact), {0.5, 2.5, 0.3});
  Light soft = lamp("soft", LightType::spot, ShadowTechnique::pcss);
  soft.source.radius = 0.1;
  check(soft, {1, 5, 2});
  Light warped = lamp("warped", LightType::directional);
  warped.shadow.warp = ShadowWarp::light_space_perspective;
  check(warped, {2, 5, 3});
  Light domes = lamp("domes", LightType::point);
  domes.shadow.layout = ShadowLayout::dual_paraboloid;
  domes.shadow.resolution = 96;
  check(domes, {0.5, 2.5, 0.3});
  Light backs = lamp("backs", LightType::projector);
  backs.shadow.caster_faces = CasterFaces::back_only;
  backs.shadow.filter = ShadowFilter::percentage_closer;
  check(backs, {2, 5, 3});
}

// A caller's moves go the way that clips' do: with every picture that of a renderer to which nothing was known before.
TEST(CasterLayers, OnlyWhatACallerMovesIsDrawnAgain) {
  Hall h = hall();
  h.scene.clips.clear();
  const int cart = reference::add_object(h.scene, "cart", reference::box({0, 0.2F, 0}, {0.3F, 0.2F, 0.3F}));
  const int load = reference::add_object(h.scene, "load", reference::box({0, 0.6F, 0}, {0.1F, 0.2F, 0.1F}));
  h.scene.nodes[static_cast<std::size_t>(load)].parent = cart;
  reference::add_light(h.scene, lamp("sees it", LightType::projector), {2, 5, 3}, {0, 0, 0});
  reference::add_light(h.scene, lamp("does not", LightType::projector), {4, 3, -4}, {5, 0, -4});
  reference::add_light(h.scene, lamp("rays", LightType::spot, ShadowTechnique::exact), {1, 5, 2}, {0, 0, 0});
  Renderer renderer = Renderer::create(h.scene).value();
  draw(renderer);
  const Mesh& ball =
      h.scene.meshes[static_cast<std::size_t>(h.scene.nodes[static_cast<std::size_t>(h.ball)].mesh)];
  const std::size_t ball_triangles = ball.primitives[0].indices.size() / 3;
  int step = 0;
  for (const int node : {cart, h.ball, cart, cart, h.ball, load, cart}) {
    SCOPED_TRACE(++step);
    glm::dmat4 place = glm::translate(glm::dmat4(1), glm::dvec3(0.3 * step - 1, 0.1, 0.2));
    if (step == 4) place = glm::scale(place, glm::dvec3(-1, 1, 1.5));  // turns triangles round
    ASSERT_TRUE(renderer.set_transform(node, place));
    h.scene.nodes[static_cast<std::size_t>(node)].parent_from_node = place;
    const Drawn drawn = draw(renderer);
    EXPECT_TRUE(same_bits(drawn.picture, draw(Renderer::create(h.scene).value()).picture));
    EXPECT_EQ(drawn.statistics.maps_drawn, 1);
    EXPECT_EQ(drawn.statistics.map_reuse.maps_updated, 1);
    EXPECT_EQ(drawn.statistics.maps_kept, 1);
    // A box has 12 triangles; cart and load move together.
    if (step == 3) {
      EXPECT_LE(drawn.statistics.map_reuse.moving_triangles, 24U + ball_triangles);
    }
  }
  // What is refused changes nothing.
  const Drawn before = draw(renderer);
  EXPECT_FALSE(renderer.set_transform(cart, glm::translate(glm::dmat4(1), glm::dvec3(1e11, 0, 0))));
  EXPECT_FALSE(renderer.set_transform(cart, glm::dmat4(0)));
  EXPECT_TRUE(same_bits(draw(renderer).picture, before.picture));
  // What clips move may be moved by callers besides.
  move(h.scene, h.ball, {0, 1}, {-3, 0, 0, 3, 0, 0});
  Renderer both = Renderer::create(h.scene).value();
  draw(both);
  ASSERT_TRUE(both.set_time(0.4));
  const glm::dmat4 place = glm::translate(glm::dmat4(1), glm::dvec3(0.5, 0, 0.4));
  ASSERT_TRUE(both.set_transform(cart, place));
  draw(both);
  ASSERT_TRUE(both.set_time(0.6));
  h.scene.nodes[static_cast<std::size_t>(cart)].parent_from_node = place;
  RendererOptions fresh;
  fresh.time = 0.6;
  EXPECT_TRUE(same_bits(draw(both).picture, draw(Renderer::create(h.scene, fresh).value()).picture));
}

// What clips leave alone is the caller's: of a ball that grows, its place and turn.
TEST(CasterLayers, WhatACallerMovesKeepsWhatItsClipMoves) {
  Hall h = hall();
  h.scene.clips[0].channels[0].property = AnimatedProperty::scale;
  h.scene.clips[0].keys[0].values = {1, 1, 1, 2, 1, 1.5};
  reference::add_light(h.scene, lamp("lamp", LightType::projector), {2, 5, 3}, {0, 0, 0});
  Renderer renderer = Renderer::create(h.scene).value();
  draw(renderer);
  const glm::dmat4 place =
      glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(1, 0.25, 0.5)), 0.5, glm::dvec3(0, 1, 0));
  ASSERT_TRUE(renderer.set_transform(h.ball, place));
  Node& ball = h.scene.nodes[static_cast<std::size_t>(h.ball)];
  ball.parent_from_node = place;
  ball.transform = Transform{{1, 0.25, 0.5}, {0, std::sin(0.25), 0, std::cos(0.25)}, {1, 1, 1}};
  for (const double time : {0.0, 0.5}) {
    ASSERT_TRUE(renderer.set_time(time));
    const Renderer fresh = Renderer::create(h.scene, at(time)).value();
    const LayeredImage a = draw(renderer).picture, b = draw(fresh).picture;
    // The turn is found from the matrix: its last bit may be another.
    double most = 0;
    for (std::size_t i = 0; i < a.channels[0].values.size(); ++i)
      most = std::max(most, static_cast<double>(std::abs(a.channels[0].values[i] - b.channels[0].values[i])));
    EXPECT_LT(most, 1e-4);
  }
}

// Moments and bounds of depth stay with the maps that they are of: pictures in which nothing moved are those of fresh renderers, and so are
// those after other settings and other casters.
TEST(CasterLayers, WhatIsWorkedOutFromMapsIsThatOfTheMaps) {
  Hall h = hall();
  Light variance = lamp("variance", LightType::spot, ShadowTechnique::variance);
  reference::add_light(h.scene, variance, {1, 5, 2}, {0, 0, 0});
  Light soft = lamp("soft", LightType::spot, ShadowTechnique::pcss);
  soft.source.radius = 0.1;
  reference::add_light(h.scene, soft, {-1, 5, 2}, {0, 0, 0});
  Renderer renderer = Renderer::create(h.scene).value();
  const auto check = [&](double time) {
    EXPECT_TRUE(renderer.set_time(time));
    EXPECT_TRUE(same_bits(draw(renderer).picture, draw(Renderer::create(h.scene, at(time)).value()).picture));
  };
  for (const double time : {0.0, 0.0, 0.5, 0.5, 0.0}) check(time);
  const auto change = [&](const auto& set) {
    Light& light = h.scene.lights[0];
    set(light.shadow);
    EXPECT_TRUE(renderer.set_light(0, light));
    check(0.5);
    check(0.5);
  };
  change([](ShadowSettings& s) { s.blur = 4; });
  change([](ShadowSettings& s) { s.moments = ShadowMoments::variance; });
  change([](ShadowSettings& s) { s.depth = ShadowDepth::radial; });
  change([](ShadowSettings& s) { s.technique = ShadowTechnique::map; });
  change([](ShadowSettings& s) { s.technique = ShadowTechnique::variance; });
}

// Once the ball has begun to roll, what stands is neither sorted nor drawn again, and a lamp that does not see the ball keeps
// its map.
TEST(CasterLayers, OnlyWhatMovesIsDrawnAgain) {
  Hall h = hall();
  reference::add_light(h.scene, lamp("sees it", LightType::projector), {2, 5, 3}, {0, 0, 0});
  reference::add_light(h.scene, lamp("does not", LightType::projector), {4, 3, -4}, {5, 0, -4});
  const std::vector<RenderStatistics> drawn = check_series(h.scene, {0, 0.4, 0.45, 0.5, 0.5, 0.55, 0.5});
  EXPECT_EQ(drawn[0].maps_drawn, 2);
  EXPECT_EQ(drawn[0].map_reuse.maps_updated, 0);
  EXPECT_GT(drawn[0].map_reuse.triangles, 0U);
  for (std::size_t i = 1; i < drawn.size(); ++i) {
    const bool moves = i != 4;
    EXPECT_EQ(drawn[i].maps_drawn, moves ? 1 : 0);
    EXPECT_EQ(drawn[i].map_reuse.maps_updated, moves ? 1 : 0);
    EXPECT_EQ(drawn[i].maps_kept, moves ? 1 : 2);
    EXPECT_GT(drawn[i].map_reuse.tiles_kept, 0U);
  }
  // Where the ball has been in the first picture, what stands is drawn once more.
  for (std::size_t i = 2; i < drawn.size(); ++i) {
    EXPECT_EQ(drawn[i].map_reuse.tiles_drawn, 0U) << i;
    EXPECT_EQ(drawn[i].map_reuse.triangles, 0U) << i;
    EXPECT_EQ(drawn[i].map_reuse.tiles_updated > 0, i != 4) << i;
    EXPECT_EQ(drawn[i].map_reuse.moving_triangles > 0, i != 4) << i;
    EXPECT_LE(drawn[i].map_reuse.moving_triangles, 12U * 12U * 2U) << "the ball alone";
  }
}

// The near plane of a lamp stands half way to the nearest caster, which is the one that moves.
TEST(CasterLayers, AMoverBeforeTheNearPlaneDoesNotCostTheMap) {
  Hall h = hall();
  move(h.scene, h.ball, {0, 1}, {0, 4.3, 0, 0, 0, 0});
  h.scene.clips.erase(h.scene.clips.begin());
  reference::add_light(h.scene, lamp("spot", LightType::spot), {0, 6, 0.5}, {0, 0, 0});
  const std::vector<RenderStatistics> drawn = check_series(h.scene, {0, 0.1, 0.9, 1, 0});
  for (std::size_t i = 2; i < drawn.size(); ++i) {
    EXPECT_EQ(drawn[i].map_reuse.maps_updated, 1);
    EXPECT_EQ(drawn[i].map_reuse.tiles_drawn, 0U);
  }
}

TEST(CasterLayers, WhatLeavesTheLightAndComesBackIsSeenAgain) {
  Hall h = hall();
  h.scene.clips.clear();
  move(h.scene, h.ball, {0, 1, 2, 3}, {0, 0, 0, 40, 0, 0, 40, 30, 0, 0, 0.1, 0});
  reference::add_object(h.scene, "far wall", reference::box({45, 15, 0}, {0.2F, 20, 5}));
  reference::add_light(h.scene, lamp("narrow", LightType::projector), {2, 5, 3}, {0, 0, 0});
  const std::vector<RenderStatistics> drawn = check_series(h.scene, {0, 0.02, 1, 1.5, 2, 2.99, 3, 0});
  EXPECT_EQ(drawn[2].maps_drawn, 1) << "it has left";
  EXPECT_EQ(drawn[3].maps_drawn, 0) << "it moves where the light does not shine";
  EXPECT_EQ(drawn[6].maps_drawn, 1);
}

// A fence lets more and more light through; a post before it stands.
TEST(CasterLayers, CutOutsThatChangeAreDrawnAgain) {
  Hall h = hall();
  h.scene.clips.clear();
  const int fence = reference::add_object(h.scene, "fence", reference::wall(1.5F, 1.5F, 0.4F));
  Material& material = h.scene.materials[static_cast<std::size_t>(
      h.scene.meshes[static_cast<std::size_t>(h.scene.nodes[static_cast<std::size_t>(fence)].mesh)]
          .primitives[0]
          .material)];
  material.alpha_mode = AlphaMode::mask;
  material.double_sided = true;
  material.base_color[3] = 0.6F;
  const int target = static_cast<int>(&material - h.scene.materials.data());
  Clip& clip = h.scene.clips.emplace_back();
  clip.keys.push_back({KeyInterpolation::linear, {0, 1}, {0.1, 1}});
  ClipChannel channel;
  channel.property = AnimatedProperty::alpha_cutoff;
  channel.target = target;
  channel.keys = 0;
  clip.channels.push_back(channel);
  for (const ShadowTechnique technique : {ShadowTechnique::map, ShadowTechnique::exact}) {
    Scene scene = h.scene;
    reference::add_light(scene, lamp("lamp", LightType::projector, technique), {1, 3, 5}, {0, 0.5, 0});
    Renderer renderer = Renderer::create(scene).value();
    const LayeredImage closed = draw(renderer).picture;
    ASSERT_TRUE(renderer.set_time(0.9));
    EXPECT_FALSE(same_bits(closed, draw(renderer).picture)) << "it opens";
    const std::vector<RenderStatistics> drawn = check_series(scene, {0, 0.3, 0.9, 0.2, 0.8});
    if (technique == ShadowTechnique::exact) continue;
    EXPECT_EQ(drawn[4].map_reuse.maps_updated, 1);
    EXPECT_EQ(drawn[4].map_reuse.tiles_drawn, 0U);
  }
}

// Two primitives of one material: its cut-outs come to rest long before what wears it does.
TEST(CasterLayers, WhatMovesStillIsNotLeftStandingWhenItsCutOutsRest) {
  Hall h = hall();
  h.scene.clips.clear();
  const int fence = reference::add_object(h.scene, "fence", reference::wall(1.5F, 1.5F, 0.4F));
  Mesh& mesh = h.scene.meshes[static_cast<std::size_t>(h.scene.nodes[static_cast<std::size_t>(fence)].mesh)];
  mesh.primitives.push_back(mesh.primitives[0]);
  for (glm::vec3& p : mesh.primitives[1].positions) p.x += 1;
  Material& material = h.scene.materials[static_cast<std::size_t>(mesh.primitives[0].material)];
  material.alpha_mode = AlphaMode::mask;
  material.double_sided = true;
  material.base_color[3] = 0.6F;
  move(h.scene, fence, {0, 4}, {-3, 0, 0, 3, 0, 0});
  Clip& clip = h.scene.clips.emplace_back();
  clip.at_end = AtEnd::hold;
  clip.keys.push_back({KeyInterpolation::linear, {0, 0.2}, {0.1, 0.5}});
  ClipChannel channel;
  channel.property = AnimatedProperty::alpha_cutoff;
  channel.target = static_cast<int>(&material - h.scene.materials.data());
  channel.keys = 0;
  clip.channels.push_back(channel);
  reference::add_light(h.scene, lamp("lamp", LightType::projector), {1, 3, 5}, {0, 0.5, 0});
  std::vector<double> times;
  for (int frame = 0; frame < 50; ++frame) times.push_back(frame / 20.0);
  check_series(h.scene, times);
}

TEST(CasterLayers, ALightThatMovesRedoesItsOwnMapAlone) {
  Hall h = hall();
  reference::add_light(h.scene, lamp("stands", LightType::projector), {2, 5, 3}, {0, 0, 0});
  const int node = reference::add_light(h.scene, lamp("goes", LightType::projector), {0, 6, 0.5}, {0, 0, 0});
  Clip& clip = h.scene.clips.emplace_back();
  clip.is_path = true;
  clip.keys.push_back({KeyInterpolation::linear,
                       {0, 1},
                       {-2, 6, 0.5, 0, 0, 0, 0, 0, -1,  //
                        2, 6, 0.5, 0, 0, 0, 0, 0, -1}});
  ClipChannel channel;
  channel.property = AnimatedProperty::look_at;
  channel.target = node;
  channel.keys = 0;
  clip.channels.push_back(channel);
  const std::vector<RenderStatistics> drawn = check_series(h.scene, {0, 0.4, 0.45, 0.5, 0.6});
  for (std::size_t i = 1; i < drawn.size(); ++i) {
    EXPECT_EQ(drawn[i].maps_drawn, 2);
    EXPECT_EQ(drawn[i].map_reuse.maps_updated, 1) << "of the lamp that stands";
  }
}

// What has come to rest is drawn with what stands again, until it moves: a door opens, while a ball rolls to and fro.
TEST(CasterLayers, WhatRestsStandsAgain) {
  Hall h = hall();
  h.scene.clips.clear();
  const int door =
      reference::add_object(h.scene, "door", reference::box({0.4F, 0.6F, 0.5F}, {0.4F, 0.6F, 0.1F}));
  std::vector<double> times, places;
  for (int i = 0; i <= 44; ++i) {
    times.push_back(i);
    places.insert(places.end(), {i % 2 == 0 ? -1.0 : 1.0, 0, 0});
  }
  move(h.scene, h.ball, times, places);
  move(h.scene, door, {0, 2, 40, 42}, {0, 0, 0, -0.5, 0, 0, -0.5, 0, 0, 0, 0, 0});
  for (const ShadowTechnique technique : {ShadowTechnique::map, ShadowTechnique::exact}) {
    Scene scene = h.scene;
    reference::add_light(scene, lamp("lamp", LightType::projector, technique), {2, 5, 3}, {0, 0, 0});
    Renderer series = Renderer::create(scene).value();
    draw(series);
    std::vector<std::uint64_t> moving = {0};
    for (int i = 1; i <= 44; ++i) {
      ASSERT_TRUE(series.set_time(i));
      const Drawn drawn = draw(series);
      moving.push_back(drawn.statistics.map_reuse.moving_triangles);
      if (i % 4 != 1 && i < 33) continue;
      RendererOptions fresh;
      fresh.time = i;
      EXPECT_TRUE(same_bits(drawn.picture, draw(Renderer::create(scene, fresh).value()).picture)) << i;
    }
    if (technique != ShadowTechnique::map) continue;
    EXPECT_EQ(moving[32], moving[36] + 12) << "the door's";
    EXPECT_EQ(moving[44], moving[32]);
  }
}

// Tiles that a camera on its way asks for one by one cost their drawing alone.
TEST(CasterLayers, CastersAreSortedOnceForACameraThatMoves) {
  Hall h = hall();
  Light sun = lamp("sun", LightType::directional);
  sun.shadow.resolution = 1024;
  reference::add_light(h.scene, sun, {2, 5, 3}, {0, 0, 0});
  const Renderer renderer = Renderer::create(h.scene).value();
  const auto seen_from = [](double x) { return reference::look({x, 1, 2}, {x, 0, 0}, 20, 4.0 / 3); };
  EXPECT_GT(draw(renderer, seen_from(-4)).statistics.map_reuse.triangles, 0U);
  for (const double x : {-2.0, 1.0, 4.0}) {
    const Drawn drawn = draw(renderer, seen_from(x));
    EXPECT_GT(drawn.statistics.map_reuse.tiles_drawn, 0U);
    EXPECT_EQ(drawn.statistics.map_reuse.triangles, 0U);
  }
}

// ---------------------------------------------------------------------------------------------- memory

TEST(CacheMemory, IsHeldToTheSettingAndPicturesAreTheSame) {
  Hall h = hall();
  for (int i = 0; i < 3; ++i) {
    reference::add_light(h.scene, lamp("lamp " + std::to_string(i), LightType::projector),
                         {2.0 - 2 * i, 5, 3}, {0, 0, 0});
  }
  constexpr std::size_t kMap = 320 * 320 * 8;
  RendererOptions options;
  for (const RenderStatistics& drawn : check_series(h.scene, {0, 0.5, 0.5, 0.6}, options)) {
    EXPECT_GE(drawn.map_reuse.bytes, 3 * kMap);
    EXPECT_LT(drawn.map_reuse.bytes, 3 * 4 * kMap);
  }
  options.cache_bytes = 0;
  for (const RenderStatistics& drawn : check_series(h.scene, {0, 0.5, 0.5, 0.6}, options)) {
    EXPECT_EQ(drawn.map_reuse.bytes, 0U);
    EXPECT_EQ(drawn.maps_drawn, 3);
    EXPECT_EQ(drawn.map_reuse.maps_updated, 0);
    EXPECT_EQ(drawn.map_reuse.tiles_kept, 0U);
  }
  // The first lamp's is the one that is not used for longest.
  options.cache_bytes = 5 * kMap / 2;
  const std::vector<RenderStatistics> some = check_series(h.scene, {0, 0, 0}, options);
  for (std::size_t i = 0; i < some.size(); ++i) {
    EXPECT_LE(some[i].map_reuse.bytes, options.cache_bytes);
    EXPECT_EQ(some[i].maps_drawn, i == 0 ? 3 : 1);
  }
}

TEST(CacheMemory, MoreThanThereMayBeIsRefused) {
  RendererOptions options;
  options.cache_bytes = kMaxCacheBytes;
  EXPECT_TRUE(Renderer::create(hall().scene, options));
  options.cache_bytes = kMaxCacheBytes + 1;
  const Result<Renderer> refused = Renderer::create(hall().scene, options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(to_string(refused.error()),
            "what is kept between pictures may take from 0 to 1099511627776 bytes, not 1099511627777");
}

// ---------------------------------------------------------------------------------------------- tiles

// Against points of the boxes, projected one by one.
TEST(TilesInView, HoldEveryPointOfABoxAndFewMore) {
  std::mt19937 random(5);
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  View parallel = reference::look({3, 4, 5}, {0, 0, 0}, 45, 1.5);
  parallel.projection = {true, -4, 5, -3, 2, 0.5, 12};
  int empty = 0, partly = 0;
  for (const View& view : {reference::look({3, 4, 5}, {0, 0, 0}, 45, 1.5, {0, 1, 0}, 0.5, 20), parallel}) {
    const raster::RasterView raster(view, 900, 600);
    for (int trial = 0; trial < 400; ++trial) {
      const glm::vec3 middle(number(-6, 6), number(-6, 6), number(-6, 8));
      const glm::vec3 half(static_cast<float>(number(0, 1)));
      const frame::Bounds box = {middle - half, middle + half, false};
      const raster::Rect tiles = render::tiles_in_view(raster, box);
      empty += tiles.is_empty() ? 1 : 0;
      raster::Rect seen = raster::Rect::nowhere();
      for (int i = 0; i < 300; ++i) {
        const glm::dvec3 point =
            glm::dvec3(middle) + glm::dvec3(half) * glm::dvec3(number(-1, 1), number(-1, 1), number(-1, 1));
        const glm::dvec3 from_eye = point - raster.eye_ws;
        const double w = raster.is_orthographic ? 1 : glm::dot(raster.w_row, from_eye);
        const double along = glm::dot(view.pose.forward_ws(), point - view.pose.position_ws);
        if (along < view.projection.near || along > view.projection.far) continue;
        const double x = (glm::dot(raster.x_row, from_eye) + raster.x_add) / w + raster.origin_x;
        const double y = (glm::dot(raster.y_row, from_eye) + raster.y_add) / w + raster.origin_y;
        if (x < 0 || y < 0 || x >= 900 || y >= 600) continue;
        const int tile_x = static_cast<int>(x) / 64, tile_y = static_cast<int>(y) / 64;
        seen.include({tile_x, tile_y, tile_x + 1, tile_y + 1});
        ASSERT_TRUE(tile_x >= tiles.x_begin && tile_x < tiles.x_end && tile_y >= tiles.y_begin &&
                    tile_y < tiles.y_end)
            << trial;
      }
      if (!seen.is_empty() && tiles.width() <= seen.width() + 2 && tiles.height() <= seen.height() + 2)
        ++partly;
    }
  }
  EXPECT_GT(empty, 100);
  EXPECT_GT(partly, 150);
}

}  // namespace
}  // namespace laterna
