// Several files on one command line become one scene.
#include <gtest/gtest.h>

#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

std::string lighting_set(const std::string& name) {
  GltfBuilder builder;
  builder.document["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "directional"}, {"name", name}}};
  builder.add("cameras",
              {{"type", "perspective"}, {"name", "main"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.5}}}});
  builder.add("nodes", {{"name", "stand"}, {"children", {1, 2}}});
  builder.add("nodes", {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  builder.add("nodes", {{"camera", 0}});
  return builder.text();
}

GltfBuilder textured(const std::string& picture) {
  GltfBuilder builder = triangle_builder();
  json& primitive = builder.document["meshes"][0]["primitives"][0];
  primitive["attributes"]["TEXCOORD_0"] = builder.floats({0, 0, 1, 0, 0, 1}, "VEC2");
  primitive["material"] = 0;
  builder.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  builder.add("textures", {{"source", 0}});
  builder.add("images", {{"uri", picture}});
  return builder;
}

TEST(Merge, IndicesAreShifted) {
  const TemporaryFolder folder;
  folder.write("a.png", "a");
  folder.write("b.png", "b");
  const Scene scene = load_or_fail({folder.write("one.gltf", textured("a.png").text()),
                                    folder.write("lights.gltf", lighting_set("sun")),
                                    folder.write("two.gltf", textured("b.png").text())});
  ASSERT_EQ(scene.nodes.size(), 5U);
  EXPECT_EQ(scene.nodes[0].mesh, 0);
  EXPECT_EQ(scene.nodes[4].mesh, 1);
  EXPECT_EQ(scene.nodes[2].parent, 1);
  EXPECT_EQ(scene.nodes[3].parent, 1);
  EXPECT_EQ(scene.meshes[1].primitives[0].material, 1);
  EXPECT_EQ(scene.materials[1].base_color_texture.picture, 1);
  EXPECT_EQ(scene.pictures[1].file.filename(), "b.png");
  EXPECT_EQ(find_light_node(scene, "sun"), 2);
  EXPECT_EQ(find_camera_node(scene, "main"), 3);
}

TEST(Merge, OneFileIsOnePictureAcrossScenesAndRigs) {
  const TemporaryFolder folder;
  folder.write("pictures/a.png", "a");
  const Scene scene = load_or_fail(
      {folder.write("one.gltf", textured("pictures/a.png").text()),
       folder.write("sub/two.gltf", textured("../pictures/a.png").text())},
      {.rigs = {folder.write("rig.json",
                             R"({"lights": [{"type": "projector", "position": [0,0,1], "target": [0,0,0],
                                             "yfov_deg": 20, "slide": "pictures/a.png"}]})")}});
  EXPECT_EQ(scene.pictures.size(), 1U);
  EXPECT_EQ(scene.materials[1].base_color_texture.picture, 0);
  EXPECT_EQ(scene.lights[0].slide, 0);
}

TEST(Merge, TakenNamesAreChangedWithAWarning) {
  const TemporaryFolder folder;
  const Scene scene =
      load_or_fail({folder.write("a.gltf", lighting_set("sun")), folder.write("b.gltf", lighting_set("sun")),
                    folder.write("c.gltf", lighting_set("sun"))});
  ASSERT_EQ(scene.lights.size(), 3U);
  EXPECT_EQ(scene.lights[0].name, "sun");
  EXPECT_EQ(scene.lights[1].name, "sun.2");
  EXPECT_EQ(scene.lights[2].name, "sun.3");
  EXPECT_EQ(scene.cameras[2].name, "main.3");
  ASSERT_EQ(scene.warnings.size(), 4U);
  EXPECT_EQ(to_string(scene.warnings[1]),
            (folder.path() / "b.gltf").string() +
                ": a light named \"sun\" is already there: this one becomes \"sun.2\"");
}

TEST(Merge, LaterAmbientBackgroundAndShadingWin) {
  const TemporaryFolder folder;
  const auto first = folder.write(
      "a.json", R"({"ambient": [1, 1, 1], "background": [1, 1, 1], "shading": {"specular": 1}})");
  const auto second = folder.write("b.json", R"({"ambient": [0, 0, 0]})");
  const auto third = folder.write("c.json", R"({"background": [0, 0, 1]})");
  const Scene scene = load_or_fail({}, {.rigs = {first, second, third}});
  EXPECT_EQ(scene.ambient, glm::vec3(0));
  EXPECT_TRUE(scene.ambient_is_set);
  EXPECT_EQ(scene.background, glm::vec3(0, 0, 1));
  EXPECT_EQ(scene.phong->specular, 1);
}

TEST(Merge, FaultsOfAllFilesAreReportedTogether) {
  const TemporaryFolder folder;
  const Result<Scene> scene =
      load_scene({folder.path() / "lost.gltf", folder.write("bad.gltf", "{}"), folder.write("what.xyz", "")},
                 {.rigs = {folder.write("bad.json", "{\"x\": 1}")}});
  EXPECT_EQ(messages_of(scene, folder.path()),
            "lost.gltf: no such file\n"
            "bad.gltf: asset: is missing\n"
            "what.xyz: files ending in \".xyz\" are not read; expected .gltf, .glb, .obj, .ply, .stl, .md2, "
            "or .json for a rig\n"
            "bad.json: line 1: x: a rig has no key \"x\"");
}

}  // namespace
}  // namespace laterna
