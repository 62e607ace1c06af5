// Files that end too early: every length of a GLB, a glTF and a rig is refused, and no length of any format
// crashes.
#include <gtest/gtest.h>

#include "scene/gltf_reader.h"
#include "scene/rig_reader.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

Result<Scene> read_bytes(std::span<const std::byte> bytes) {
  const auto owner = std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end());
  return read_gltf(ByteSource::in_memory(owner), "f.glb", "nowhere");
}

GltfBuilder small_scene() {
  GltfBuilder builder = triangle_builder();
  builder.add("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.5}}}});
  builder.add("nodes", {{"camera", 0}});
  return builder;
}

TEST(SceneTruncation, EveryCutOfAGlbIsRefused) {
  const std::vector<std::byte> glb = small_scene().glb();
  ASSERT_TRUE(read_bytes(glb).has_value());
  for (std::size_t length = 0; length < glb.size(); ++length) {
    EXPECT_FALSE(read_bytes(std::span(glb).first(length)).has_value()) << length;
  }
}

TEST(SceneTruncation, EveryCutOfAGltfIsRefused) {
  const std::string text = small_scene().text();
  const std::span<const std::byte> bytes = std::as_bytes(std::span(text));
  ASSERT_TRUE(read_bytes(bytes).has_value());
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_FALSE(read_bytes(bytes.first(length)).has_value()) << length;
  }
}

TEST(SceneTruncation, EveryCutOfAnExternalBufferIsRefused) {
  const TemporaryFolder folder;
  GltfBuilder builder = triangle_builder();
  builder.document["buffers"] = json::array({{{"byteLength", 36}, {"uri", "a.bin"}}});
  const auto file = folder.write("f.gltf", builder.text());
  for (std::size_t length = 0; length < 36; ++length) {
    folder.write("a.bin", std::span<const std::byte>(builder.binary).first(length));
    EXPECT_EQ(messages_of(load_scene({file}), folder.path()),
              "f.gltf: buffers[0].byteLength: says 36 bytes, but there are only " + std::to_string(length));
  }
}

TEST(SceneTruncation, EveryCutOfARigIsRefused) {
  const std::string text = R"({
    "ambient": [0.1, 0.2, 0.3],
    "cameras": [{"name": "main", "position": [0, 1, 5], "target": [0, 1, 0], "yfov_deg": 40}],
    "lights": [{"type": "spot", "position": [0, 5, 0], "target": [0, 0, 0], "candela": 1e2, "shadow": {"resolution": 512}}],
    "nodes": [],
    "surfaces": [{"material": "wall", "layers": [{"color": [1, 0, 0], "blend": "min", "opacity": 0.5}]}]})";
  ASSERT_TRUE(read_rig(text, "r.json", "nowhere").has_value());
  for (std::size_t length = 0; length < text.size(); ++length) {
    EXPECT_FALSE(read_rig(std::string_view(text).substr(0, length), "r.json", "nowhere").has_value())
        << length;
  }
}

// A changed byte may be harmless or not, but never a crash.
TEST(SceneTruncation, EveryChangedByteOfAGlbIsReadOrRefused) {
  const std::vector<std::byte> glb = small_scene().glb();
  for (std::size_t at = 0; at < glb.size(); ++at) {
    for (const unsigned value : {0x00U, 0xFFU, 0x2DU, 0x39U}) {  // NUL, all ones, minus, nine
      std::vector<std::byte> changed = glb;
      changed[at] = static_cast<std::byte>(value);
      const Result<Scene> scene = read_bytes(changed);
      EXPECT_TRUE(scene.has_value() || !scene.error().diagnostics.empty());
    }
  }
}

// Corners of a triangle, as the little-endian floats of a binary file.
std::string triangle_floats() {
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  return {reinterpret_cast<const char*>(corners), sizeof corners};
}

std::string binary_ply() {
  return "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
         "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n" +
         triangle_floats() + std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13);
}

std::string binary_stl() {
  return std::string(80, ' ') + std::string("\1\0\0\0", 4) + std::string(12, '\0') + triangle_floats() +
         std::string(2, '\0');
}

TEST(SceneTruncation, NoCutOfAMeshFileCrashes) {
  const TemporaryFolder folder;
  const std::pair<const char*, std::string> files[] = {
      {"a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\nusemtl m\nf 1/1/1 2/1/1 3/1/1\n"},
      {"a.ply",
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
       "z\nelement face 1\n"
       "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
      {"a.stl",
       "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
       "0\nendloop\nendfacet\nendsolid t\n"},
      {"b.ply", binary_ply()},
      {"b.stl", binary_stl()}};
  for (const auto& [name, content] : files) {
    ASSERT_TRUE(load_scene({folder.write(name, content)}).has_value());
    for (std::size_t length = 0; length < content.size(); ++length) {
      const Result<Scene> scene =
          load_scene({folder.write(name, std::string_view(content).substr(0, length))});
      EXPECT_TRUE(scene.has_value() || !scene.error().diagnostics.empty());
    }
  }
}

}  // namespace
}  // namespace laterna
