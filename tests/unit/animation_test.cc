// Clips, skins and morph targets: key frames in closed form, what a file may say of them, and what a change of time makes anew.
#include <gtest/gtest.h>

#include <cmath>

#include "laterna/turntable.h"
#include "reference/everything.h"
#include "reference/shapes.h"
#include "scene/key_frames.h"
#include "scene/md2_frames.h"
#include "scene/scene_pose.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;
using reference::make_renderer;
using reference::same_bits;

std::vector<double> sampled(const KeyFrames& keys, double time, std::size_t components,
                            bool is_rotation = false) {
  std::vector<double> values(components);
  sample_keys(keys, time, is_rotation, values);
  return values;
}

TEST(KeyFrames, StepLinearAndCubicSplineFollowTheStandard) {
  const KeyFrames step{KeyInterpolation::step, {1, 2}, {10, 20}};
  const KeyFrames linear{KeyInterpolation::linear, {1, 2, 4}, {10, 20, 0}};
  // Values 10 and 20, leaving with slope 4 per second, arriving with slope −2.
  const KeyFrames cubic{KeyInterpolation::cubic_spline, {1, 3}, {0, 10, 4, -2, 20, 0}};
  EXPECT_EQ(sampled(step, 0, 1)[0], 10);
  EXPECT_EQ(sampled(step, 1.999, 1)[0], 10);
  EXPECT_EQ(sampled(step, 2, 1)[0], 20);
  EXPECT_EQ(sampled(step, 2 - 0.5e-9, 1)[0], 20) << "a rounded time does not miss a step";
  EXPECT_EQ(sampled(step, 9, 1)[0], 20);
  EXPECT_EQ(sampled(linear, 0.5, 1)[0], 10);
  EXPECT_DOUBLE_EQ(sampled(linear, 1.25, 1)[0], 12.5);
  EXPECT_DOUBLE_EQ(sampled(linear, 3, 1)[0], 10);
  // At the middle: ½ (10 + 20) + ⅛ · 2 s · (4 + 2).
  EXPECT_DOUBLE_EQ(sampled(cubic, 2, 1)[0], 16.5);
  EXPECT_EQ(sampled(cubic, 1, 1)[0], 10);
  EXPECT_EQ(sampled(cubic, 3, 1)[0], 20);
}

TEST(KeyFrames, RotationsTakeTheShorterArcAtEvenSpeed) {
  const double half = std::sqrt(0.5);
  const glm::dvec4 none(0, 0, 0, 1), quarter(0, half, 0, half);
  for (const double t : {0.0, 0.25, 0.5, 1.0}) {
    const double angle = t * M_PI / 4;  // half of the rotation's
    for (const glm::dvec4& to : {quarter, -quarter}) {
      const glm::dvec4 q = slerp(none, to, t);
      EXPECT_NEAR(q.y, std::sin(angle), 1e-15);
      EXPECT_NEAR(q.w, std::cos(angle), 1e-15);
    }
  }
  const glm::dvec4 near(0, 1e-12, 0, 1);
  EXPECT_NEAR(slerp(none, near, 0.5).y, 5e-13, 1e-20);
  const KeyFrames through_zero{KeyInterpolation::cubic_spline, {0, 1}, {0, 0, 0, 0, 0, 0, 0, 1,  0, 0, 0, 0,
                                                                        0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0}};
  EXPECT_EQ(sampled(through_zero, 0.5, 4, true), (std::vector<double>{0, 0, 0, 1}));
}

TEST(KeyFrames, ClipsLoopHoldOrTurnBack) {
  Clip clip;
  EXPECT_EQ(clip_time(clip, 2, 5), 1);
  EXPECT_EQ(clip_time(clip, 2, -0.5), 1.5);
  EXPECT_EQ(clip_time(clip, 0, 3), 0);
  clip.at_end = AtEnd::hold;
  EXPECT_EQ(clip_time(clip, 2, 5), 2);
  EXPECT_EQ(clip_time(clip, 2, -1), 0);
  clip.at_end = AtEnd::ping_pong;
  EXPECT_EQ(clip_time(clip, 2, 3), 1);
  EXPECT_EQ(clip_time(clip, 2, 4.5), 0.5);
}

// A triangle, and what a test adds to it, with key frames at 0 and 1 second.
class AnimatedGltf {
 public:
  AnimatedGltf() : builder(triangle_builder()) { times = builder.floats({0, 1}, "SCALAR"); }

  /// A channel of the only clip.
  void animate(const json& target, int output, const std::string& interpolation = "LINEAR") {
    json& clips = builder.document["animations"];
    if (clips.empty())
      clips.push_back({{"name", "go"}, {"channels", json::array()}, {"samplers", json::array()}});
    json& clip = clips[0];
    clip["channels"].push_back({{"sampler", clip["samplers"].size()}, {"target", target}});
    clip["samplers"].push_back({{"input", times}, {"output", output}, {"interpolation", interpolation}});
  }
  void point_at(const std::string& pointer, int output) {
    animate({{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}},
            output);
  }
  [[nodiscard]] Scene at(double time) const {
    const TemporaryFolder folder;
    Scene scene = builder.load(folder);
    EXPECT_EQ(warnings_of(scene), "");
    ScenePose(scene).apply(scene, time);
    EXPECT_TRUE(validate(scene).empty());
    return scene;
  }

  GltfBuilder builder;
  int times;
};

TEST(GltfAnimation, NodesMoveByTheirParts) {
  AnimatedGltf file;
  file.builder.document["nodes"][0]["scale"] = {1, 1, 3};
  file.animate({{"node", 0}, {"path", "translation"}}, file.builder.floats({0, 0, 0, 2, 4, 6}, "VEC3"));
  // Quaternions as signed bytes: a half turn about y.
  file.animate({{"node", 0}, {"path", "rotation"}},
               file.builder.accessor<std::int8_t>({0, 0, 0, 127, 0, 127, 0, 0}, "VEC4", kI8, true));
  const glm::dmat4 matrix = file.at(0.5).nodes[0].parent_from_node;
  EXPECT_EQ(glm::dvec3(matrix[3]), glm::dvec3(1, 2, 3));
  EXPECT_NEAR(matrix[0].z, -1, 1e-15) << "a quarter turn";
  EXPECT_NEAR(matrix[2].x, 3, 1e-15) << "the scale stays";
}

TEST(GltfAnimation, PointersMoveCamerasLightsAndMaterials) {
  AnimatedGltf file;
  json& document = file.builder.document;
  document["materials"] = json::parse(R"([{"emissiveFactor": [0.5, 0, 0],
      "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}}}])");
  document["meshes"][0]["primitives"][0]["material"] = 0;
  document["cameras"] = json::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}])");
  document["extensions"] =
      json::parse(R"({"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {}, "range": 5}]}})");
  document["nodes"].push_back({{"camera", 0}});
  for (int i = 0; i < 2; ++i)
    document["nodes"].push_back(json::parse(R"({"extensions": {"KHR_lights_punctual": {"light": 0}}})"));
  file.point_at("/cameras/0/perspective/yfov", file.builder.floats({1, 2}, "SCALAR"));
  file.point_at("/extensions/KHR_lights_punctual/lights/0/intensity", file.builder.floats({0, 10}, "SCALAR"));
  file.point_at("/extensions/KHR_lights_punctual/lights/0/color",
                file.builder.floats({0, 0, 0, 1, 0.5F, 0}, "VEC3"));
  file.point_at("/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle",
                file.builder.floats({0.2F, 0.6F}, "SCALAR"));
  file.point_at("/materials/0/pbrMetallicRoughness/baseColorFactor",
                file.builder.floats({0, 0, 0, 1, 1, 1, 1, 1}, "VEC4"));
  file.point_at("/materials/0/emissiveFactor", file.builder.floats({0, 0, 0, 1, 1, 1}, "VEC3"));
  file.point_at("/nodes/0/translation", file.builder.floats({0, 0, 0, 1, 0, 0}, "VEC3"));
  const Scene scene = file.at(0.5);
  EXPECT_NEAR(scene.cameras[0].projection.yfov().in_radians(), 1.5, 1e-12);
  ASSERT_EQ(scene.lights.size(), 2U) << "a light on two nodes is two";
  for (const Light& light : scene.lights) {
    EXPECT_DOUBLE_EQ(light.intensity, 5);
    EXPECT_EQ(light.color, glm::vec3(0.5F, 0.25F, 0));
    EXPECT_NEAR(light.outer_cone.in_radians(), 0.4, 1e-7);
  }
  EXPECT_EQ(scene.materials[0].base_color, glm::vec4(0.5F, 0.5F, 0.5F, 1));
  EXPECT_EQ(scene.materials[0].emissive, glm::vec3(2)) << "its strength is a factor on it";
  EXPECT_DOUBLE_EQ(scene.nodes[0].parent_from_node[3].x, 0.5);
}

std::string faults_of(const Scene& scene) {
  std::string all;
  for (const Diagnostic& fault : validate(scene)) all += to_string(fault) + "\n";
  return all;
}

// What a still light is refused for, no clip may make of it.
TEST(GltfAnimation, LightsStayOfAKindThatCanBeDrawn) {
  Scene scene;
  Light light;
  light.type = LightType::projector;
  light.distortion.k1 = -0.1;
  scene.lights.push_back(light);
  Clip clip;
  clip.keys = {{KeyInterpolation::linear, {0, 1}, {0.4, 2.9}}};
  clip.channels = {{AnimatedProperty::yfov, 0, true, 0, 0}};
  scene.clips = {clip};
  Node node;
  node.light = 0;
  scene.nodes.push_back(node);
  EXPECT_NE(faults_of(scene).find("the lens distorts its frame as it is"), std::string::npos);
  scene.lights[0] = Light();
  scene.lights[0].type = LightType::spot;
  scene.lights[0].outer_cone = Angle::degrees(85);
  scene.lights[0].shadow.layout = ShadowLayout::dual_paraboloid;
  scene.clips[0].channels[0] = {AnimatedProperty::outer_cone, 0, true, 0, 0};
  EXPECT_NE(faults_of(scene), "");
  scene.clips[0].keys[0].values = {1.45, 1.5};
  EXPECT_EQ(faults_of(scene), "");
}

TEST(GltfAnimation, TextureTransformsMoveByTheirParts) {
  AnimatedGltf file;
  const TemporaryFolder folder;
  json& document = file.builder.document;
  document["images"] = json::parse(R"([{"uri": "data:image/png;base64,AAAA"}])");
  document["textures"] = json::parse(R"([{"source": 0}])");
  document["materials"] = json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0,
      "extensions": {"KHR_texture_transform": {"scale": [2, 4]}}}}}])");
  document["meshes"][0]["primitives"][0]["material"] = 0;
  document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] =
      file.builder.floats({0, 0, 1, 0, 0, 1}, "VEC2");
  file.point_at("/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/offset",
                file.builder.floats({0, 0, 1, 2}, "VEC2"));
  const std::array<float, 6> expected = {2, 0, 0.5F, 0, 4, 1};
  EXPECT_EQ(file.at(0.5).materials[0].base_color_texture.uv_from_mesh_uv, expected);
}

// Corner 0 of the only triangle, posed at half a second.
glm::vec3 posed_corner(const AnimatedGltf& file) {
  const reference::OwnedFrame owned = reference::make_frame(file.at(0.5));
  return owned.frame.corner_ws(0, 0);
}

TEST(GltfAnimation, MorphTargetsAndSkinsOfAnyWidth) {
  AnimatedGltf file;
  json& primitive = file.builder.document["meshes"][0]["primitives"][0];
  primitive["targets"] =
      json::array({{{"POSITION", file.builder.floats({0, 0, 8, 0, 0, 0, 0, 0, 0}, "VEC3")}}});
  file.animate({{"node", 0}, {"path", "weights"}}, file.builder.floats({0, 1}, "SCALAR"));
  EXPECT_EQ(posed_corner(file), glm::vec3(0, 0, 4));
  // Two sets of joints: bytes and shorts. Joint 1, moved by 100 in x, pulls by a fifth and by another fifth.
  std::vector<std::uint8_t> joints(12), weights(12, 0);
  std::vector<std::uint16_t> more_joints(12), more_weights(12, 0);
  for (std::size_t v = 0; v < 3; ++v) {
    weights[4 * v] = 153;  // 0.6
    joints[4 * v + 1] = 1, weights[4 * v + 1] = 51;
    more_joints[4 * v + 2] = 1, more_weights[4 * v + 2] = 13107;
  }
  json& attributes = primitive["attributes"];
  attributes["JOINTS_0"] = file.builder.accessor(joints, "VEC4", kU8);
  attributes["WEIGHTS_0"] = file.builder.accessor(weights, "VEC4", kU8, true);
  attributes["JOINTS_1"] = file.builder.accessor(more_joints, "VEC4", kU16);
  attributes["WEIGHTS_1"] = file.builder.accessor(more_weights, "VEC4", kU16, true);
  file.builder.document["skins"] = json::parse(R"([{"joints": [1, 2]}])");
  file.builder.document["nodes"][0]["skin"] = 0;
  file.builder.document["nodes"][0]["translation"] = {7, 7, 7};  // of no effect
  file.builder.document["nodes"].push_back(json::object());
  file.builder.document["nodes"].push_back({{"translation", {100, 0, 0}}});
  const glm::vec3 corner = posed_corner(file);
  EXPECT_NEAR(corner.x, 40, 1e-5);
  EXPECT_EQ(corner.y, 0);
  EXPECT_NEAR(corner.z, 4, 1e-6);
}

TEST(Clips, AreChosenByName) {
  Scene scene;
  for (const char* name : {"walk", "run", "path"}) {
    scene.clips.emplace_back().name = name;
    scene.clips.back().is_path = std::string(name) == "path";
  }
  const auto playing = [&] {
    std::string names;
    for (const Clip& clip : scene.clips) names += clip.plays ? clip.name + " " : "";
    return names;
  };
  EXPECT_TRUE(choose_clip(scene, "run"));
  EXPECT_EQ(playing(), "run path ");
  EXPECT_TRUE(choose_clip(scene, "all"));
  EXPECT_EQ(playing(), "walk run path ");
  EXPECT_TRUE(choose_clip(scene, "none"));
  EXPECT_EQ(playing(), "path ");
  EXPECT_EQ(to_string(choose_clip(scene, "rum").error()),
            "the scene has no clip \"rum\" (did you mean \"run\"?): it has \"walk\", \"run\"");
}

TEST(Clips, OfVertexFramesAreFoundByTheirNames) {
  const std::vector<std::string> names = {"stand01", "stand02", "run1",    "run2",  "pain101",
                                          "pain102", "pain201", "death_1", "point", "run7"};
  std::string found;
  for (const FrameRun& run : find_frame_runs(names))
    found += run.name + " " + std::to_string(run.first) + "+" + std::to_string(run.count) + "; ";
  EXPECT_EQ(found, "stand 0+2; run 2+2; pain1 4+2; pain2 6+1; death 7+1; point 8+1; run.2 9+1; ");
}

// ---------------------------------------------------------------------------------------------- pictures

// A box that goes 1 m to the right in a second, over a floor, under a projector that goes the other way.
struct Stage {
  Scene scene;
  int floor = -1, box = -1;
};

Stage moving_box(bool casts_shadow = true) {
  Stage stage;
  stage.floor = reference::add_object(stage.scene, "floor", reference::floor(4));
  stage.box = reference::add_object(stage.scene, "box", reference::box({0, 0.5F, 0}, {0.4F, 0.4F, 0.4F}));
  Node& box = stage.scene.nodes[static_cast<std::size_t>(stage.box)];
  box.transform = Transform{};
  box.casts_shadow = casts_shadow;
  Light lamp;
  lamp.name = "lamp";
  lamp.type = LightType::projector;
  lamp.intensity = 60;
  lamp.shadow.resolution = 256;
  reference::add_light(stage.scene, lamp, {2, 5, 2}, {0, 0, 0});
  Clip& clip = stage.scene.clips.emplace_back();
  clip.name = "go";
  clip.keys.push_back({KeyInterpolation::linear, {0, 1}, {0, 0, 0, 1, 0, 0}});
  ClipChannel channel;
  channel.target = stage.box;
  channel.keys = 0;
  clip.channels.push_back(channel);
  return stage;
}

RenderSettings small_settings() {
  RenderSettings settings = reference::test_settings(80, 60);
  settings.layers = {Layer::visibility};
  return settings;
}

const View kView = reference::look({3, 4, 5}, {0, 0, 0}, 45, 80.0 / 60);

TEST(Posing, APictureIsThatOfARendererMadeAtTheTime) {
  for (const bool casts_shadow : {true, false}) {
    const Stage stage = moving_box(casts_shadow);
    Renderer moving = make_renderer(stage.scene);
    std::optional<LayeredImage> at_rest;
    for (const double time : {0.0, 0.25, 0.8, 0.3}) {
      ASSERT_TRUE(moving.set_time(time));
      RendererOptions options;
      options.time = time;
      const Renderer fresh = Renderer::create(stage.scene, options).value();
      const LayeredImage picture = reference::render(moving, kView, small_settings());
      EXPECT_TRUE(same_bits(picture, reference::render(fresh, kView, small_settings())));
      EXPECT_FALSE(at_rest && same_bits(picture, *at_rest)) << "it does move";
      if (!at_rest) at_rest = picture;
    }
  }
}

// Rows 77 and 105.
TEST(Posing, OnlyWhatMovesIsMadeAnew) {
  for (const bool casts_shadow : {true, false}) {
    Renderer renderer = make_renderer(moving_box(casts_shadow).scene);
    const auto draw = [&] {
      RenderStatistics statistics;
      EXPECT_TRUE(renderer.render(kView, small_settings(), {}, &statistics));
      return statistics;
    };
    EXPECT_EQ(draw().maps_drawn, 1);
    ASSERT_TRUE(renderer.set_time(0.5));
    const RenderStatistics moved = draw();
    EXPECT_EQ(moved.maps_drawn, casts_shadow ? 1 : 0);
    EXPECT_EQ(moved.maps_kept, casts_shadow ? 0 : 1);
    EXPECT_EQ(renderer.posing_statistics().primitives_posed, 1U) << "the box, not the floor";
    EXPECT_EQ(renderer.posing_statistics().vertices_posed, 24U);
    EXPECT_EQ(renderer.posing_statistics().casters_moved, casts_shadow ? 1U : 0U);
    ASSERT_TRUE(renderer.set_time(0.5));
    EXPECT_EQ(draw().maps_kept, 1);
    EXPECT_EQ(renderer.posing_statistics().primitives_posed, 1U) << "nothing has moved";
  }
}

TEST(Posing, WhatLeavesTheWorldIsRefusedAndStays) {
  Stage stage = moving_box();
  stage.scene.clips[0].keys[0].values[3] = 3e9;
  stage.scene.clips[0].at_end = AtEnd::hold;
  Renderer renderer = make_renderer(stage.scene);
  const LayeredImage before = reference::render(renderer, kView, small_settings());
  const Result<int> moved = renderer.set_time(0.9);
  ASSERT_FALSE(moved);
  EXPECT_EQ(to_string(moved.error()), "object \"box\": lies farther than 1e9 m from the origin");
  EXPECT_EQ(renderer.time(), 0);
  EXPECT_TRUE(same_bits(reference::render(renderer, kView, small_settings()), before));
}

TEST(Posing, ALightThatIsReplacedStillMoves) {
  Stage stage = moving_box();
  Clip& clip = stage.scene.clips[0];
  clip.keys.push_back({KeyInterpolation::linear, {0, 1}, {10, 30}});
  ClipChannel channel;
  channel.property = AnimatedProperty::intensity;
  channel.target = 0;
  channel.keys = 1;
  clip.channels.push_back(channel);
  Renderer renderer = make_renderer(stage.scene);
  EXPECT_EQ(renderer.scene().lights[0].intensity, 10);
  ASSERT_TRUE(renderer.set_time(0.5));
  Light red = stage.scene.lights[0];
  red.color = {1, 0, 0};
  ASSERT_TRUE(renderer.set_light(0, red));
  EXPECT_EQ(renderer.scene().lights[0].intensity, 20);
  EXPECT_EQ(renderer.scene().lights[0].color, glm::vec3(1, 0, 0));
}

TEST(Posing, ATurntableGoesRoundAndComesBack) {
  const View turned = turned_about(kView, {0, 1, 0}, 0.25);
  EXPECT_NEAR(turned.pose.position_ws.x, 5, 1e-12);
  EXPECT_NEAR(turned.pose.position_ws.y, 4, 1e-12);
  EXPECT_NEAR(turned.pose.position_ws.z, -3, 1e-12);
  EXPECT_NEAR(glm::dot(turned.pose.forward_ws(), glm::normalize(-turned.pose.position_ws)), 1, 1e-12);
  EXPECT_EQ(find_fault(turned.pose), "");
  EXPECT_EQ(turned_about(kView, {0, 1, 0}, 3).pose.position_ws, kView.pose.position_ws);
}

// ---------------------------------------------------------------------------------------------- paths of rigs

Scene rig_scene(const std::string& text) {
  const TemporaryFolder folder;
  return load_or_fail({folder.write("rig.json", text)});
}

Scene posed(Scene scene, double time) {
  ScenePose(scene).apply(scene, time);
  EXPECT_TRUE(validate(scene).empty());
  return scene;
}

TEST(RigPaths, CamerasGoSmoothlyThroughTheirKeys) {
  const Scene scene =
      rig_scene(R"({"cameras": [{"name": "main", "position": [0, 1, 5], "target": [0, 0, 0], "yfov_deg": 40,
    "path": {"keys": [{"time": 0, "position": [0, 1, 5]}, {"time": 1, "position": [2, 1, 5], "yfov_deg": 40},
                      {"time": 3, "position": [2, 1, 9], "yfov_deg": 60}]}}]})");
  ASSERT_EQ(scene.clips.size(), 1U);
  EXPECT_TRUE(scene.clips[0].is_path);
  EXPECT_EQ(scene.clips[0].name, "path of main");
  const auto at = [&](double time) { return posed(scene, time).nodes[0].parent_from_node; };
  EXPECT_EQ(glm::dvec3(at(0)[3]), glm::dvec3(0, 1, 5));
  EXPECT_EQ(glm::dvec3(at(1)[3]), glm::dvec3(2, 1, 5));
  EXPECT_EQ(glm::dvec3(at(9)[3]), glm::dvec3(2, 1, 9)) << "the last key holds";
  // Slopes at the middle key: ((2, 0, 4) - 0) / 3 s; at the ends those of the chords, (2, 0, 0) and (0, 0, 2).
  const glm::dvec3 half = glm::dvec3(at(0.5)[3]);
  EXPECT_NEAR(half.x, 1 + 0.125 * (2 - 2.0 / 3), 1e-12);
  EXPECT_NEAR(half.z, 5 + 0.125 * (0 - 4.0 / 3), 1e-12);
  const glm::dmat4 pose = at(0.5);
  EXPECT_NEAR(glm::dot(-glm::dvec3(pose[2]), glm::normalize(-half)), 1, 1e-12) << "still at its target";
  EXPECT_NEAR(posed(scene, 2).cameras[0].projection.yfov().in_degrees(), 50, 1e-9);
}

TEST(RigPaths, LightsChangeWithoutOvershooting) {
  const Scene scene = rig_scene(R"({"lights": [{"type": "point", "position": [0, 2, 0], "candela": 5,
    "path": {"at_end": "loop", "keys": [{"time": 0, "candela": 0}, {"time": 1, "candela": 10}, {"time": 2, "candela": 10},
             {"time": 3, "candela": 0, "color": [1, 0, 0]}]}}]})");
  for (int i = 0; i <= 60; ++i) {
    const double candela = posed(scene, 0.05 * i).lights[0].intensity;
    EXPECT_GE(candela, 0);
    EXPECT_LE(candela, 10);
  }
  EXPECT_DOUBLE_EQ(posed(scene, 1.5).lights[0].intensity, 10);
  EXPECT_DOUBLE_EQ(posed(scene, 4).lights[0].intensity, 10) << "one second into the second round";
}

TEST(RigPaths, LinearAndStepKeysAndPointLightsThatMove) {
  const auto scene = [](const std::string& interpolation) {
    return rig_scene(
        R"({"lights": [{"name": "fly", "type": "point", "position": [0, 2, 0], "path": {"interpolation": ")" +
        interpolation +
        R"(", "keys": [{"time": 1, "position": [0, 2, 0]}, {"time": 2, "position": [4, 2, 0]}]}}]})");
  };
  EXPECT_EQ(posed(scene("linear"), 1.25).nodes[0].parent_from_node[3].x, 1);
  EXPECT_EQ(posed(scene("step"), 1.75).nodes[0].parent_from_node[3].x, 0);
  EXPECT_EQ(posed(scene("step"), 2).nodes[0].parent_from_node[3].x, 4);
}

}  // namespace
}  // namespace laterna
