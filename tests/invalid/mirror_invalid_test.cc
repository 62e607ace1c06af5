// Mirrors that cannot be, and exactly what is said about each.
#include <gtest/gtest.h>

#include "laterna/mirrors.h"
#include "laterna/write_scene.h"
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
    {"VolumeWithoutIor", R"({"mirror": {"volume": {}}})",
     "r.json: line 2: surfaces[0].mirror.volume: bends light by \"ior\", and there is none"},
    {"VolumeOfWhatIsOpaque", R"({"material": "glass", "mirror": {"ior": 1.3, "volume": {}}})",
     "r.json: line 2: surfaces[0].mirror.volume: is seen through surfaces that blend (alphaMode BLEND); this "
     "material does not: \"glass\""},
    {"VolumeColour", R"({"mirror": {"ior": 1.3, "volume": {"attenuation_color": [1, 2, 1]}}})",
     "r.json: line 2: surfaces[0].mirror.volume.attenuation_color[1]: expected a number from 0 to 1, got 2"},
    {"VolumeDistance", R"({"mirror": {"ior": 1.3, "volume": {"attenuation_distance": 0}}})",
     "r.json: line 2: surfaces[0].mirror.volume.attenuation_distance: expected a number from 1e-06 to "
     "3.4028234663852886e+38, got 0"},
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
  EXPECT_EQ(
      messages_of(tl::unexpected(renderer.error()), folder.path()),
      "r.json: line 2: surfaces[0].mirror: the mirror of object \"window\" is not flat: at (1, 0, 0) it "
      "leaves its plane by 0.157 m, and is 1 m long, so that 0.001 m is the most; let its flat parts have a "
      "material each, and curved ones mirror the environment");
}

// The wave that many first write for a lake: upward. On the sides of a box, which it is not straight through, it may stand.
TEST(InvalidMirrors, WavesLieWithinTheSurface) {
  Scene scene;
  reference::add_object(scene, "lake", reference::floor(3, 0));
  Mirror water;
  water.waves = {{{1, 0, 0}, 0.5, 0.01, {}, 0}, {{0, 2, 0}, 0.5, 0.01, {}, 0}};
  scene.materials[0].mirror = std::make_shared<const Mirror>(water);
  const Result<Renderer> renderer = Renderer::create(scene);
  ASSERT_FALSE(renderer);
  EXPECT_EQ(to_string(renderer.error()),
            "waves[1].direction runs straight through the surface of object \"lake\", whose normal is (0, 1, "
            "0): give "
            "one that lies within it");
  reference::add_object(scene, "side", reference::wall(1, 1, -2));
  scene.materials[1].mirror = scene.materials[0].mirror;
  EXPECT_TRUE(Renderer::create(scene));
}

// Each instance has a plane of its own; what is wrong with many is said once.
TEST(InvalidMirrors, OfManyInstancesOneIsTold) {
  Scene scene;
  const int node = reference::add_object(scene, "ball", reference::sphere({0, 0, 0}, 1, 16));
  scene.materials[0].mirror = std::make_shared<const Mirror>();
  for (int i = 1; i < 4; ++i) {
    scene.nodes.push_back(scene.nodes[static_cast<std::size_t>(node)]);
    scene.nodes.back().name = "copy";
  }
  const Result<Renderer> renderer = Renderer::create(std::move(scene));
  ASSERT_FALSE(renderer);
  const std::string message = to_string(renderer.error());
  EXPECT_EQ(message.find("the mirror of object \"ball\" is not flat: "), 0U) << message;
  EXPECT_NE(message.find("; 3 more of its objects are no better"), std::string::npos) << message;
}

// LATERNA_mirror, in radians and glTF's spelling.
GltfBuilder mirror_file(const json& extension) {
  GltfBuilder builder;
  builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  builder.add("materials",
              {{"name", "pond"}, {"alphaMode", "BLEND"}, {"extensions", {{"LATERNA_mirror", extension}}}});
  builder.add("meshes",
              {{"primitives", json::array({{{"attributes", {{"POSITION", 0}}}, {"material", 0}}})}});
  builder.add("nodes", {{"name", "pond"}, {"mesh", 0}});
  return builder;
}

TEST(InvalidMirrors, FaultsOfAnExtensionHaveTheirPlace) {
  const TemporaryFolder folder;
  const auto messages = [&](const json& extension) {
    return messages_of(load_scene({folder.write("s.gltf", mirror_file(extension).text())}, {}),
                       folder.path());
  };
  const std::string at = "s.gltf: materials[0].extensions.LATERNA_mirror";
  EXPECT_EQ(messages({{"ior", 0}}), at + ".ior: expected a number from 1 to 100, got 0");
  EXPECT_EQ(messages({{"volume", json::object()}}),
            at + ".volume: bends light by \"ior\", and there is none");
  EXPECT_EQ(
      messages({{"waves", {{{"direction", {1, 0, 0}}, {"length", 1}, {"amplitude", 1}, {"phase", 700}}}}}),
      at + ".waves[0].phase: expected a number from -628.3185935498118 to 628.3185935498118, got 700");
  // The last bit of single precision, on both sides.
  const float most = 628.31855F;
  for (const float phase : {-most, most}) {
    EXPECT_EQ(messages({{"waves",
                         {{{"direction", {1, 0, 0}}, {"length", 1}, {"amplitude", 1}, {"phase", phase}}}}}),
              "loaded");
  }
  EXPECT_EQ(messages({{"ior", 1.3}, {"volume", {{"attenuation_color", {1, 1, 1}}}}}),
            at + ".volume.attenuation_color: a volume has no key \"attenuation_color\" (did you mean "
                 "\"attenuationColor\"?)");
  EXPECT_EQ(messages(7), at + ": expected an object, got 7");
}

TEST(Mirrors, ComeBackFromAFile) {
  const TemporaryFolder folder;
  Scene scene = load_or_fail({folder.write("s.gltf", mirror_file(json::object()).text())}, {});
  EXPECT_FALSE(scene.materials[0].mirror->ior);
  Mirror water;
  water.reflectance = {0.9F, 0.8F, 1};
  water.ior = 1.333F;
  water.roughness = 0.1F;
  water.waves = {{{0.1, 0, 1.0 / 3}, 0.7, 0.01, {}, 0}, {{1, 0, 0}, 0.3, 0.002, -0.25, 1.5}};
  water.volume = {{0.1F, 0.5F, 0.7F}, 2.5F};
  scene.materials[0].mirror = std::make_shared<const Mirror>(water);
  const std::filesystem::path file = folder.path() / "a.glb";
  ASSERT_TRUE(write_scene(scene, file));
  const Scene read = load_or_fail({file}, {});
  const Mirror& back = *read.materials.at(0).mirror;
  EXPECT_EQ(back.reflectance, water.reflectance);
  EXPECT_EQ(back.ior, water.ior);
  EXPECT_EQ(back.roughness, water.roughness);
  ASSERT_EQ(back.waves.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.waves[i].direction_ws, water.waves[i].direction_ws);
    EXPECT_EQ(back.waves[i].length, water.waves[i].length);
    EXPECT_EQ(back.waves[i].amplitude, water.waves[i].amplitude);
    EXPECT_EQ(back.waves[i].speed, water.waves[i].speed);
    EXPECT_EQ(back.waves[i].phase, water.waves[i].phase);
  }
  EXPECT_EQ(back.volume->attenuation_color, water.volume->attenuation_color);
  EXPECT_EQ(back.volume->attenuation_distance, water.volume->attenuation_distance);
  EXPECT_NE(back.place.find("LATERNA_mirror"), std::string::npos);
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
