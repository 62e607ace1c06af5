// Files that are no scene at all, broken GLB containers and meshes, headers that claim more than their file holds: the
// exact message of each.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

std::string u32(std::uint32_t value) {
  std::string text;
  for (unsigned i = 0; i < 4; ++i) text += static_cast<char>(value >> (8 * i) & 0xFFU);
  return text;
}

std::string as_text(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::string with_u32(std::string content, std::size_t at, std::uint32_t value) {
  return content.replace(at, 4, u32(value));
}

// A GLB of a triangle: its JSON chunk begins at byte 12, its binary chunk of 36 bytes takes the last 44.
std::string glb() { return as_text(triangle_builder().glb()); }

std::string ply(const std::string& vertices, const std::string& faces) {
  return "ply\nformat ascii 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
}

// A Draco mesh of which nothing is there but an Edgebreaker header that claims so many vertices and triangles.
std::string draco_glb(bool with_metadata) {
  std::string mesh = std::string("DRACO\x02\x02\x01\x01\x00", 10) + (with_metadata ? '\x80' : '\0');
  if (with_metadata) mesh += std::string(3, '\0');  // no attribute's, no entries, no nested ones
  mesh += '\0';                                     // the standard traversal
  for (int number = 0; number < 2; ++number) mesh += std::string("\x80\xC2\xD7\x2F", 4);  // 100,000,000
  mesh += std::string(100, '\x01');
  GltfBuilder builder;
  const auto bytes = std::as_bytes(std::span(mesh));
  const int view = builder.view({bytes.begin(), bytes.end()});
  builder.add("accessors", {{"componentType", kF32}, {"count", 3}, {"type", "VEC3"}});
  builder.show(
      {{"attributes", {{"POSITION", 0}}},
       {"extensions",
        {{"KHR_draco_mesh_compression", {{"bufferView", view}, {"attributes", {{"POSITION", 0}}}}}}}});
  return as_text(builder.glb());
}

struct Case {
  const char* name;
  const char* file;
  std::string content;
  const char* message;
};

std::string case_name(const testing::TestParamInfo<Case>& info) { return info.param.name; }

class InvalidFile : public testing::TestWithParam<Case> {};

TEST_P(InvalidFile, IsRefusedWithItsMessage) {
  const TemporaryFolder folder;
  const Result<Scene> scene = load_scene({folder.write(GetParam().file, GetParam().content)});
  EXPECT_EQ(messages_of(scene, folder.path()), GetParam().message);
}

const std::string kGlb = glb();

const Case kCases[] = {
    {"Ending", "a.xyzzy", "x",
     "a.xyzzy: files ending in \".xyzzy\" are not read; expected .gltf, .glb, .obj, .ply, .stl, .md2, or "
     ".json for a rig"},
    {"NoEnding", "scene", "x",
     "scene: files ending in \"\" are not read; expected .gltf, .glb, .obj, .ply, .stl, .md2, or .json for a "
     "rig"},
    {"EmptyGlb", "a.glb", "",
     "a.glb: line 1: not valid JSON: syntax error while parsing value - unexpected end of input; expected "
     "'[', '{', or a "
     "literal"},
    {"NeitherGlbNorJson", "a.glb", "PK\x03\x04",
     "a.glb: line 1: not valid JSON: syntax error while parsing value - invalid literal; last read: 'P'"},
    {"JsonOfSomethingElse", "a.gltf", "{\"name\": \"package\"}", "a.gltf: asset: is missing"},
    {"NestedTooDeep", "a.gltf", std::string(300, '['), "a.gltf: line 1: nested more than 256 deep"},
    {"GlbHeaderCut", "a.glb", kGlb.substr(0, 11), "a.glb: byte 11: the file ends inside the GLB header"},
    {"GlbVersion", "a.glb", with_u32(kGlb, 4, 1),
     "a.glb: byte 4: GLB version 1 is not supported; expected 2"},
    {"GlbLength", "a.glb", with_u32(kGlb, 8, 0xFFFFFFFF),
     "a.glb: byte 8: the GLB says it has 4294967295 bytes, but the file has only 336"},
    {"GlbWithoutChunks", "a.glb", with_u32(kGlb, 8, 12), "a.glb: byte 12: the GLB has no JSON chunk"},
    {"GlbChunkHeaderCut", "a.glb", with_u32(kGlb, 8, 19),
     "a.glb: byte 12: the GLB ends inside a chunk header"},
    {"GlbChunkLength", "a.glb", with_u32(kGlb, 12, 0x7FFFFFFF),
     "a.glb: byte 12: the chunk says it has 2147483647 bytes, but only 316 follow"},
    {"GlbChunkType", "a.glb", with_u32(kGlb, 16, 0x004E4942),
     "a.glb: byte 16: the first chunk of a GLB must be its JSON"},
    {"GlbBinaryChunkLength", "a.glb", with_u32(kGlb, kGlb.size() - 44, 40),
     "a.glb: byte 292: the chunk says it has 40 bytes, but only 36 follow"},
    {"DracoClaims", "a.glb", draco_glb(false),
     "a.glb: meshes[0].primitives[0].extensions.KHR_draco_mesh_compression: the compressed mesh claims "
     "100000000 "
     "triangles, which cannot come out of 120 bytes"},
    {"DracoClaimsBehindMetadata", "a.glb", draco_glb(true),
     "a.glb: meshes[0].primitives[0].extensions.KHR_draco_mesh_compression: the compressed mesh claims "
     "100000000 "
     "triangles, which cannot come out of 123 bytes"},
    {"ObjEmpty", "a.obj", "", "a.obj: cannot be read: OBJ-file is too small."},
    {"ObjIndexBeyondItsVertices", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n",
     "a.obj: cannot be read: OBJ: vertex index out of range"},
    {"ObjOfPointsOnly", "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n",
     "a.obj: holds no triangles, only 3 points and lines"},
    {"PlyClaimsVertices", "a.ply", ply("400000000", "1"),
     "a.ply: line 3: the header claims 400000000 elements \"vertex\", more than a file of 188 bytes can "
     "hold"},
    {"PlyClaimsFaces", "a.ply", ply("3", "99999999999999999999999"),
     "a.ply: line 7: the header claims 18446744073709551615 elements \"face\", more than a file of 202 bytes "
     "can hold"},
    {"StlOfNothing", "a.stl", "solid a\nendsolid a\n",
     "a.stl: cannot be read: Mesh with invalid primitive type: a"},
    {"StlClaims", "a.stl", std::string(80, ' ') + u32(0xFFFFFFF0) + std::string(50, '\0'),
     "a.stl: cannot be read: Failed to determine STL storage representation for a.stl."},
    {"Md2OfSomethingElse", "a.md2", std::string(100, 'x'),
     "a.md2: cannot be read: Invalid MD2 magic word: expected IDP2, found xxxx"},
};

INSTANTIATE_TEST_SUITE_P(Files, InvalidFile, testing::ValuesIn(kCases), case_name);

TEST(InvalidScene, FilesThatAreNotThereOrNoFiles) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "folder.glb");
  EXPECT_EQ(messages_of(load_scene({folder.path() / "lost.glb"}), folder.path()), "lost.glb: no such file");
  EXPECT_EQ(messages_of(load_scene({folder.path() / "folder.glb"}), folder.path()),
            "folder.glb: is no regular file");
  EXPECT_EQ(messages_of(load_scene({}, {.rigs = {folder.path() / "lost.json"}}), folder.path()),
            "lost.json: cannot open: No such file or directory");
  EXPECT_EQ(messages_of(load_scene({}), folder.path()), "no scene file was given");
  EXPECT_EQ(messages_of(load_scene({folder.path() / "lost.obj"}, {.metres_per_unit = 0, .rigs = {}}),
                        folder.path()),
            "a unit must be longer than 0 m, got 0");
}

}  // namespace
}  // namespace laterna
