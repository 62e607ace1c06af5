// Mirrors that cannot be, and exactly what is said about each.
#include <gtest/gtest.h>

#include "laterna/mirrors.h"
#include "reference/shapes.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

struct MirrorCase {
  const char* name;
  const char* surface;  // in line 2
  const char* messages;
};

class InvalidMirror : public testing::TestWithParam<MirrorCase> {};

// A sheet of two triangles, bent along its diagonal, of "glass". Their normals are (0, −0.5, 1) and (−0.5, 0, 1), so that the
// mean plane is −x − y + 4 z = −1/3, from which (1, 0, 0) is 2/3 / √18 away.
GltfBuilder bent_sheet() {
  GltfBuilder builder;
  builder.floats({0, 0, 0, 1, 0, 0, 1, 1, 0.5F, 0, 0, 0, 1, 1, 0.5F, 0, 1, 0}, "VEC3");
  builder.add("materials", {{"name", "glass"}});
  builder.add("meshes",
              {{"primitives", json::array({{{"attributes", {{"POSITION", 0}}}, {"material", 0}}})}});
  builder.add("nodes", {{"name", "window"}, {"mesh", 0}});
  return builder;
}

TEST_P(InvalidMirror, IsRefusedWithItsMessage) {
  const TemporaryFolder folder;
  const std::string rig = std::string("{\"surfaces\": [\n") + GetParam().surface + "]}";
  const Result<Scene> scene =
      load_scene({folder.write("s.gltf", bent_sheet().text())}, {.rigs = {folder.write("r.json", rig)}});
  EXPECT_EQ(messages_of(scene, folder.path()), GetParam().messages);
}

const MirrorCase kMirrorCases[] = {
    {"NoObject", R"({"material": "glass", "mirror": true})",
     "r.json: line 2: surfaces[0].mirror: expected an object, got true"},
    {"UnknownMaterial", R"({"material": "class", "mirror": {}})",
     "r.json: line 2: surfaces[0]: the scene has no material named \"class\" (did you mean \"glass\"?)"},
    {"UnknownKey", R"({"mirror": {"rough": 1}})",
     "r.json: line 2: surfaces[0].mirror.rough: a mirror has no key \"rough\" (did you mean \"roughness\"?)"},
    {"Roughness", R"({"mirror": {"roughness": 2}})",
     "r.json: line 2: surfaces[0].mirror.roughness: expected a number from 0 to 1, got 2"},
    {"Ior", R"({"mirror": {"ior": 0.5}})",
     "r.json: line 2: surfaces[0].mirror.ior: expected a number from 1 to 100, got 0.5"},
    {"WaveWithoutLength", R"({"mirror": {"waves": [{"direction": [1, 0, 0], "amplitude": 1}]}})",
     "r.json: line 2: surfaces[0].mirror.waves[0].length: is missing"},
    {"WaveToNowhere", R"({"mirror": {"waves": [{"direction": [0, 0, 0], "amplitude": 1, "length": 1}]}})",
     "r.json: line 2: surfaces[0].mirror.waves[0].direction: is the zero vector"},
};
INSTANTIATE_TEST_SUITE_P(Cases, InvalidMirror, testing::ValuesIn(kMirrorCases),
                         [](const testing::TestParamInfo<MirrorCase>& tested) { return tested.param.name; });

TEST(InvalidMirrors, MustBeFlat) {
  const TemporaryFolder folder;
  Scene scene = load_or_fail(
      {folder.write("s.gltf", bent_sheet().text())},
      {.rigs = {folder.write("r.json", "{\"surfaces\": [\n{\"material\": \"glass\", \"mirror\": {}}]}")}});
  const Result<Renderer> renderer = Renderer::create(std::move(scene));
  ASSERT_FALSE(renderer);
  EXPECT_EQ(messages_of(tl::unexpected(renderer.error()), folder.path()),
            "r.json: line 2: surfaces[0].mirror: the mirror of object \"window\" is not flat: it leaves its "
            "plane by "
            "0.157 m, and is 1 m long; a mirror may by 0.001");
}

TEST(InvalidMirrors, MadeInCodeAndTooDeep) {
  Scene scene;
  reference::add_object(scene, "pool", reference::floor(1));
  Mirror mirror;
  mirror.roughness = 2;
  mirror.waves.push_back({{0, 0, 0}, 0, -1, {}, 0});
  scene.materials[0].mirror = std::make_shared<const Mirror>(mirror);
  EXPECT_EQ(validate(scene).size(), 4U);
  scene.materials[0].mirror = std::make_shared<const Mirror>();
  RenderSettings settings = reference::test_settings(8, 8);
  settings.mirror_depth = 9;
  const Result<LayeredImage> image = reference::make_renderer(std::move(scene))
                                         .render(reference::look({0, 1, 3}, {0, 0, 0}, 45, 1), settings);
  ASSERT_FALSE(image);
  EXPECT_EQ(to_string(image.error()), "mirrors may be seen from 0 to 8 deep, not 9");
}

}  // namespace
}  // namespace laterna
