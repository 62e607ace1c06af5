// Reliefs in rigs and in LATERNA_relief: every key, what is wrong with them, and back again.
#include <gtest/gtest.h>

#include "laterna/relief.h"
#include "laterna/render.h"
#include "laterna/write_scene.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

GltfBuilder sheet(const json& extension = nullptr) {
  GltfBuilder builder;
  builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  builder.floats({0, 0, 1, 0, 0, 1}, "VEC2");
  json material = {{"name", "paper"}};
  if (!extension.is_null()) {
    material["extensions"] = {{"LATERNA_relief", extension}};
    builder.add("images", {{"uri", "heights.png"}});
    builder.add("textures", {{"source", 0}});
  }
  builder.add("materials", material);
  builder.add("meshes",
              {{"primitives",
                json::array({{{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}, {"material", 0}}})}});
  builder.add("nodes", {{"name", "sheet"}, {"mesh", 0}});
  return builder;
}

Result<Scene> load_rig(const std::string& surface) {
  const TemporaryFolder folder;
  folder.write("heights.png", "x");
  GltfBuilder builder = sheet();
  return load_scene({folder.write("s.gltf", builder.text())},
                    {.rigs = {folder.write("r.json", R"({"surfaces": [)" + surface + "]}")}});
}

std::string fault_of(const Result<Scene>& scene) {
  if (scene) return {};
  const Diagnostic& first = scene.error().diagnostics.front();
  return first.place + ": " + first.message;
}

TEST(ReliefSettings, EveryKeyOfARig) {
  const Result<Scene> scene =
      load_rig(R"({"material": "paper", "relief": {"picture": "heights.png", "depth": 0.25,
      "kind": "depth", "self_shadow": false, "cut_edges": true, "uv_set": 0, "offset": [0.5, 0.25], "scale": [2, 4],
      "rotation_deg": 0, "wrap": "mirror"}})");
  ASSERT_TRUE(scene) << fault_of(scene);
  ASSERT_NE(scene->materials.at(0).relief, nullptr);
  const Relief& relief = *scene->materials[0].relief;
  EXPECT_EQ(scene->pictures.at(static_cast<std::size_t>(relief.texture.picture)).file.filename(),
            "heights.png");
  EXPECT_EQ(relief.depth, 0.25);
  EXPECT_EQ(relief.kind, ReliefKind::depth);
  EXPECT_FALSE(relief.self_shadow);
  EXPECT_TRUE(relief.cut_edges);
  EXPECT_EQ(relief.texture.sampler.wrap_u, Wrap::mirror);
  EXPECT_EQ(relief.texture.uv_from_mesh_uv, (std::array<float, 6>{2, 0, 0.5F, 0, 4, 0.25F}));
}

TEST(ReliefSettings, FaultsOfARigHaveTheirPlace) {
  const auto fault = [](const std::string& relief) {
    return fault_of(load_rig(R"({"material": "paper", "relief": )" + relief + "}"));
  };
  EXPECT_EQ(fault(R"({"picture": "heights.png", "depth": -1})"),
            "line 1: surfaces[0].relief.depth: expected a number from 0 to 10000, got -1");
  EXPECT_EQ(fault(R"({"picture": "heights.png", "kind": "bump"})").find("line 1: surfaces[0].relief.kind: "),
            0U);
  EXPECT_NE(fault(R"({"depth": 1})").find("picture"), std::string::npos);
  EXPECT_NE(fault(R"({"picture": "no.png"})").find("no.png"), std::string::npos);
  EXPECT_NE(fault(R"({"picture": "heights.png", "deep": 1})").find("\"deep\""), std::string::npos);
  EXPECT_EQ(fault(R"({"picture": "heights.png", "uv_set": 1})"),
            "line 1: surfaces[0].relief: mesh \"\" has no texture coordinates of set 1");
}

TEST(ReliefSettings, FaultsOfAnExtensionHaveTheirPlace) {
  const auto fault = [](const json& extension) {
    const TemporaryFolder folder;
    folder.write("heights.png", "x");
    return fault_of(load_scene({folder.write("s.gltf", sheet(extension).text())}, {}));
  };
  EXPECT_EQ(fault({{"texture", {{"index", 0}}}}), "");
  EXPECT_EQ(fault({{"texture", {{"index", 0}}}, {"depth", 20000}}),
            "materials[0].extensions.LATERNA_relief.depth: expected a number from 0 to 10000, got 20000");
  EXPECT_NE(fault({{"depth", 0.1}}).find("texture"), std::string::npos);
  EXPECT_NE(fault({{"texture", {{"index", 0}}}, {"self_shadow", true}}).find("selfShadow"),
            std::string::npos);
}

// Scenes made in code pass the same checks.
TEST(ReliefSettings, WhatBlendsBearsNone) {
  Scene scene;
  Material glass;
  glass.alpha_mode = AlphaMode::blend;
  Relief relief;
  relief.depth = -2;
  glass.relief = std::make_shared<const Relief>(relief);
  scene.materials.push_back(glass);
  std::vector<std::string> faults;
  for (const Diagnostic& fault : validate(scene)) faults.push_back(fault.place + ": " + fault.message);
  EXPECT_EQ(faults,
            (std::vector<std::string>{
                "materials[0].relief.depth: expected a number from 0 to 10000, got -2",
                "materials[0].relief: belongs to opaque surfaces and cut-outs; this material blends"}));
}

TEST(ReliefSettings, ComeBackFromAFile) {
  const TemporaryFolder folder;
  Scene scene;
  Picture picture;
  picture.pixels = std::make_shared<const Image>(4, 4, 1, PixelType::u16, Transfer::linear);
  scene.pictures.push_back(picture);
  Relief relief;
  relief.texture.picture = 0;
  relief.texture.sampler.wrap_v = Wrap::clamp;
  relief.texture.uv_from_mesh_uv = {2, 0, 0.5F, 0, 4, 0.25F};
  relief.depth = 0.03;
  relief.kind = ReliefKind::depth;
  relief.self_shadow = false;
  relief.cut_edges = true;
  Material material;
  material.relief = std::make_shared<const Relief>(relief);
  scene.materials.push_back(material);
  Primitive triangle;
  triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.uv[0] = {{0, 0}, {1, 0}, {0, 1}};
  triangle.material = 0;
  scene.meshes.push_back({"m", {triangle}});
  Node node;
  node.mesh = 0;
  scene.nodes.push_back(node);
  const std::filesystem::path file = folder.path() / "a.glb";
  ASSERT_TRUE(write_scene(scene, file));
  const Result<Scene> read = load_scene({file}, {});
  ASSERT_TRUE(read) << fault_of(read);
  ASSERT_NE(read->materials.at(0).relief, nullptr);
  const Relief& back = *read->materials[0].relief;
  EXPECT_EQ(back.depth, relief.depth);
  EXPECT_EQ(back.kind, relief.kind);
  EXPECT_EQ(back.self_shadow, relief.self_shadow);
  EXPECT_EQ(back.cut_edges, relief.cut_edges);
  EXPECT_EQ(back.texture.sampler.wrap_v, Wrap::clamp);
  EXPECT_EQ(back.texture.uv_from_mesh_uv, relief.texture.uv_from_mesh_uv);
}

}  // namespace
}  // namespace laterna
