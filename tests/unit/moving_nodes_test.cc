// What rigs and files move in a scene: nodes along paths, projectors that a converted file holds, one large skin.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "laterna/write_scene.h"
#include "reference/everything.h"
#include "reference/projector_scenes.h"
#include "scene/node_path.h"
#include "scene/scene_pose.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

// A triangle on a node "kite" that hangs on "string".
GltfBuilder kite() {
  GltfBuilder builder = triangle_builder();
  json& nodes = builder.document["nodes"];
  nodes[0]["name"] = "kite";
  nodes[0]["scale"] = {2, 2, 2};
  nodes.push_back({{"name", "string"}, {"translation", {0, 10, 0}}, {"children", {0}}});
  builder.document["scenes"] = json::parse(R"([{"nodes": [1]}])");
  return builder;
}

Result<Scene> with_rig(const TemporaryFolder& folder, const GltfBuilder& file, const std::string& nodes) {
  return load_scene(
      {folder.write("s.gltf", file.text()), folder.write("r.json", R"({"nodes": )" + nodes + "}")});
}

glm::dmat4 place_of(Scene scene, const std::string& name, double time) {
  ScenePose(scene).apply(scene, time);
  EXPECT_TRUE(validate(scene).empty());
  const std::vector<glm::dmat4> places = world_from_nodes(scene);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (scene.nodes[i].name == name) return places[i];
  }
  ADD_FAILURE() << name;
  return glm::dmat4(1);
}

TEST(NodePaths, MoveANodeAndAllThatHangsOnIt) {
  const TemporaryFolder folder;
  const Scene scene =
      with_rig(folder, kite(), R"([{"name": "string", "path": {"interpolation": "linear", "keys": [
      {"time": 1, "translation": [0, 10, 0]}, {"time": 3, "translation": [4, 12, 0]}]}}])")
          .value();
  ASSERT_EQ(scene.clips.size(), 1U);
  EXPECT_EQ(scene.clips[0].name, "path of string");
  EXPECT_TRUE(scene.clips[0].is_path);
  const glm::dmat4 kite_at_2 = place_of(scene, "kite", 2);
  EXPECT_EQ(glm::dvec3(kite_at_2[3]), glm::dvec3(2, 11, 0));
  EXPECT_EQ(kite_at_2[0].x, 2) << "its own scale stays";
  EXPECT_EQ(glm::dvec3(place_of(scene, "kite", 0)[3]), glm::dvec3(0, 10, 0));
  EXPECT_EQ(glm::dvec3(place_of(scene, "kite", 99)[3]), glm::dvec3(4, 12, 0)) << "past its end it holds";
}

// Half turns one after the other, written so that each quaternion is far from the one before it: the turn goes on.
TEST(NodePaths, RotationsGoOnAndNumbersMayBeInSomeKeysOnly) {
  const TemporaryFolder folder;
  const std::string keys = R"("keys": [{"time": 0, "rotation": [0, 0, 0, 1], "scale": [1, 1, 1]},
      {"time": 1, "rotation": [0, -0.70710678118654752, 0, -0.70710678118654752]},
      {"time": 2, "rotation": [0, 2, 0, 0], "scale": [3, 3, 3]}])";
  for (const char* interpolation : {"linear", "smooth"}) {
    const Scene scene = with_rig(folder, kite(),
                                 std::string(R"([{"name": "kite", "path": {"interpolation": ")") +
                                     interpolation + R"(", )" + keys + "}}]")
                            .value();
    const glm::dmat4 quarter = place_of(scene, "kite", 1);
    EXPECT_NEAR(quarter[0].z, -2, 1e-12) << "X has turned to -Z; the scale is half way from 1 to 3";
    EXPECT_NEAR(quarter[2].x, 2, 1e-12);
    EXPECT_NEAR(place_of(scene, "kite", 2)[0].x, -3, 1e-12);
    EXPECT_EQ(quarter[3].y, 10) << "no key says where it is";
  }
  Scene linear =
      with_rig(folder, kite(), R"([{"name": "kite", "path": {"interpolation": "linear", )" + keys + "}}]")
          .value();
  const glm::dmat4 eighth = place_of(linear, "kite", 0.5);
  EXPECT_NEAR(std::atan2(-eighth[0].z, eighth[0].x), M_PI / 4, 1e-12);
}

TEST(NodePaths, MatricesAreTakenApart) {
  Transform moved{{1, -2, 3}, {0.1, -0.7, 0.5, 0.5}, {2, 0.5, 3}};
  moved.rotation /= std::sqrt(0.01 + 0.49 + 0.25 + 0.25);
  for (const double side : {1.0, -1.0}) {
    moved.scale.x = 2 * side;
    for (const glm::dvec4& turn : {moved.rotation, glm::dvec4(1, 0, 0, 0), glm::dvec4(0, 1, 0, 0),
                                   glm::dvec4(0, 0, 1, 0), glm::dvec4(0, 0, 0, 1)}) {
      moved.rotation = turn;
      const glm::dmat4 matrix = to_matrix(moved);
      const std::optional<Transform> parts = decompose(matrix);
      ASSERT_TRUE(parts);
      const glm::dmat4 again = to_matrix(*parts);
      for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) EXPECT_NEAR(again[column][row], matrix[column][row], 1e-12);
    }
  }
  glm::dmat4 sheared(1);
  sheared[1].x = 0.5;
  EXPECT_FALSE(decompose(sheared));
  EXPECT_FALSE(decompose(glm::dmat4(0)));
}

std::string messages(const GltfBuilder& file, const std::string& nodes) {
  const TemporaryFolder folder;
  return messages_of(with_rig(folder, file, nodes), folder.path());
}

TEST(NodePaths, SayWhatIsWrong) {
  const auto path = [](const std::string& keys) {
    return R"([{"name": "kite", "path": {"keys": [)" + keys + "]}}]";
  };
  const std::string at = "r.json: line 1: nodes[0].path.keys";
  EXPECT_EQ(messages(kite(), path(R"({"time": 0, "position": [0, 0, 0]})")),
            at + "[0].position: a key has no key \"position\"");
  EXPECT_EQ(messages(kite(), path(R"({"time": 0, "rotation": [0, 0, 0, 0]})")),
            at + "[0].rotation: expected a unit quaternion, got one without length");
  EXPECT_EQ(messages(kite(), path(R"({"time": 3}, {"time": 2})")),
            at + "[1].time: 2 s does not come after the key before it, at 3 s");
  const std::string sound = R"("path": {"keys": [{"time": 0, "translation": [0, 0, 0]}]}}])";
  EXPECT_EQ(messages(kite(), R"([{"name": "kit", )" + sound),
            "r.json: line 1: nodes[0].name: the scene has no node named \"kit\" (did you mean \"kite\"?)");
  GltfBuilder twins = kite();
  twins.document["nodes"][1]["name"] = "kite";
  EXPECT_EQ(
      messages(twins, R"([{"name": "kite", )" + sound),
      "r.json: line 1: nodes[0].name: nodes[0] and nodes[1] are both called \"kite\": a path moves one node");
  GltfBuilder sheared = kite();
  sheared.document["nodes"][0].erase("scale");
  sheared.document["nodes"][0]["matrix"] = {1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_EQ(messages(sheared, R"([{"name": "kite", )" + sound),
            "r.json: line 1: nodes[0].name: the matrix of \"kite\" shears or flattens: it does not move "
            "along paths");
}

// What `laterna convert` writes of a projector, with an animation that somebody adds to it.
TEST(AnimationPointers, MoveAProjectorOfAConvertedFile) {
  const TemporaryFolder folder;
  Scene scene;
  Light light = reference::projector("lamp", 1, 1);
  light.lumens = 100;
  light.aspect_from_slide = false;
  reference::add_light(scene, light, {0, 2, 5}, {0, 0, 0});
  reference::add_object(scene, "wall", reference::wall(1, 1, 0));
  ASSERT_TRUE(write_scene(scene, folder / "c.gltf"));
  std::ifstream stream(folder / "c.gltf");
  json document = json::parse(stream);
  GltfBuilder added;
  const int times = added.floats({0, 1}, "SCALAR");
  const std::pair<const char*, std::vector<float>> moves[] = {{"yfov", {0.5F, 1}},
                                                              {"aspectRatio", {1, 3}},
                                                              {"znear", {0.1F, 0.5F}},
                                                              {"zfar", {10, 30}},
                                                              {"luminousFlux", {100, 300}}};
  json animation = {{"channels", json::array()}, {"samplers", json::array()}};
  const std::size_t accessors = document["accessors"].size(), views = document["bufferViews"].size();
  for (const auto& [name, values] : moves) {
    const std::size_t output = accessors + static_cast<std::size_t>(added.floats(values, "SCALAR"));
    const std::string pointer =
        std::string("/extensions/KHR_lights_punctual/lights/0/extensions/LATERNA_projector/") + name;
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size()},
         {"target",
          {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}});
    animation["samplers"].push_back(
        {{"input", accessors + static_cast<std::size_t>(times)}, {"output", output}});
  }
  const json extra = added.embedded();
  for (json view : extra["bufferViews"]) {
    view["buffer"] = document["buffers"].size();
    document["bufferViews"].push_back(view);
  }
  for (json accessor : extra["accessors"]) {
    accessor["bufferView"] = accessor["bufferView"].get<std::size_t>() + views;
    document["accessors"].push_back(accessor);
  }
  document["buffers"].push_back(extra["buffers"][0]);
  document["animations"] = json::array({animation});
  document["extensionsUsed"].push_back("KHR_animation_pointer");
  Scene moving = load_or_fail({folder.write("moving.gltf", document.dump())});
  EXPECT_EQ(warnings_of(moving), "");
  ASSERT_EQ(moving.lights.size(), 1U);
  ScenePose(moving).apply(moving, 0.5);
  EXPECT_TRUE(validate(moving).empty());
  const Light& posed = moving.lights[0];
  EXPECT_NEAR(posed.projection.yfov().in_radians(), 0.75, 1e-7);
  EXPECT_NEAR(posed.projection.right / posed.projection.top, 2, 1e-6);
  EXPECT_NEAR(posed.projection.near, 0.3, 1e-7);
  EXPECT_NEAR(posed.projection.far, 20, 1e-6);
  EXPECT_NEAR(posed.lumens.value(), 200, 1e-4);
}

// A cloth of 100 × 100 quads that two joints wring: many clusters of one part.
Scene wrung_cloth() {
  constexpr std::uint32_t kSide = 100;
  Primitive p;
  p.influences = 2;
  for (std::uint32_t row = 0; row <= kSide; ++row) {
    for (std::uint32_t column = 0; column <= kSide; ++column) {
      const float u = static_cast<float>(column) / kSide, v = static_cast<float>(row) / kSide;
      p.positions.emplace_back(2 * u - 1, 2 * v - 1, 0);
      p.normals.emplace_back(0, 0, 1);
      p.joints.insert(p.joints.end(), {0, 1});
      p.joint_weights.insert(p.joint_weights.end(), {1 - u, u});
      if (row == kSide || column == kSide) continue;
      const std::uint32_t a = row * (kSide + 1) + column, b = a + kSide + 1;
      p.indices.insert(p.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  }
  Scene scene;
  const int cloth = reference::add_object(scene, "cloth", std::move(p));
  scene.materials[0].double_sided = true;
  scene.nodes[static_cast<std::size_t>(cloth)].skin = 0;
  Skin& skin = scene.skins.emplace_back();
  Clip& clip = scene.clips.emplace_back();
  const double half = std::sqrt(0.5);
  for (const double turn : {half, -half}) {
    const int joint = static_cast<int>(scene.nodes.size());
    scene.nodes.emplace_back().transform = Transform{};
    skin.joints.push_back(joint);
    skin.joint_from_bind.emplace_back(1.0);
    ClipChannel channel;
    channel.property = AnimatedProperty::rotation;
    channel.target = joint;
    channel.keys = static_cast<int>(clip.keys.size());
    clip.keys.push_back({KeyInterpolation::linear, {0, 1}, {0, 0, 0, 1, turn, 0, 0, half}});
    clip.channels.push_back(channel);
  }
  Light light = reference::projector("lamp", 1, 1);
  light.intensity = 20;
  reference::add_light(scene, light, {1, 1, 4}, {0, 0, 0});
  return scene;
}

TEST(NodePaths, WhatASkinPlacesDoesNotMove) {
  Scene scene = wrung_cloth();
  scene.nodes[1].name = "hip";
  EXPECT_EQ(add_node_path(scene, "cloth", {}),
            "the joints of its skin place \"cloth\": move those, such as \"hip\", or what they hang on");
  EXPECT_EQ(scene.clips.size(), 1U);
  EXPECT_EQ(add_node_path(scene, "hip", {}), "");
  EXPECT_EQ(scene.clips.size(), 2U);
}

TEST(LargeSkins, ArePosedAlikeOnAnyNumberOfThreads) {
  RenderSettings settings = reference::test_settings(64, 64);
  settings.layers = {Layer::position, Layer::normal};
  const View view = reference::look({0.5, 1, 4}, {0, 0, 0}, 40, 1);
  std::optional<LayeredImage> one;
  for (const int threads : {1, 2, 7}) {
    Renderer renderer = reference::make_renderer(wrung_cloth(), threads);
    ASSERT_TRUE(renderer.set_time(0.6));
    EXPECT_GE(renderer.posing_statistics().vertices_posed, 101U * 101U);
    const LayeredImage picture = reference::render(renderer, view, settings);
    RendererOptions options;
    options.time = 0.6;
    options.threads = threads;
    const Renderer fresh = Renderer::create(wrung_cloth(), options).value();
    EXPECT_TRUE(reference::same_bits(picture, reference::render(fresh, view, settings)));
    if (!one) one = picture;
    EXPECT_TRUE(reference::same_bits(picture, *one)) << threads;
  }
}

// The far edge of the cloth is the second joint's alone: turned by 0.6 of 90 degrees about X, backward.
TEST(LargeSkins, StandWhereTheirJointsPutThem) {
  Renderer renderer = reference::make_renderer(wrung_cloth(), 3);
  ASSERT_TRUE(renderer.set_time(0.6));
  const double angle = 0.6 * M_PI / 2;
  const Renderer::Box box = renderer.bounds();
  EXPECT_NEAR(box.high_ws.z, std::sin(angle), 1e-6);
  EXPECT_NEAR(box.low_ws.z, -std::sin(angle), 1e-6);
  EXPECT_NEAR(box.high_ws.y, std::cos(angle), 1e-6);
  EXPECT_NEAR(box.high_ws.x, 1, 1e-6);
}

}  // namespace
}  // namespace laterna
