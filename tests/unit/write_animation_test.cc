// Clips, skins and morph targets written as glTF and read again: everything is at every time where it was.
#include <gtest/gtest.h>

#include <fmt/ranges.h>
#include <fstream>
#include <nlohmann/json.hpp>

#include "laterna/lamps.h"
#include "laterna/material_lobes.h"
#include "laterna/write_scene.h"
#include "reference/scene_differences.h"
#include "unit/temporary_folder.h"

namespace laterna {
namespace {

using P = AnimatedProperty;

// Numbers that single precision holds: what is read is what was written.
std::vector<double> steps(std::size_t count, double from, double step = 0.0625) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(from + step * static_cast<double>(i % 5));
  return values;
}

void add_channel(Clip& clip, P property, int target, KeyFrames keys, bool of_light = false, int texture = 0) {
  ClipChannel channel;
  channel.property = property;
  channel.target = target;
  channel.of_light = of_light;
  channel.texture = texture;
  channel.keys = static_cast<int>(clip.keys.size());
  clip.keys.push_back(std::move(keys));
  clip.channels.push_back(channel);
}

Primitive ribbon() {
  Primitive ribbon;
  ribbon.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  ribbon.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  ribbon.indices = {0, 1, 2};
  ribbon.material = 0;
  return ribbon;
}

// One of everything that clips move.
Scene moving_scene() {
  Scene scene;
  Material material;
  material.lobes = std::make_shared<MaterialLobes>();
  material.alpha_mode = AlphaMode::mask;
  scene.materials.push_back(material);
  Primitive skin = ribbon(), morph = ribbon();
  skin.influences = 6;  // more than one set of four
  skin.joints = {0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0};
  skin.joint_weights = {0.5F, 0.25F, 0, 0, 0, 0.25F, 1, 0, 0, 0, 0, 0, 0.75F, 0.25F, 0, 0, 0, 0};
  morph.targets = {{{{0, 0, 1}, {0, 0, 2}, {0, 0, 0}}, {{0, 1, 0}, {0, 0, 0}, {0, 0, 0}}, {}}, {}};
  scene.meshes = {{"skin", {skin}}, {"morph", {morph}}};
  for (const char* name :
       {"root", "hip", "knee", "skinned", "morphed", "camera", "flat camera", "lantern", "spot"}) {
    Node node;
    node.name = name;
    node.transform = Transform{};
    scene.nodes.push_back(node);
  }
  scene.nodes[2].parent = 1;
  scene.nodes[3].mesh = 0;
  scene.nodes[3].skin = 0;
  scene.nodes[4].mesh = 1;
  scene.nodes[4].weights = {0.5F, 0};
  glm::dmat4 bind(1.0);
  bind[3] = {0, -0.5, 0.25, 1};
  scene.skins.push_back({"legs", {1, 2}, {glm::dmat4(1.0), bind}});
  Camera flat;
  flat.name = "flat camera";
  flat.projection = Projection::orthographic(2, 1, 0, 8);
  flat.aspect_from_picture = false;
  Camera camera;
  camera.name = "camera";
  camera.aspect_from_picture = false;
  camera.projection = Projection::perspective(Angle::radians(1), 1.5, 0.125, 64);
  scene.cameras = {camera, flat};
  scene.nodes[5].camera = 0;
  scene.nodes[6].camera = 1;
  Light lantern, spot;
  lantern.name = "lantern";
  lantern.type = LightType::projector;
  lantern.aspect_from_slide = false;
  lantern.projection = Projection::perspective(Angle::radians(0.5), 1.5, 0.125, 64);
  spot.name = "spot";
  spot.type = LightType::spot;
  spot.range = 32;
  scene.lights = {lantern, spot};
  scene.nodes[7].light = 0;
  scene.nodes[8].light = 1;

  Clip walk;
  walk.name = "walk";
  const auto linear = [](std::size_t components, double from) {
    return KeyFrames{KeyInterpolation::linear, {0, 0.5, 2}, steps(3 * components, from)};
  };
  add_channel(walk, P::translation, 1, {KeyInterpolation::cubic_spline, {0, 2}, steps(18, -0.5)});
  add_channel(walk, P::rotation, 2, {KeyInterpolation::linear, {0.25, 2}, {0, 0, 0, 1, 0, 1, 0, 0}});
  add_channel(walk, P::scale, 1, {KeyInterpolation::step, {0, 1}, steps(6, 1)});
  add_channel(walk, P::weights, 4, linear(2, 0.25));
  for (const bool of_light : {false, true}) {
    add_channel(walk, P::yfov, 0, linear(1, 0.75), of_light);
    add_channel(walk, P::near, 0, linear(1, 0.25), of_light);
    add_channel(walk, P::far, 0, linear(1, 32), of_light);
  }
  add_channel(walk, P::x_extent, 1, linear(1, 2));
  add_channel(walk, P::y_extent, 1, linear(1, 2));
  add_channel(walk, P::light_color, 0, linear(3, 0.25), true);
  add_channel(walk, P::intensity, 0, linear(1, 100), true);
  add_channel(walk, P::range, 1, linear(1, 16), true);
  add_channel(walk, P::outer_cone, 1, linear(1, 0.5), true);
  for (const P property : {P::base_color, P::metallic, P::roughness, P::alpha_cutoff, P::normal_scale,
                           P::clearcoat, P::sheen_color, P::transmission, P::ior}) {
    add_channel(
        walk, property, 0,
        linear(static_cast<std::size_t>(component_count(property)), property == P::ior ? 1.25 : 0.25));
  }
  Clip run = walk;
  run.name = "run";
  run.plays = false;
  run.at_end = AtEnd::hold;
  for (KeyFrames& keys : run.keys) {
    for (double& time : keys.times) time *= 0.5;
  }
  scene.clips = {walk, run};
  return scene;
}

Scene carried(const Scene& scene, const std::filesystem::path& file) {
  const Result<std::vector<Diagnostic>> written = write_scene(scene, file);
  EXPECT_TRUE(written) << to_string(written.error());
  if (written) {
    for (const Diagnostic& warning : *written) ADD_FAILURE() << to_string(warning);
  }
  Result<Scene> read = load_scene(std::vector<std::filesystem::path>{file});
  EXPECT_TRUE(read) << to_string(read.error());
  return read ? std::move(*read) : Scene();
}

Scene posed(Scene scene, double time) {
  pose_scene(scene, time);
  return scene;
}

TEST(WriteAnimation, EverythingIsWhereItWas) {
  const TemporaryFolder folder;
  const Scene scene = moving_scene();
  ASSERT_TRUE(validate(scene).empty()) << to_string(validate(scene).front());
  for (const char* name : {"a.glb", "a.gltf"}) {
    Scene again = carried(scene, folder / name);
    ASSERT_EQ(again.clips.size(), 2U);
    EXPECT_TRUE(again.clips[0].plays && !again.clips[1].plays);
    EXPECT_EQ(again.clips[1].at_end, AtEnd::hold);
    ASSERT_EQ(again.skins.size(), 1U);
    EXPECT_EQ(again.skins[0].joints, scene.skins[0].joints);
    EXPECT_EQ(again.skins[0].joint_from_bind, scene.skins[0].joint_from_bind);
    const Primitive &skin = again.meshes[0].primitives[0], &morph = again.meshes[1].primitives[0];
    ASSERT_EQ(skin.influences, 8);
    for (std::size_t v = 0; v < 3; ++v) {
      for (std::size_t k = 0; k < 6; ++k)
        EXPECT_EQ(skin.joint_weights[8 * v + k], scene.meshes[0].primitives[0].joint_weights[6 * v + k]);
    }
    ASSERT_EQ(morph.targets.size(), 2U);
    EXPECT_EQ(morph.targets[0].positions, scene.meshes[1].primitives[0].targets[0].positions);
    EXPECT_EQ(morph.targets[0].normals, scene.meshes[1].primitives[0].targets[0].normals);
    Scene before = scene;
    for (const char* clip : {"walk", "run"}) {
      ASSERT_TRUE(choose_clip(before, clip));
      ASSERT_TRUE(choose_clip(again, clip));
      for (const double time : {0.0, 0.3, 1.0, 1.7, 2.6}) {
        const Scene a = posed(before, time), b = posed(again, time);
        EXPECT_EQ(fmt::format("{}", fmt::join(reference::differences(a, b), "\n")), "")
            << clip << " at " << time;
        EXPECT_EQ(a.nodes[4].weights, b.nodes[4].weights);
        EXPECT_EQ(a.nodes[2].parent_from_node, b.nodes[2].parent_from_node);
      }
    }
  }
}

// Single precision holds no twenty-fourth of a second: the cut must not come after it.
TEST(WriteAnimation, CutsFallOnTheirFrames) {
  const TemporaryFolder folder;
  folder.write("rig.json",
               std::string_view(R"({"lights": [{"name": "spot", "type": "spot", "position": [0, 2, 0],
    "target": [0, 0, 0], "lumens": 500, "path": {"interpolation": "step", "keys": [
    {"time": 0, "lumens": 500}, {"time": 0.041666666666666664, "lumens": 20}]}}]})"));
  const Scene scene = load_scene(std::vector<std::filesystem::path>{folder / "rig.json"}).value();
  const Scene again = carried(scene, folder / "a.gltf");
  for (const double time : {0.0, 0.04, 1.0 / 24, 0.05})
    EXPECT_EQ(
        fmt::format("{}", fmt::join(reference::differences(posed(scene, time), posed(again, time)), "\n")),
        "")
        << time;
  // What is animated is in the file.
  const auto file = nlohmann::json::parse(std::ifstream(folder / "a.gltf"));
  const auto pointer =
      file["animations"][0]["channels"][0]["target"]["extensions"]["KHR_animation_pointer"]["pointer"];
  EXPECT_EQ(file.at(nlohmann::json::json_pointer(pointer.get<std::string>())), 500);
}

// What is done to one node's surface leaves the clips of a material that others share.
TEST(WriteAnimation, CopiesOfMaterialsAreAnimatedToo) {
  const TemporaryFolder folder;
  Scene scene;
  scene.materials.emplace_back();
  Primitive flat = ribbon();
  flat.positions[2] = {0, 1, 0};
  scene.meshes = {{"flat", {flat}}};
  for (const char* name : {"one", "other"}) {
    Node node;
    node.name = name;
    node.mesh = 0;
    scene.nodes.push_back(node);
  }
  Clip clip;
  add_channel(clip, P::metallic, 0, {KeyInterpolation::linear, {0, 1}, {0, 1}});
  scene.clips = {clip};
  carried(scene, folder / "a.gltf");
  folder.write("rig.json", std::string_view(R"({"surfaces": [{"node": "one", "mirror": {}}]})"));
  const Result<Scene> read = load_scene({folder / "a.gltf", folder / "rig.json"});
  ASSERT_TRUE(read) << to_string(read.error());
  const Scene half = posed(*read, 0.5);
  ASSERT_EQ(half.materials.size(), 2U);
  for (const Material& material : half.materials) EXPECT_FLOAT_EQ(material.metallic, 0.5F);
}

// Measured lamps have no place in glTF's list of lights, so that nothing can point at them.
TEST(WriteAnimation, WarningsNameWhatStandsStill) {
  const TemporaryFolder folder;
  Scene scene;
  Node node;
  node.name = "stand";
  node.light = 0;
  scene.nodes.push_back(node);
  Light lamp;
  lamp.name = "downlight";
  lamp.type = LightType::point;
  LightDistribution measured;
  measured.vertical_deg = {0, 180};
  measured.horizontal_deg = {0, 360};
  measured.candela = {100, 50, 100, 50};
  lamp.distribution = std::make_shared<const LightDistribution>(measured);
  scene.lights.push_back(lamp);
  Clip clip;
  clip.name = "dusk";
  add_channel(clip, P::intensity, 0, {KeyInterpolation::linear, {0, 1}, {1, 0.5}}, true);
  scene.clips.push_back(clip);
  const Result<std::vector<Diagnostic>> written = write_scene(scene, folder.path() / "a.gltf");
  ASSERT_TRUE(written) << to_string(written.error());
  std::string said;
  for (const Diagnostic& warning : *written) said += warning.message + "\n";
  EXPECT_NE(said.find("clip \"dusk\": glTF has no name for intensity of the light \"downlight\": it stands "
                      "still in the file"),
            std::string::npos)
      << said;
}

// A rig's paths lead gazes, which glTF has not: others get places and turns on the way.
TEST(WriteAnimation, GazesAreThereForOthersToo) {
  const TemporaryFolder folder;
  folder.write("rig.json",
               std::string_view(R"({"cameras": [{"name": "main", "position": [0, 2, 6], "target": [0, 1, 0],
    "yfov_deg": 40, "path": {"at_end": "ping_pong", "keys": [{"time": 0, "position": [0, 2, 6]},
                             {"time": 2, "position": [4, 2, 5], "target": [0.5, 1, 0]}, {"time": 3, "position": [5, 3, 1]}]}}]})"));
  const Scene scene = load_scene(std::vector<std::filesystem::path>{folder / "rig.json"}).value();
  const Scene again = carried(scene, folder / "a.gltf");
  ASSERT_EQ(again.clips.size(), 1U);
  EXPECT_TRUE(again.clips[0].is_path);
  EXPECT_EQ(again.clips[0].at_end, AtEnd::ping_pong);
  Scene of_others = again;
  std::erase_if(of_others.clips[0].channels, [](const ClipChannel& c) { return c.property == P::look_at; });
  EXPECT_EQ(of_others.clips[0].channels.size(), again.clips[0].channels.size() - 1);
  for (const double time : {0.0, 0.31, 1.0, 2.2, 3.0, 4.1}) {
    const glm::dmat4 a = posed(scene, time).nodes[0].parent_from_node,
                     b = posed(again, time).nodes[0].parent_from_node,
                     c = posed(of_others, time).nodes[0].parent_from_node;
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) {
        EXPECT_NEAR(a[column][row], b[column][row], 1e-6) << time;
        EXPECT_NEAR(a[column][row], c[column][row], 5e-3)
            << time;  // between places 1/16 of a key's time apart
      }
    }
  }
  // What is written a second time is the same: the way of a gaze is not taken for another movement.
  const Scene third = carried(again, folder / "b.gltf");
  EXPECT_EQ(third.clips[0].channels.size(), again.clips[0].channels.size());
  const auto file = nlohmann::json::parse(std::ifstream(folder / "b.gltf"));
  EXPECT_EQ(file["extensionsUsed"], nlohmann::json({"KHR_animation_pointer", "LATERNA_lighting"}));
}

}  // namespace
}  // namespace laterna
