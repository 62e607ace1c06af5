// Rigs: layers of surfaces, and projectors whose light does more than add.
#include <gtest/gtest.h>

#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

// Two nodes, "left" and "right", of one mesh, and a third of its own; all of material "paper".
GltfBuilder three_sheets() {
  GltfBuilder builder;
  builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  builder.floats({0, 0, 1, 0, 0, 1}, "VEC2");
  builder.add("materials", {{"name", "paper"}});
  for (int i = 0; i < 2; ++i) {
    builder.add("meshes",
                {{"primitives",
                  json::array({{{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}, {"material", 0}}})}});
  }
  builder.add("nodes", {{"name", "left"}, {"mesh", 0}});
  builder.add("nodes", {{"name", "right"}, {"mesh", 0}});
  builder.add("nodes", {{"name", "far"}, {"mesh", 1}});
  return builder;
}

constexpr const char* kLantern =
    R"({"name": "lantern", "type": "projector", "position": [0, 0, 5], "target": [0, 0, 0], "yfov_deg": 30,
        "blend": "modulate"})";

Scene load(const std::string& surfaces) {
  const TemporaryFolder folder;
  folder.write("label.png", "x");
  return load_or_fail({folder.write("s.gltf", three_sheets().text())},
                      {.rigs = {folder.write("r.json", std::string(R"({"lights": [)") + kLantern +
                                                           R"(], "surfaces": [)" + surfaces + "]}")}});
}

const std::vector<SurfaceLayer>& layers_of_node(const Scene& scene, std::size_t node) {
  const Mesh& mesh = scene.meshes[static_cast<std::size_t>(scene.nodes[node].mesh)];
  return scene.materials[static_cast<std::size_t>(mesh.primitives[0].material)].layers;
}

TEST(RigSurfaces, EveryKeyOfALayer) {
  const Scene scene = load(R"({"material": "paper", "layers": [
      {"texture": "label.png", "blend": "screen", "color": [1, 0.5, 2], "opacity": 0.25, "uv_set": 0,
       "offset": [0.5, 0.25], "scale": [2, 4], "rotation_deg": 90, "wrap": "once", "filter": "nearest"},
      {"slide": "lantern", "occluded": false},
      {"color": [0.1, 0.2, 0.3], "blend": "reverse_subtract"}]})");
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.lights[0].blend, BlendMode::modulate);
  const std::vector<SurfaceLayer>& layers = layers_of_node(scene, 0);
  ASSERT_EQ(layers.size(), 3U);
  const SurfaceLayer& label = layers[0];
  EXPECT_EQ(scene.pictures[static_cast<std::size_t>(label.texture.picture)].file.filename(), "label.png");
  EXPECT_EQ(label.blend, BlendMode::screen);
  EXPECT_EQ(label.color, glm::vec3(1, 0.5F, 2));
  EXPECT_EQ(label.opacity, 0.25F);
  EXPECT_TRUE(label.once);
  EXPECT_EQ(label.texture.sampler.wrap_u, Wrap::clamp);
  EXPECT_EQ(label.texture.sampler.magnify, Filter::nearest);
  // Translation · rotation · scale, as KHR_texture_transform has it: rotation by 90° is [0 1; −1 0].
  const float expected[] = {0, 4, 0.5F, -2, 0, 0.25F};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(label.texture.uv_from_mesh_uv[i], expected[i], 1e-6) << i;
  EXPECT_EQ(label.projector, -1);
  EXPECT_EQ(layers[1].projector, 0);
  EXPECT_FALSE(layers[1].occluded);
  EXPECT_EQ(layers[1].blend, BlendMode::over);
  EXPECT_EQ(layers[2].texture.picture, -1);
  EXPECT_EQ(layers[2].blend, BlendMode::reverse_subtract);
}

TEST(RigSurfaces, OfANodeItsOwnCopiesAlone) {
  const Scene scene = load(R"({"node": "right", "layers": [{"color": [1, 0, 0]}]})");
  EXPECT_TRUE(layers_of_node(scene, 0).empty());
  EXPECT_EQ(layers_of_node(scene, 1).size(), 1U);
  EXPECT_TRUE(layers_of_node(scene, 2).empty());
  EXPECT_EQ(scene.meshes.size(), 3U);
  EXPECT_EQ(scene.materials.size(), 2U);
  EXPECT_EQ(scene.materials[1].name, "paper");
}

TEST(RigSurfaces, WithoutANameOfAllSurfacesAndOneOverTheOther) {
  const Scene scene =
      load(R"({"layers": [{"color": [1, 0, 0]}]}, {"node": "far", "layers": [{"color": [0, 1, 0]}]})");
  EXPECT_EQ(layers_of_node(scene, 0).size(), 1U);
  ASSERT_EQ(layers_of_node(scene, 2).size(), 2U);
  EXPECT_EQ(layers_of_node(scene, 2)[1].color, glm::vec3(0, 1, 0));
  // A surface without a material has glTF's, and layers like any other.
  const TemporaryFolder folder;
  const Scene bare = load_or_fail(
      {folder.write("s.gltf", triangle_builder().text())},
      {.rigs = {folder.write("r.json", R"({"surfaces": [{"layers": [{"color": [0, 0, 0]}]}]})")}});
  EXPECT_EQ(layers_of_node(bare, 0).size(), 1U);
}

// Of two files with a lantern each, a rig's layers show its own, under whatever name it goes then.
TEST(RigSurfaces, ARigsSlideIsItsOwn) {
  const TemporaryFolder folder;
  const std::string first = std::string(R"({"lights": [)") + kLantern + "]}";
  const std::string second = std::string(R"({"lights": [)") + kLantern +
                             R"(], "surfaces": [{"material": "paper", "layers": [{"slide": "lantern"}]}]})";
  const Scene scene = load_or_fail({folder.write("s.gltf", three_sheets().text())},
                                   {.rigs = {folder.write("a.json", first), folder.write("b.json", second)}});
  ASSERT_EQ(scene.lights.size(), 2U);
  EXPECT_EQ(layers_of_node(scene, 0)[0].projector, 1);
}

}  // namespace
}  // namespace laterna
