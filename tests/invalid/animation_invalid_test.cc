// Animations, skins, morph targets, paths and vertex frames that are broken, and exactly what is said about each.
#include <gtest/gtest.h>

#include <utility>

#include "scene/gltf_reader.h"
#include "scene/md2_frames.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

// A change to one place of a document: a JSON pointer and the new value; an empty value removes.
using Changes = std::vector<std::pair<std::string, std::string>>;

struct Case {
  const char* name;
  Changes changes;
  const char* messages;
};

std::string case_name(const testing::TestParamInfo<Case>& info) { return info.param.name; }

void apply(json& document, const Changes& changes) {
  for (const auto& [path, value] : changes) {
    json operation = {{"op", value.empty() ? "remove" : "add"}, {"path", path}};
    if (!value.empty()) operation["value"] = json::parse(value);
    document = document.patch(json::array({operation}));
  }
}

// A triangle on two joints, drawn toward a morph target, and turned.
GltfBuilder sound_gltf() {
  GltfBuilder builder;
  builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");                                // accessor 0
  builder.accessor<std::uint8_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4", kU8);  // accessor 1
  builder.floats({0.5F, 0.5F, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");                 // accessor 2
  builder.floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1,                     //
                  1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                 "MAT4");                                          // accessor 3
  builder.floats({0, 1}, "SCALAR");                                // accessor 4
  builder.floats({0, 0, 0, 1, 0, 1, 0, 0}, "VEC4");                // accessor 5
  builder.floats({0, 1}, "SCALAR");                                // accessor 6
  builder.floats({1, 0}, "SCALAR");                                // accessor 7: times that go back
  builder.floats({0, 0, 0, 0, 0, 0, 0, 0}, "VEC4");                // accessor 8: no rotations
  builder.floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1,  //
                  1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
                 "MAT4");             // accessor 9: the first is flat
  builder.floats({0, 0, 0}, "VEC3");  // accessor 10: one vertex
  json document = builder.document;
  document.update(json::parse(R"({
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}, "targets": [{"POSITION": 0}]}]}],
    "skins": [{"joints": [1, 2], "inverseBindMatrices": 3}],
    "nodes": [{"mesh": 0, "skin": 0}, {}, {}, {"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}],
    "scenes": [{"nodes": [0, 1, 2, 3]}],
    "animations": [{"channels": [{"sampler": 0, "target": {"node": 1, "path": "rotation"}},
                                 {"sampler": 1, "target": {"node": 0, "path": "weights"}}],
                    "samplers": [{"input": 4, "output": 5}, {"input": 4, "output": 6}]}]})"));
  builder.document = document;
  return builder;
}

class InvalidAnimation : public testing::TestWithParam<Case> {};

TEST_P(InvalidAnimation, IsRefusedWithItsMessage) {
  const TemporaryFolder folder;
  json document = sound_gltf().embedded();
  apply(document, GetParam().changes);
  const Result<Scene> scene = load_scene({folder.write("f.gltf", document.dump())});
  EXPECT_EQ(messages_of(scene, folder.path()), GetParam().messages);
}

TEST(InvalidAnimations, TheSoundOneLoads) {
  const TemporaryFolder folder;
  const Scene scene = load_or_fail({folder.write("f.gltf", sound_gltf().text())});
  EXPECT_EQ(scene.clips.size(), 1U);
  EXPECT_EQ(scene.skins.size(), 1U);
  EXPECT_EQ(warnings_of(scene), "");
}

const Case kCases[] = {
    {"NoChannels", {{"/animations/0/channels", ""}}, "f.gltf: animations[0].channels: is missing"},
    {"NoSamplers", {{"/animations/0/samplers", ""}}, "f.gltf: animations[0].samplers: is missing"},
    {"NoTarget",
     {{"/animations/0/channels/0/target", ""}},
     "f.gltf: animations[0].channels[0].target: is missing"},
    {"TargetNodeMissing",
     {{"/animations/0/channels/0/target/node", "9"}},
     "f.gltf: animations[0].channels[0].target.node: refers to nodes[9], but the last is nodes[3]"},
    {"UnknownPath",
     {{"/animations/0/channels/0/target/path", "\"colour\""}},
     "f.gltf: animations[0].channels[0].target.path: expected translation, rotation, scale, weights or "
     "pointer, "
     "got \"colour\""},
    {"SamplerMissing",
     {{"/animations/0/channels/0/sampler", "7"}},
     "f.gltf: animations[0].channels[0].sampler: refers to samplers[7], but the last is samplers[1]"},
    {"NodeWithAMatrix",
     {{"/animations/0/channels/0/target/node", "3"}},
     "f.gltf: animations[0].channels[0].target: nodes[3] has a matrix: only translation, rotation and scale "
     "move"},
    {"WeightsOfNothing",
     {{"/animations/0/channels/1/target/node", "2"}},
     "f.gltf: animations[0].channels[1].target: moves the weights of a mesh without morph targets"},
    {"TimesGoBack",
     {{"/animations/0/samplers/0/input", "7"}},
     "f.gltf: animations[0].samplers[0].input: key 1 is at 0 s, before key 0 at 1 s"},
    {"CountsDiffer",
     {{"/animations/0/samplers/0/interpolation", "\"CUBICSPLINE\""}},
     "f.gltf: animations[0].samplers[0].output: expected 24 numbers, 12 for each of 2 keys, got 8"},
    {"OutputOfAnotherType",
     {{"/animations/0/samplers/0/output", "0"}},
     "f.gltf: animations[0].samplers[0].output: expected VEC4, got accessors[0] of type VEC3"},
    {"RotationWithoutLength",
     {{"/animations/0/samplers/0/output", "8"}},
     "f.gltf: animations[0].samplers[0].output: the rotation of key 0 has no length"},
    {"UnknownInterpolation",
     {{"/animations/0/samplers/0/interpolation", "\"BEZIER\""}},
     "f.gltf: animations[0].samplers[0].interpolation: expected one of \"LINEAR\", \"STEP\", "
     "\"CUBICSPLINE\", got \"BEZIER\""},
    {"PointerToNowhere",
     {{"/animations/0/channels/0/target",
       R"({"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": "/materials/3/emissiveFactor"}}})"}},
     "f.gltf: animations[0].channels[0].target.extensions.KHR_animation_pointer.pointer: "
     "\"/materials/3/emissiveFactor\" leads nowhere: the file has 0 of them"},
    {"PointerWithoutItsExtension",
     {{"/animations/0/channels/0/target", R"({"path": "pointer"})"}},
     "f.gltf: animations[0].channels[0].target.path: \"pointer\" needs the extension KHR_animation_pointer"},
    {"NoJoints", {{"/skins/0/joints", ""}}, "f.gltf: skins[0].joints: is missing"},
    {"JointsEmpty", {{"/skins/0/joints", "[]"}}, "f.gltf: skins[0].joints: expected at least one joint"},
    {"JointBeyondTheNodes",
     {{"/skins/0/joints/1", "8"}, {"/skins/0/joints/2", ""}},
     "f.gltf: skins[0].joints[1]: refers to nodes[8], but there are only 4"},
    {"JointNotInTheScene",
     {{"/scenes/0/nodes", "[0, 1]"}},
     "f.gltf: skins[0].joints[1]: nodes[2] is a joint, but not in the scene that is shown"},
    {"SingularBind",
     {{"/skins/0/inverseBindMatrices", "9"}},
     "f.gltf: skins[0].inverseBindMatrices: matrix 0 is singular: it has no inverse"},
    {"TooFewBindMatrices",
     {{"/skins/0/joints", "[1, 2, 3]"}},
     "f.gltf: skins[0].inverseBindMatrices: has 2 matrices, but there are 3 joints"},
    {"JointsOutOfRange",
     {{"/skins/0/joints", "[1]"}},
     "f.gltf: nodes[0].skin: its mesh is pulled by joint 1, but skins[0] has only 1"},
    {"SkinMissing",
     {{"/nodes/0/skin", "4"}},
     "f.gltf: nodes[0].skin: refers to skins[4], but the last is skins[0]"},
    {"WeightsMissing",
     {{"/meshes/0/primitives/0/attributes/WEIGHTS_0", ""}},
     "f.gltf: meshes[0].primitives[0].attributes.WEIGHTS_0: is missing"},
    {"NegativeWeights",
     {{"/meshes/0/primitives/0/attributes/JOINTS_0", "2"}},
     "f.gltf: meshes[0].primitives[0].attributes.JOINTS_0: vertex 0: expected the number of a joint, got "
     "0.5"},
    {"TargetOfAnotherLength",
     {{"/meshes/0/primitives/0/targets/0/POSITION", "10"}},
     "f.gltf: meshes[0].primitives[0].targets[0].POSITION: has 1 elements, but the mesh has 3 vertices"},
};

INSTANTIATE_TEST_SUITE_P(Files, InvalidAnimation, testing::ValuesIn(kCases), case_name);

TEST(InvalidAnimations, EveryCutOfAnAnimatedGlbIsRefused) {
  const auto read = [](std::span<const std::byte> bytes) {
    const auto owner = std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end());
    return read_gltf(ByteSource::in_memory(owner), "f.glb", "nowhere").has_value();
  };
  const std::vector<std::byte> glb = sound_gltf().glb();
  ASSERT_TRUE(read(glb));
  for (std::size_t length = 0; length < glb.size(); ++length)
    EXPECT_FALSE(read(std::span(glb).first(length))) << length;
}

TEST(InvalidAnimations, OfScenesBuiltInCode) {
  Scene scene;
  scene.nodes.emplace_back();
  Clip& clip = scene.clips.emplace_back();
  clip.keys.push_back({KeyInterpolation::linear, {2, 1}, {0, 0, 0, 0, 0}});
  clip.channels.emplace_back();
  clip.channels[0].target = 0;
  clip.channels[0].keys = 0;
  scene.skins.emplace_back().joints = {5};
  std::string messages;
  for (const Diagnostic& fault : validate(scene)) messages += to_string(fault) + "\n";
  EXPECT_EQ(messages,
            "skins[0].joint_from_bind: has 0 matrices, but there are 1 joints\n"
            "skins[0].joints[0]: 5 is no index into the 1 nodes\n"
            "clips[0].keys[0].times[1]: expected a time not before 2, got 1\n"
            "clips[0].channels[0].target: nodes[0] has a matrix: only translation, rotation and scale move\n"
            "clips[0].channels[0]: expected 6 numbers, 3 for each of 2 keys, got 5\n");
}

std::string rig_messages(const std::string& path) {
  const TemporaryFolder folder;
  return messages_of(
      load_scene({folder.write(
          "r.json",
          R"({"lights": [{"type": "spot", "position": [0,5,0], "target": [0,0,0], "candela": 1, "path": )" +
              path + "}]}")}),
      folder.path());
}

TEST(InvalidPaths, AreRefusedWithTheirMessages) {
  const std::string place = "r.json: line 1: lights[0].path";
  EXPECT_EQ(rig_messages("{}"), place + ".keys: is missing");
  EXPECT_EQ(rig_messages(R"({"keys": []})"), place + ".keys: expected at least one key");
  EXPECT_EQ(rig_messages(R"({"keys": [{"time": 2}, {"time": 1}]})"),
            place + ".keys[1].time: 1 s does not come after the key before it, at 2 s");
  EXPECT_EQ(rig_messages(R"({"keys": [{}]})"), place + ".keys[0].time: is missing");
  EXPECT_EQ(
      rig_messages(R"({"keys": [{"time": 0, "position": [0,0,0]}]})"),
      place + ".keys[0].position: position and target are the same point: there is no direction to look in");
  EXPECT_EQ(rig_messages(R"({"keys": [{"time": 0, "position": [0,1,0]}, {"time": 1}]})"),
            place + ".keys[1]: either all keys of a path say where it stands or looks, or none does");
  EXPECT_EQ(rig_messages(R"({"keys": [{"time": 0, "lux": 3}]})"),
            place + ".keys[0].lux: only directional lights have lux");
  EXPECT_EQ(rig_messages(R"({"keys": [{"time": 0, "lumens": 3}]})"),
            place + ".keys[0].lumens: the light itself is not given in lumens");
  EXPECT_EQ(rig_messages(R"({"keys": [{"time": 0, "yfov_deg": 3}]})"),
            place + ".keys[0].yfov_deg: only what has a perspective frustum has a field of view");
  EXPECT_EQ(rig_messages(R"({"keys": [{"time": 0, "colour": 3}]})"),
            place + ".keys[0].colour: a key has no key \"colour\" (did you mean \"color\"?)");
}

TEST(InvalidVertexFrames, ACutModelSaysWhereItEnds) {
  std::string file(68 + 3 * 52, '\0');
  const auto put = [&](std::size_t at, std::uint32_t value) { std::memcpy(file.data() + at, &value, 4); };
  put(0, 844121161), put(16, 52), put(24, 3), put(40, 3), put(56, 68);
  const auto names = [&](std::size_t length) {
    return read_md2_frame_names(std::as_bytes(std::span(file).first(length)), "a.md2");
  };
  ASSERT_TRUE(names(file.size()));
  EXPECT_EQ(names(file.size())->size(), 3U);
  EXPECT_EQ(to_string(names(30).error()), "a.md2: byte 30: the file ends here, inside its header");
  for (std::size_t length = 4; length < file.size(); ++length) EXPECT_FALSE(names(length)) << length;
  EXPECT_EQ(to_string(names(150).error()), "a.md2: byte 150: the file ends here, inside frame 2 of 3");
  put(16, 20);
  EXPECT_EQ(to_string(names(file.size()).error()),
            "a.md2: byte 16: a frame of 3 vertices takes 52 bytes, but the header says 20");
}

}  // namespace
}  // namespace laterna
