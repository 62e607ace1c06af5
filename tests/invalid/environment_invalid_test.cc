// Bad environments in rigs, in glTF, in code and in pictures, and exactly what is said about each.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "laterna/environment_probe.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

struct Case {
  const char* name;
  const char* text;
  const char* messages;
};
std::string case_name(const testing::TestParamInfo<Case>& info) { return info.param.name; }

class InvalidRigEnvironment : public testing::TestWithParam<Case> {};

TEST_P(InvalidRigEnvironment, IsRefusedWithItsMessage) {
  const TemporaryFolder folder;
  folder.write("sky.hdr", "x");
  const std::string text = std::string("{\n\"environment\": ") + GetParam().text + "}";
  const Result<Scene> scene = load_scene({folder.write("s.gltf", triangle_builder().text())},
                                         {.rigs = {folder.write("r.json", text)}});
  EXPECT_EQ(messages_of(scene, folder.path()), GetParam().messages);
}

const Case kRigCases[] = {
    {"NotAnObject", "\"sky.hdr\"", "r.json: line 2: environment: expected an object, got \"sky.hdr\""},
    {"NoImage", "{}", "r.json: line 2: environment.image: is missing"},
    {"UnknownChart", R"({"image": "sky.hdr", "chart": "latlon"})",
     "r.json: line 2: environment.chart: expected one of \"latlong\", \"cube\", \"horizontal_cross\", "
     "\"vertical_cross\", \"sphere\", \"dual_paraboloid\", \"octahedral\", got \"latlon\" (did you mean "
     "\"latlong\"?)"},
    {"Negative", R"({"image": "sky.hdr", "intensity": -1})",
     "r.json: line 2: environment.intensity: expected a number from 0 to 1000000000000, got -1"},
    {"Both", R"({"image": "sky.hdr", "intensity": 1, "exposure": 2})",
     "r.json: line 2: environment.exposure: give either intensity or exposure, not both"},
    {"BoxWithoutCenter", R"({"image": "sky.hdr", "box": {"low": [0,0,0], "high": [1,1,1]}})",
     "r.json: line 2: environment.center: is missing"},
    {"BoxInsideOut",
     R"({"image": "sky.hdr", "center": [0,0,0], "box": {"low": [-1,-1,1], "high": [1,1,-1]}})",
     "r.json: line 2: environment.box.high: expected corners greater than those of low"},
    {"CenterOutside",
     R"({"image": "sky.hdr", "center": [5,0,0], "box": {"low": [-1,-1,-1], "high": [1,1,1]}})",
     "r.json: line 2: environment.center: must lie within the box"},
    {"CenterAlone", R"({"image": "sky.hdr", "center": [5,0,0]})",
     "r.json: line 2: environment.center: has no effect without a box or a sphere"},
    {"Sphere", R"({"image": "sky.hdr", "center": [0,0,0], "sphere": {"radius": 0, "size": 1}})",
     "r.json: line 2: environment.sphere.radius: expected a number greater than 0 and at most 1000000000, "
     "got 0\n"
     "r.json: line 2: environment.sphere.size: a sphere has no key \"size\""},
    {"UnknownKey", R"({"image": "sky.hdr", "rotation": 3})",
     "r.json: line 2: environment.rotation: an environment has no key \"rotation\" (did you mean "
     "\"rotation_deg\"?)"},
};
INSTANTIATE_TEST_SUITE_P(Rig, InvalidRigEnvironment, testing::ValuesIn(kRigCases), case_name);

class InvalidGltfEnvironment : public testing::TestWithParam<Case> {};

TEST_P(InvalidGltfEnvironment, IsRefusedWithItsMessage) {
  const TemporaryFolder folder;
  folder.write("a.png", "x");
  json document = json::parse(triangle_builder().text());
  document["images"] = json::array({{{"uri", "a.png"}}});
  const json sound = json::parse(R"({"specularImageSize": 4, "specularImages": [[0,0,0,0,0,0]],
    "irradianceCoefficients": [[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0]]})");
  document["extensions"]["EXT_lights_image_based"]["lights"] =
      json::array({sound.patch(json::parse(GetParam().text))});
  document["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
  EXPECT_EQ(messages_of(load_scene({folder.write("s.gltf", document.dump())}), folder.path()),
            GetParam().messages);
}

#define LIGHT "s.gltf: extensions.EXT_lights_image_based.lights[0]"
const Case kGltfCases[] = {
    {"Sound", "[]", "loaded"},
    {"Coefficients", R"([{"op": "remove", "path": "/irradianceCoefficients/8"}])",
     LIGHT ".irradianceCoefficients: expected 9 triples, got 8"},
    {"Pair", R"([{"op": "replace", "path": "/irradianceCoefficients/2", "value": [1, 2]}])",
     LIGHT ".irradianceCoefficients[2]: expected 3 numbers, got an array of 2"},
    {"NoImages", R"([{"op": "remove", "path": "/specularImages"}])", LIGHT ".specularImages: is missing"},
    {"NoMips", R"([{"op": "replace", "path": "/specularImages", "value": []}])",
     LIGHT ".specularImages: expected 1 to 17 mips of 6 images, got 0"},
    {"FiveFaces", R"([{"op": "replace", "path": "/specularImages/0", "value": [0,0,0,0,0]}])",
     LIGHT ".specularImages[0]: expected 6 numbers, got an array of 5"},
    {"NoSuchImage", R"([{"op": "replace", "path": "/specularImages/0/3", "value": 1}])",
     LIGHT ".specularImages[0][3]: 1 is no index into the 1 images"},
    {"Rotation", R"([{"op": "add", "path": "/rotation", "value": [0, 0, 0, 0.5]}])",
     LIGHT ".rotation: expected a quaternion of length 1, got one of 0.5"},
    {"Intensity", R"([{"op": "add", "path": "/intensity", "value": -2}])",
     LIGHT ".intensity: expected a number from 0 to 1000000000000, got -2"},
};
#undef LIGHT
INSTANTIATE_TEST_SUITE_P(Gltf, InvalidGltfEnvironment, testing::ValuesIn(kGltfCases), case_name);

TEST(InvalidEnvironment, InCode) {
  const auto faults_of = [](void (*break_it)(Environment&)) {
    Scene scene;
    scene.pictures.resize(1);
    scene.pictures[0].file = "sky.hdr";
    scene.environment.emplace();
    scene.environment->picture = 0;
    break_it(*scene.environment);
    std::string text;
    for (const Diagnostic& fault : validate(scene)) text += to_string(fault) + "\n";
    return text;
  };
  EXPECT_EQ(faults_of([](Environment&) {}), "");
  EXPECT_EQ(faults_of([](Environment& e) { e.picture = -1; }),
            "environment: expected either a picture or specular_pictures\n");
  EXPECT_EQ(faults_of([](Environment& e) { e.picture = 3; }),
            "environment.picture: 3 is no index into the 1 pictures, nor -1 for none\n");
  EXPECT_EQ(faults_of([](Environment& e) { e.intensity = std::nan(""); }),
            "environment.intensity: expected a number from 0 to 1000000000000, got nan\n");
  EXPECT_EQ(faults_of([](Environment& e) { e.world_from_environment[0][0] = -1; }),
            "environment.world_from_environment: its columns are no right-handed rotation\n");
  EXPECT_EQ(faults_of([](Environment& e) { e.radius = -1; }),
            "environment.radius: expected a number from 0 to 1000000000, got -1\n");
}

TEST(InvalidEnvironment, PicturesOfTheWrongShape) {
  const auto message_of = [](int width, int height, std::optional<EnvironmentChart> chart) {
    Scene scene;
    scene.pictures.resize(1);
    scene.pictures[0].name = "sky.png";
    scene.pictures[0].pixels = std::make_shared<Image>(width, height, 3, PixelType::u8, Transfer::srgb);
    scene.environment.emplace();
    scene.environment->picture = 0;
    scene.environment->chart = chart;
    const auto renderer = Renderer::create(scene);
    return renderer ? std::string("made") : to_string(renderer.error());
  };
  EXPECT_EQ(message_of(16, 8, {}), "made");
  EXPECT_EQ(message_of(8, 8, EnvironmentChart::octahedral), "made");
  EXPECT_EQ(message_of(1, 1, EnvironmentChart::sphere), "made");
  EXPECT_EQ(
      message_of(8, 8, {}),
      "sky.png: cannot tell the chart of an environment of 8 x 8: name it by the key \"chart\" of a rig's "
      "\"environment\" (2:1 is taken for latlong, 6:1 for "
      "cube, 4:3 and 3:4 for crosses)");
  EXPECT_EQ(message_of(9, 3, EnvironmentChart::cube),
            "sky.png: a picture in the chart cube is 6:1; this one is 9 x 3");
}

TEST(InvalidEnvironment, Conversions) {
  LayeredImage picture;
  picture.width = 4;
  picture.height = 2;
  picture.channels = {{"Y", std::vector<float>(8, 1.0F)}};
  const auto message_of = [&](const EnvironmentConversion& conversion) {
    const auto converted = convert_environment(picture, conversion);
    return converted ? std::string("made") : to_string(converted.error());
  };
  EXPECT_EQ(message_of({EnvironmentChart::latlong, EnvironmentChart::cube, 3, 1}), "made");
  EXPECT_EQ(message_of({EnvironmentChart::cube, EnvironmentChart::latlong, 3, 1}),
            "a picture in the chart cube is 6:1; this one is 4 x 2");
  EXPECT_EQ(message_of({EnvironmentChart::latlong, EnvironmentChart::cube, 8193, 1}),
            "the size must be from 1 to 8192, got 8193");
  picture.channels[0].values[3] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(message_of({EnvironmentChart::latlong, EnvironmentChart::cube, 3, 1}),
            "the picture holds a value that is not finite");
  picture.channels[0].name = "Z";
  EXPECT_EQ(message_of({EnvironmentChart::latlong, EnvironmentChart::cube, 3, 1}),
            "the picture has neither R, G, B nor Y");
}

}  // namespace
}  // namespace laterna
