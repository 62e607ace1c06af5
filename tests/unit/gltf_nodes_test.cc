// Node trees, instances, cameras and lights of glTF files.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "base/elementary.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

void expect_near(const glm::dmat4& a, const glm::dmat4& b, double tolerance) {
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) EXPECT_NEAR(a[c][r], b[c][r], tolerance) << "column " << c << ", row " << r;
  }
}

TEST(GltfNodes, TranslationRotationScaleAndMatrixAgree) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  const double h = std::sqrt(0.5);
  // Scaled by (2, 3, 4), turned by 90° about +Y (x → −z), moved by (5, 6, 7).
  builder.add("nodes", {{"translation", {5, 6, 7}}, {"rotation", {0, h, 0, h}}, {"scale", {2, 3, 4}}});
  builder.add("nodes", {{"matrix", {0, 0, -2, 0, 0, 3, 0, 0, 4, 0, 0, 0, 5, 6, 7, 1}}});
  const Scene scene = builder.load(folder);
  expect_near(scene.nodes.at(0).parent_from_node, scene.nodes.at(1).parent_from_node, 1e-15);
  EXPECT_EQ(scene.nodes[1].parent_from_node * glm::dvec4(1, 0, 0, 1), glm::dvec4(5, 6, 5, 1));
}

TEST(GltfNodes, RotationsNeedNotHaveUnitLength) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  builder.add("nodes", {{"rotation", {0, 0.1, 0, 0.1}}});
  const Scene scene = builder.load(folder);
  EXPECT_NEAR((scene.nodes[0].parent_from_node * glm::dvec4(1, 0, 0, 0)).z, -1, 1e-15);
}

TEST(GltfNodes, TreesMultiply) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  builder.add("nodes", {{"name", "child"}, {"translation", {0, 1, 0}}});
  builder.add("nodes", {{"name", "root"}, {"scale", {2, 2, 2}}, {"children", {2, 0}}});
  builder.add("nodes", {{"name", "other"}, {"translation", {1, 0, 0}}, {"children", {3}}});
  builder.add("nodes", {{"name", "leaf"}, {"translation", {0, 0, 1}}});
  const Scene scene = builder.load(folder);
  ASSERT_EQ(scene.nodes.size(), 4U);
  EXPECT_EQ(scene.nodes[0].name, "root");  // parents first, children in their order
  EXPECT_EQ(scene.nodes[1].name, "other");
  EXPECT_EQ(scene.nodes[2].name, "leaf");
  EXPECT_EQ(scene.nodes[3].name, "child");
  const std::vector<glm::dmat4> world = world_from_nodes(scene);
  EXPECT_EQ(world[2][3], glm::dvec4(2, 0, 2, 1));
  EXPECT_EQ(world[3][3], glm::dvec4(0, 2, 0, 1));
}

std::string node_names(const Scene& scene) {
  std::string names;
  for (const Node& node : scene.nodes) names += node.name;
  return names;
}

TEST(GltfNodes, TheDefaultSceneIsShown) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  for (const std::string name : {"a", "b", "c"}) builder.add("nodes", {{"name", name}});
  EXPECT_EQ(node_names(builder.load(folder)), "abc");  // no scenes: every root
  builder.document["scenes"] = {{{"nodes", {1}}}, {{"nodes", {2, 0}}}};
  EXPECT_EQ(node_names(builder.load(folder)), "b");  // no `scene`: the first
  builder.document["scene"] = 1;
  EXPECT_EQ(node_names(builder.load(folder)), "ca");
  builder.document["scenes"][1] = json::object();
  EXPECT_EQ(node_names(builder.load(folder)), "");
}

TEST(GltfNodes, WhatTheSceneDoesNotShowIsNotRead) {
  const TemporaryFolder folder;
  GltfBuilder builder = triangle_builder();
  builder.show({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});  // would warn
  builder.document["scenes"] = {{{"nodes", {0}}}};
  const Scene scene = builder.load(folder);
  EXPECT_EQ(scene.meshes.size(), 1U);
  EXPECT_EQ(warnings_of(scene), "");
}

TEST(GltfNodes, DeepChainsDoNotOverflowTheStack) {
  const TemporaryFolder folder;
  constexpr int kDepth = 200000;
  std::string text = R"({"asset":{"version":"2.0"},"nodes":[)";
  for (int i = 0; i < kDepth; ++i) {
    text += i + 1 < kDepth ? R"({"translation":[1,0,0],"children":[)" + std::to_string(i + 1) + "]}," : "{}";
  }
  text += "]}";
  const Scene scene = load_or_fail({folder.write("deep.gltf", text)});
  ASSERT_EQ(scene.nodes.size(), static_cast<std::size_t>(kDepth));
  EXPECT_EQ(world_from_nodes(scene).back()[3].x, kDepth - 1);
}

TEST(GltfNodes, OneMeshOnSeveralNodesIsThereOnce) {
  const TemporaryFolder folder;
  GltfBuilder builder = triangle_builder();
  builder.add("nodes", {{"mesh", 0}, {"translation", {5, 0, 0}}});
  const Scene scene = builder.load(folder);
  EXPECT_EQ(scene.meshes.size(), 1U);
  EXPECT_EQ(scene.nodes[1].mesh, 0);
}

TEST(GltfNodes, Instances) {
  const TemporaryFolder folder;
  GltfBuilder builder = triangle_builder();
  const int translation = builder.floats({1, 2, 3, 4, 5, 6}, "VEC3");
  const int scale = builder.floats({1, 1, 1, 2, 3, 4}, "VEC3");
  const int rotation = builder.accessor<std::int8_t>({0, 0, 0, 127, 0, 0, 127, 0}, "VEC4", kI8, true);
  json& attributes = builder.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  attributes = {{"TRANSLATION", translation}, {"ROTATION", rotation}, {"SCALE", scale}};
  builder.document["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  const Scene scene = builder.load(folder);
  ASSERT_EQ(scene.nodes[0].node_from_instance.size(), 2U);
  EXPECT_EQ(scene.nodes[0].node_from_instance[0] * glm::dvec4(1, 0, 0, 1), glm::dvec4(2, 2, 3, 1));
  // Half a turn about z, after scaling.
  EXPECT_EQ(scene.nodes[0].node_from_instance[1] * glm::dvec4(1, 1, 1, 1),
            glm::dvec4(4 - 2, 5 - 3, 6 + 4, 1));
}

// ----------------------------------------------------------------------------------------------- cameras

GltfBuilder camera_builder(const json& camera) {
  GltfBuilder builder;
  builder.add("cameras", camera);
  builder.add("nodes", {{"camera", 0}, {"name", "tripod"}});
  return builder;
}

TEST(GltfCameras, Perspective) {
  const TemporaryFolder folder;
  const Scene scene =
      camera_builder({{"type", "perspective"},
                      {"name", "main"},
                      {"perspective", {{"yfov", 1.0}, {"aspectRatio", 2}, {"znear", 0.5}, {"zfar", 50}}}})
          .load(folder);
  const Camera& camera = scene.cameras.at(0);
  EXPECT_EQ(camera.name, "main");
  EXPECT_FALSE(camera.projection.is_orthographic);
  EXPECT_NEAR(camera.projection.top, std::tan(0.5), 1e-15);
  EXPECT_NEAR(camera.projection.right, 2 * std::tan(0.5), 1e-15);
  EXPECT_EQ(camera.projection.near, 0.5);
  EXPECT_EQ(camera.projection.far, 50);
  EXPECT_FALSE(camera.aspect_from_picture);
  EXPECT_EQ(find_camera_node(scene, "main"), 0);
  EXPECT_EQ(find_camera_node(scene, "tripod"), 0);  // its node's name serves too
  EXPECT_EQ(find_camera_node(scene, "other"), -1);
}

TEST(GltfCameras, WithoutFarAndAspect) {
  const TemporaryFolder folder;
  const Scene scene =
      camera_builder({{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.5}}}})
          .load(folder);
  EXPECT_TRUE(std::isinf(scene.cameras.at(0).projection.far));
  EXPECT_TRUE(scene.cameras[0].aspect_from_picture);
  EXPECT_EQ(scene.cameras[0].name, "tripod");
}

TEST(GltfCameras, Orthographic) {
  const TemporaryFolder folder;
  const Scene scene =
      camera_builder(
          {{"type", "orthographic"}, {"orthographic", {{"xmag", 4}, {"ymag", 3}, {"znear", 0}, {"zfar", 9}}}})
          .load(folder);
  const Projection& projection = scene.cameras.at(0).projection;
  EXPECT_TRUE(projection.is_orthographic);
  EXPECT_EQ(projection.left, -4);
  EXPECT_EQ(projection.right, 4);
  EXPECT_EQ(projection.bottom, -3);
  EXPECT_EQ(projection.top, 3);
  EXPECT_EQ(projection.near, 0);
  EXPECT_EQ(projection.far, 9);
}

TEST(GltfCameras, OneCameraOnSeveralNodesBecomesSeveral) {
  const TemporaryFolder folder;
  GltfBuilder builder = camera_builder(
      {{"type", "perspective"}, {"name", "main"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.5}}}});
  builder.add("nodes", {{"camera", 0}, {"name", "balcony"}});
  builder.add("nodes", {{"camera", 0}});
  const Scene scene = builder.load(folder);
  ASSERT_EQ(scene.cameras.size(), 3U);
  EXPECT_EQ(scene.cameras[0].name, "main");
  EXPECT_EQ(scene.cameras[1].name, "balcony");
  EXPECT_EQ(scene.cameras[2].name, "main.2");
  EXPECT_EQ(scene.nodes[2].camera, 2);
}

// ------------------------------------------------------------------------------------------------ lights

Light load_light(const json& light) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  builder.document["extensions"]["KHR_lights_punctual"]["lights"] = json::array({light});
  builder.document["extensionsRequired"] = {"KHR_lights_punctual"};
  builder.add("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  Scene scene = builder.load(folder);
  EXPECT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.nodes.at(0).light, 0);
  return scene.lights.empty() ? Light{} : scene.lights[0];
}

TEST(GltfLights, PointWithDefaults) {
  const Light light = load_light({{"type", "point"}});
  EXPECT_EQ(light.type, LightType::point);
  EXPECT_EQ(light.name, "light 1");
  EXPECT_EQ(light.color, glm::vec3(1));
  EXPECT_EQ(light.intensity, 1);
  EXPECT_EQ(light.attenuation, Attenuation::inverse_square);
  EXPECT_TRUE(std::isinf(light.range));
}

TEST(GltfLights, ARangeMakesAWindow) {
  const Light light = load_light(
      {{"type", "point"}, {"name", "bulb"}, {"color", {1, 0.5, 0.25}}, {"intensity", 80}, {"range", 12}});
  EXPECT_EQ(light.name, "bulb");
  EXPECT_EQ(light.color, glm::vec3(1, 0.5F, 0.25F));
  EXPECT_EQ(light.intensity, 80);
  EXPECT_EQ(light.attenuation, Attenuation::gltf_windowed);
  EXPECT_EQ(light.range, 12);
}

TEST(GltfLights, SpotCones) {
  const Light plain = load_light({{"type", "spot"}, {"spot", json::object()}});
  EXPECT_EQ(plain.inner_cone.in_radians(), 0);
  EXPECT_EQ(plain.outer_cone.in_radians(), kPi / 4);
  const Light narrow = load_light(
      {{"type", "spot"}, {"intensity", 7}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.2}}}});
  EXPECT_EQ(narrow.inner_cone.in_radians(), 0.1);
  EXPECT_EQ(narrow.outer_cone.in_radians(), 0.2);
  EXPECT_EQ(narrow.intensity, 7);
}

TEST(GltfLights, ARightAngleInSinglePrecisionIsOne) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  builder.document["extensions"]["KHR_lights_punctual"]["lights"] =
      json::array({{{"type", "spot"}, {"spot", {{"outerConeAngle", 1.5707963705062866}}}}});
  builder.add("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  EXPECT_EQ(builder.load(folder).lights.at(0).outer_cone, Angle::degrees(90));
}

TEST(GltfLights, DirectionalIsInLuxAndFitted) {
  const Light light = load_light({{"type", "directional"}, {"intensity", 10000}});
  EXPECT_EQ(light.type, LightType::directional);
  EXPECT_EQ(light.intensity, 10000);
  EXPECT_TRUE(light.fit);
}

TEST(GltfLights, OneLightOnSeveralNodesBecomesSeveral) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  builder.document["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"name", "lamp"}}};
  for (const std::string name : {"left", "right"}) {
    builder.add("nodes", {{"name", name}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  }
  const Scene scene = builder.load(folder);
  ASSERT_EQ(scene.lights.size(), 2U);
  EXPECT_EQ(scene.lights[0].name, "lamp");
  EXPECT_EQ(scene.lights[1].name, "right");
  EXPECT_EQ(find_light_node(scene, "lamp"), 0);
  EXPECT_EQ(find_light_node(scene, "left"), 0);
  EXPECT_EQ(find_light_node(scene, "right"), 1);
}

}  // namespace
}  // namespace laterna
