// Bad glTF files, and exactly what is said about each.
#include <gtest/gtest.h>

#include <utility>

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

// A sound file that uses a little of everything.
json sound_gltf(const TemporaryFolder& folder) {
  folder.write("wood.png", "x");
  GltfBuilder builder;
  builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");         // accessor 0, view 0
  builder.accessor<std::uint16_t>({0, 1, 2}, "SCALAR", kU16);  // accessor 1, view 1
  builder.floats({0, 0, 1, 0, 0, 1}, "VEC2");                  // accessor 2, view 2
  builder.floats({0, 0, 0, 1, 0, 0, 0, 1}, "VEC4");            // accessor 3, view 3
  json document = builder.embedded();
  document.update(json::parse(R"({
    "images": [{"uri": "wood.png"}],
    "samplers": [{"wrapS": 10497}],
    "textures": [{"source": 0, "sampler": 0}],
    "materials": [{"name": "wood", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 2}, "indices": 1, "material": 0}]}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1, "zfar": 100}}],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {"outerConeAngle": 0.5}}]}},
    "nodes": [{"mesh": 0, "children": [1, 2]}, {"camera": 0}, {"extensions": {"KHR_lights_punctual": {"light": 0}}}],
    "scenes": [{"nodes": [0]}],
    "scene": 0})"));
  return document;
}

class InvalidGltf : public testing::TestWithParam<Case> {};

TEST_P(InvalidGltf, IsRefusedWithItsMessage) {
  const TemporaryFolder folder;
  json document = sound_gltf(folder);
  apply(document, GetParam().changes);
  const Result<Scene> scene = load_scene({folder.write("f.gltf", document.dump())});
  EXPECT_EQ(messages_of(scene, folder.path()), GetParam().messages);
}

TEST(InvalidScene, TheSoundGltfLoads) {
  const TemporaryFolder folder;
  const Scene scene = load_or_fail({folder.write("f.gltf", sound_gltf(folder).dump())});
  EXPECT_EQ(scene.nodes.size(), 3U);
  EXPECT_EQ(warnings_of(scene), "");
}

const Case kGltfCases[] = {
    // The file as a whole.
    {"NoAsset", {{"/asset", ""}}, "f.gltf: asset: is missing"},
    {"NoVersion", {{"/asset/version", ""}}, "f.gltf: asset.version: is missing"},
    {"OldVersion",
     {{"/asset/version", "\"1.0\""}},
     "f.gltf: asset.version: glTF \"1.0\" is not supported; expected 2.0"},
    {"NewerMinVersion",
     {{"/asset/minVersion", "\"2.1\""}},
     "f.gltf: asset.minVersion: the file needs glTF \"2.1\"; supported is 2.0"},
    {"RequiredExtension",
     {{"/extensionsRequired", R"(["KHR_texture_basisu", "ACME_cubes"])"}},
     "f.gltf: extensionsRequired[0]: the file requires the extension \"KHR_texture_basisu\", which is not "
     "supported\n"
     "f.gltf: extensionsRequired[1]: the file requires the extension \"ACME_cubes\", which is not supported"},
    {"RequiredNotAString",
     {{"/extensionsRequired", "[7]"}},
     "f.gltf: extensionsRequired[0]: expected a string, got 7"},
    {"BuffersNotAnArray",
     {{"/buffers", "{}"}},
     "f.gltf: buffers: expected an array, got an object\n"
     "f.gltf: bufferViews[0].buffer: refers to buffers[0], but there are no buffers\n"
     "f.gltf: bufferViews[1].buffer: refers to buffers[0], but there are no buffers\n"
     "f.gltf: bufferViews[2].buffer: refers to buffers[0], but there are no buffers\n"
     "f.gltf: bufferViews[3].buffer: refers to buffers[0], but there are no buffers"},

    // Buffers and views.
    {"BufferNotAnObject", {{"/buffers/0", "3"}}, "f.gltf: buffers[0]: expected an object, got 3"},
    {"NoByteLength", {{"/buffers/0/byteLength", ""}}, "f.gltf: buffers[0].byteLength: is missing"},
    {"ByteLengthBeyondTheData",
     {{"/buffers/0/byteLength", "1000000000000"}},
     "f.gltf: buffers[0].byteLength: says 1000000000000 bytes, but there are only 100"},
    {"ByteLengthNegative",
     {{"/buffers/0/byteLength", "-1"}},
     "f.gltf: buffers[0].byteLength: expected a whole number of at least 1, got -1"},
    {"ByteLengthHuge",
     {{"/buffers/0/byteLength", "10000000000000000000"}},
     "f.gltf: buffers[0].byteLength: expected a whole number of at least 1, got 1e+19"},
    {"UriNotAString", {{"/buffers/0/uri", "7"}}, "f.gltf: buffers[0].uri: expected a string, got 7"},
    {"BufferFileMissing",
     {{"/buffers/0/uri", "\"lost.bin\""}},
     "f.gltf: buffers[0].uri: \"lost.bin\" not found (tried \"lost.bin\")"},
    {"BufferFileAbsolute",
     {{"/buffers/0/uri", "\"/etc/passwd\""}},
     "f.gltf: buffers[0].uri: \"/etc/passwd\" is an absolute path; only files given relative to the scene "
     "are read"},
    {"BufferFileAbsoluteEscaped",
     {{"/buffers/0/uri", "\"%2Fetc%2Fpasswd\""}},
     "f.gltf: buffers[0].uri: \"%2Fetc%2Fpasswd\" is an absolute path; only files given relative to the "
     "scene are read"},
    {"BufferUrl",
     {{"/buffers/0/uri", "\"https://example.org/a.bin\""}},
     "f.gltf: buffers[0].uri: \"https://example.org/a.bin\" is a URL or has a drive letter; only files given "
     "relative to the scene are read"},
    {"BufferFileUrl",
     {{"/buffers/0/uri", "\"file:///etc/passwd\""}},
     "f.gltf: buffers[0].uri: \"file:///etc/passwd\" is a URL or has a drive letter; only files given "
     "relative to the scene are read"},
    {"BufferDrive",
     {{"/buffers/0/uri", "\"C:\\\\a.bin\""}},
     "f.gltf: buffers[0].uri: \"C:\\a.bin\" is a URL or has a drive letter; only files given relative to the "
     "scene are read"},
    {"BufferFolder", {{"/buffers/0/uri", "\".\""}}, "f.gltf: buffers[0].uri: \".\" not found (tried \".\")"},
    {"BufferNameEmpty", {{"/buffers/0/uri", "\"\""}}, "f.gltf: buffers[0].uri: the file name is empty"},
    {"BufferNameWithNul",
     {{"/buffers/0/uri", "\"a%00b\""}},
     "f.gltf: buffers[0].uri: the file name holds a NUL character"},
    {"DataUriWithoutComma",
     {{"/buffers/0/uri", "\"data:;base64\""}},
     "f.gltf: buffers[0].uri: the data URI has no comma"},
    {"DataUriBadDigit",
     {{"/buffers/0/uri", "\"data:;base64,AA*A\""}},
     "f.gltf: buffers[0].uri: character 2 of the base64 data is no base64 digit"},
    {"DataUriCutShort",
     {{"/buffers/0/uri", "\"data:;base64,AAAAA\""}},
     "f.gltf: buffers[0].uri: the base64 data is cut short"},
    {"BufferWithoutData",
     {{"/buffers/0/uri", ""},
      {"/bufferViews/3", ""},
      {"/bufferViews/2", ""},
      {"/bufferViews/1", ""},
      {"/accessors", "[]"},
      {"/nodes/0/mesh", ""}},
     "f.gltf: bufferViews[0].buffer: buffers[0] has no data: neither a uri nor a chunk of a GLB"},
    {"ViewBufferOutOfRange",
     {{"/bufferViews/3/buffer", "1"}},
     "f.gltf: bufferViews[3].buffer: refers to buffers[1], but the last is buffers[0]"},
    {"ViewOffsetBeyond",
     {{"/bufferViews/3/byteOffset", "1000"}},
     "f.gltf: bufferViews[3].byteLength: bytes 1000 to 1032 lie beyond the 100 bytes of buffers[0]"},
    {"ViewLengthBeyond",
     {{"/bufferViews/3/byteLength", "100"}},
     "f.gltf: bufferViews[3].byteLength: bytes 68 to 168 lie beyond the 100 bytes of buffers[0]"},
    {"ViewLengthOverflows",
     {{"/bufferViews/3/byteOffset", "9007199254740991"}, {"/bufferViews/3/byteLength", "9007199254740991"}},
     "f.gltf: bufferViews[3].byteLength: bytes 9007199254740991 to 18014398509481982 lie beyond the 100 "
     "bytes of buffers[0]"},
    {"ViewOffsetNegative",
     {{"/bufferViews/3/byteOffset", "-4"}},
     "f.gltf: bufferViews[3].byteOffset: expected a whole number of at least 0, got -4"},
    {"ViewStrideOdd",
     {{"/bufferViews/3/byteStride", "18"}},
     "f.gltf: bufferViews[3].byteStride: expected a multiple of 4, got 18\n"
     "f.gltf: accessors[3].count: 2 elements end at byte 34, but bufferViews[3] has only 32"},
    {"ViewStrideBig",
     {{"/bufferViews/3/byteStride", "256"}},
     "f.gltf: bufferViews[3].byteStride: expected a whole number from 4 to 252, got 256"},

    // Accessors.
    {"AccessorViewOutOfRange",
     {{"/accessors/3/bufferView", "4"}},
     "f.gltf: accessors[3].bufferView: refers to bufferViews[4], but the last is bufferViews[3]"},
    {"AccessorCountBeyond",
     {{"/accessors/3/count", "3"}},
     "f.gltf: accessors[3].count: 3 elements end at byte 48, but bufferViews[3] has only 32"},
    {"AccessorCountHuge",
     {{"/accessors/3/count", "10000000000000000000"}},
     "f.gltf: accessors[3].count: expected a whole number from 1 to 1073741824, got 1e+19"},
    {"AccessorCountZero",
     {{"/accessors/3/count", "0"}},
     "f.gltf: accessors[3].count: expected a whole number from 1 to 1073741824, got 0"},
    {"AccessorCountMissing", {{"/accessors/3/count", ""}}, "f.gltf: accessors[3].count: is missing"},
    {"AccessorOffsetBeyond",
     {{"/accessors/3/byteOffset", "4"}},
     "f.gltf: accessors[3].count: 2 elements end at byte 36, but bufferViews[3] has only 32"},
    {"AccessorOffsetHuge",
     {{"/accessors/3/byteOffset", "9007199254740984"}},
     "f.gltf: accessors[3].count: 2 elements end at byte 9007199254741016, but bufferViews[3] has only 32"},
    {"AccessorOffsetMisaligned",
     {{"/accessors/0/byteOffset", "2"}},
     "f.gltf: accessors[0].byteOffset: 2 (plus the view's 0) is no multiple of the component's size, 4"},
    {"AccessorStrideTooSmall",
     {{"/bufferViews/3/byteStride", "8"}},
     "f.gltf: accessors[3].bufferView: the byteStride of bufferViews[3], 8, is less than one element's 16 "
     "bytes"},
    {"AccessorComponentType",
     {{"/accessors/3/componentType", "5124"}},
     "f.gltf: accessors[3].componentType: expected 5120, 5121, 5122, 5123, 5125 or 5126, got 5124"},
    {"AccessorType",
     {{"/accessors/3/type", "\"VEC5\""}},
     "f.gltf: accessors[3].type: expected one of \"SCALAR\", \"VEC2\", \"VEC3\", \"VEC4\", \"MAT2\", "
     "\"MAT3\", \"MAT4\", got \"VEC5\" (did you mean \"VEC2\"?)"},
    {"AccessorTypeMissing", {{"/accessors/3/type", ""}}, "f.gltf: accessors[3].type: is missing"},
    {"AccessorNormalizedNotBoolean",
     {{"/accessors/3/normalized", "1"}},
     "f.gltf: accessors[3].normalized: expected true or false, got 1"},
    {"SparseCountBeyond",
     {{"/accessors/0/sparse",
       R"({"count": 4, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 0}})"}},
     "f.gltf: accessors[0].sparse.count: expected a whole number from 1 to 3, got 4"},
    {"SparseViewOutOfRange",
     {{"/accessors/0/sparse",
       R"({"count": 1, "indices": {"bufferView": 9, "componentType": 5123}, "values": {"bufferView": 0}})"}},
     "f.gltf: accessors[0].sparse.indices.bufferView: refers to bufferViews[9], but the last is "
     "bufferViews[3]"},
    {"SparseIndexType",
     {{"/accessors/0/sparse",
       R"({"count": 1, "indices": {"bufferView": 1, "componentType": 5126}, "values": {"bufferView": 0}})"}},
     "f.gltf: accessors[0].sparse.indices.componentType: expected 5121, 5123 or 5125, got 5126"},
    {"SparseIndexMisaligned",
     {{"/accessors/0/sparse",
       R"({"count": 1, "indices": {"bufferView": 1, "byteOffset": 1, "componentType": 5123}, "values": {"bufferView": 0}})"}},
     "f.gltf: accessors[0].sparse.indices.byteOffset: 1 (plus the view's 36) is no multiple of the "
     "component's size, 2"},
    {"SparseValuesBeyond",
     {{"/accessors/0/sparse",
       R"({"count": 3, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 2}})"}},
     "f.gltf: accessors[0].sparse.values.count: 3 elements end at byte 36, but bufferViews[2] has only 24"},
    {"SparseIndicesNotRising",
     {{"/accessors/0/sparse",
       R"({"count": 2, "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": 0}})"}},
     "f.gltf: accessors[0].sparse.indices: entry 1 is 0: expected rising indices up to 2"},
    {"SparseIncomplete",
     {{"/accessors/0/sparse", R"({"count": 1})"}},
     "f.gltf: accessors[0].sparse.indices: is missing\n"
     "f.gltf: accessors[0].sparse.values: is missing"},
    {"ZerosWithoutEnd",
     {{"/accessors/0/bufferView", ""}, {"/accessors/0/count", "100000000"}},
     "f.gltf: accessors[0].count: accessors without a bufferView hold more than 4194304 elements in all"},

    // Meshes.
    {"MeshWithoutPrimitives", {{"/meshes/0/primitives", ""}}, "f.gltf: meshes[0].primitives: is missing"},
    {"MeshEmpty",
     {{"/meshes/0/primitives", "[]"}},
     "f.gltf: meshes[0].primitives: expected at least one primitive"},
    {"PrimitiveWithoutAttributes",
     {{"/meshes/0/primitives/0/attributes", ""}},
     "f.gltf: meshes[0].primitives[0].attributes: is missing"},
    {"PrimitiveMode",
     {{"/meshes/0/primitives/0/mode", "7"}},
     "f.gltf: meshes[0].primitives[0].mode: expected 0 to 6, got 7"},
    {"PositionOutOfRange",
     {{"/meshes/0/primitives/0/attributes/POSITION", "4"}},
     "f.gltf: meshes[0].primitives[0].attributes.POSITION: refers to accessors[4], but the last is "
     "accessors[3]"},
    {"PositionOfWrongType",
     {{"/meshes/0/primitives/0/attributes/POSITION", "3"}},
     "f.gltf: meshes[0].primitives[0].attributes.POSITION: expected VEC3, got accessors[3] of type VEC4"},
    {"AttributeCountsDiffer",
     {{"/meshes/0/primitives/0/attributes/TANGENT", "3"}},
     "f.gltf: meshes[0].primitives[0].attributes.TANGENT: has 2 elements, but POSITION has 3"},
    {"IndicesOutOfRange",
     {{"/meshes/0/primitives/0/indices", "4"}},
     "f.gltf: meshes[0].primitives[0].indices: refers to accessors[4], but the last is accessors[3]"},
    {"IndicesOfWrongType",
     {{"/meshes/0/primitives/0/indices", "0"}},
     "f.gltf: meshes[0].primitives[0].indices: expected SCALAR, got accessors[0] of type VEC3"},
    {"IndicesSigned",
     {{"/accessors/1/componentType", "5122"}},
     "f.gltf: meshes[0].primitives[0].indices: expected unsigned integers, got accessors[1] with "
     "componentType 5122"},
    {"IndexBeyondTheVertices",
     {{"/accessors/0/count", "2"}, {"/accessors/2/count", "2"}},
     "f.gltf: meshes[0].primitives[0].indices: index 2 is 2, beyond the 2 vertices"},
    {"MaterialOutOfRange",
     {{"/meshes/0/primitives/0/material", "1"}},
     "f.gltf: meshes[0].primitives[0].material: refers to materials[1], but the last is materials[0]"},
    {"WeightsWithoutTargets",
     {{"/meshes/0/weights", "[1]"}},
     "f.gltf: meshes[0].primitives[0].targets: expected 1 morph targets, one for each weight, got 0"},
    {"WeightNotANumber",
     {{"/meshes/0/weights", "[true]"}, {"/meshes/0/primitives/0/targets", "[{}]"}},
     "f.gltf: meshes[0].weights[0]: expected a number, got true"},
    {"TargetOutOfRange",
     {{"/meshes/0/weights", "[1]"}, {"/meshes/0/primitives/0/targets", "[{\"POSITION\": 77}]"}},
     "f.gltf: meshes[0].primitives[0].targets[0].POSITION: refers to accessors[77], but the last is "
     "accessors[3]"},
    {"TargetTooShort",
     {{"/meshes/0/weights", "[1]"},
      {"/meshes/0/primitives/0/targets", "[{\"POSITION\": 4}]"},
      {"/accessors/4", R"({"count": 2, "type": "VEC3", "componentType": 5126})"}},
     "f.gltf: meshes[0].primitives[0].targets[0].POSITION: has 2 elements, but the mesh has 3 vertices"},
    {"TargetOverflows",
     {{"/meshes/0/weights", "[1e300]"}, {"/meshes/0/primitives/0/targets", "[{\"POSITION\": 0}]"}},
     "f.gltf: meshes[0].primitives[0].targets[0].POSITION: weight 1e+300 moves vertex 1 beyond all numbers"},
    {"DracoViewOutOfRange",
     {{"/meshes/0/primitives/0/extensions",
       R"({"KHR_draco_mesh_compression": {"bufferView": 9, "attributes": {}}})"}},
     "f.gltf: meshes[0].primitives[0].extensions.KHR_draco_mesh_compression.bufferView: refers to "
     "bufferViews[9], but the last is bufferViews[3]"},
    {"DracoCorrupt",
     {{"/meshes/0/primitives/0/extensions",
       R"({"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {}}})"}},
     "f.gltf: meshes[0].primitives[0].extensions.KHR_draco_mesh_compression: the compressed mesh is corrupt "
     "(Draco: Not a Draco file.)"},
    {"DracoIncomplete",
     {{"/meshes/0/primitives/0/extensions", R"({"KHR_draco_mesh_compression": {}})"}},
     "f.gltf: meshes[0].primitives[0].extensions.KHR_draco_mesh_compression.bufferView: is missing"},

    // Compressed views.
    {"MeshoptIncomplete",
     {{"/bufferViews/0/extensions", R"({"EXT_meshopt_compression": {"buffer": 0, "byteLength": 4}})"}},
     "f.gltf: bufferViews[0].extensions.EXT_meshopt_compression.byteStride: is missing\n"
     "f.gltf: bufferViews[0].extensions.EXT_meshopt_compression.count: is missing\n"
     "f.gltf: bufferViews[0].extensions.EXT_meshopt_compression.mode: is missing"},
    {"MeshoptMode",
     {{"/bufferViews/0/extensions",
       R"({"EXT_meshopt_compression": {"buffer": 0, "byteLength": 36, "byteStride": 12, "count": 3, "mode": "VERTICES"}})"}},
     "f.gltf: bufferViews[0].extensions.EXT_meshopt_compression.mode: expected one of \"ATTRIBUTES\", "
     "\"TRIANGLES\", \"INDICES\", got \"VERTICES\""},
    {"MeshoptStride",
     {{"/bufferViews/0/extensions",
       R"({"EXT_meshopt_compression": {"buffer": 0, "byteLength": 36, "byteStride": 13, "count": 3, "mode": "ATTRIBUTES"}})"}},
     "f.gltf: bufferViews[0].extensions.EXT_meshopt_compression: byteStride must be a multiple of 4 up to "
     "256, got 13"},
    {"MeshoptIndexStride",
     {{"/bufferViews/0/extensions",
       R"({"EXT_meshopt_compression": {"buffer": 0, "byteLength": 36, "byteStride": 12, "count": 3, "mode": "INDICES"}})"}},
     "f.gltf: bufferViews[0].extensions.EXT_meshopt_compression: byteStride must be 2 or 4 for indices, got "
     "12"},
    {"MeshoptFilterOnIndices",
     {{"/bufferViews/0/extensions",
       R"({"EXT_meshopt_compression": {"buffer": 0, "byteLength": 36, "byteStride": 4, "count": 3, "mode": "INDICES", "filter": "OCTAHEDRAL"}})"}},
     "f.gltf: bufferViews[0].extensions.EXT_meshopt_compression: a filter is only allowed with mode "
     "\"ATTRIBUTES\""},
    {"MeshoptFilterStride",
     {{"/bufferViews/0/extensions",
       R"({"EXT_meshopt_compression": {"buffer": 0, "byteLength": 36, "byteStride": 12, "count": 3, "mode": "ATTRIBUTES", "filter": "QUATERNION"}})"}},
     "f.gltf: bufferViews[0].extensions.EXT_meshopt_compression: byteStride must be 8 with filter "
     "\"QUATERNION\", got 12"},
    {"MeshoptBomb",
     {{"/bufferViews/0/extensions",
       R"({"EXT_meshopt_compression": {"buffer": 0, "byteLength": 36, "byteStride": 4, "count": 999999999, "mode": "TRIANGLES"}})"}},
     "f.gltf: bufferViews[0].extensions.EXT_meshopt_compression: 999999999 elements cannot come out of 36 "
     "compressed bytes"},
    {"MeshoptLength",
     {{"/bufferViews/0/extensions",
       R"({"EXT_meshopt_compression": {"buffer": 0, "byteLength": 36, "byteStride": 16, "count": 3, "mode": "ATTRIBUTES"}})"}},
     "f.gltf: bufferViews[0].byteLength: expected 48 (count · byteStride of EXT_meshopt_compression), got "
     "36"},
    {"MeshoptCorrupt",
     {{"/bufferViews/0/extensions",
       R"({"EXT_meshopt_compression": {"buffer": 0, "byteLength": 36, "byteStride": 12, "count": 3, "mode": "ATTRIBUTES"}})"}},
     "f.gltf: bufferViews[0].extensions.EXT_meshopt_compression: the compressed data are corrupt "
     "(meshoptimizer: -1)"},
    {"MeshoptTheSameBytesAgainAndAgain",
     {{"/bufferViews/0/extensions",
       R"({"EXT_meshopt_compression": {"buffer": 0, "byteLength": 100, "byteStride": 12, "count": 900, "mode": "ATTRIBUTES"}})"},
      {"/bufferViews/0/byteLength", "10800"},
      {"/bufferViews/1/extensions",
       R"({"EXT_meshopt_compression": {"buffer": 0, "byteLength": 100, "byteStride": 12, "count": 900, "mode": "ATTRIBUTES"}})"},
      {"/bufferViews/1/byteLength", "10800"}},
     "f.gltf: bufferViews[1].extensions.EXT_meshopt_compression: the compressed views of the file hold more "
     "than its "
     "buffers can\n"
     "f.gltf: bufferViews[0].extensions.EXT_meshopt_compression: the compressed data are corrupt "
     "(meshoptimizer: -1)"},
    {"MeshoptFallbackReadAsIfItHeldData",
     {{"/buffers/0/extensions", R"({"EXT_meshopt_compression": {"fallback": true}})"},
      {"/bufferViews/3", ""},
      {"/bufferViews/2", ""},
      {"/bufferViews/1", ""},
      {"/accessors", "[]"},
      {"/nodes/0/mesh", ""}},
     "f.gltf: bufferViews[0].buffer: buffers[0] has no data: it is a fallback for what is read compressed"},
    {"MeshoptBeyondItsBuffer",
     {{"/bufferViews/0/extensions",
       R"({"EXT_meshopt_compression": {"buffer": 0, "byteOffset": 100, "byteLength": 36, "byteStride": 12, "count": 3, "mode": "ATTRIBUTES"}})"}},
     "f.gltf: bufferViews[0].extensions.EXT_meshopt_compression.byteLength: bytes 100 to 136 lie beyond the "
     "100 bytes of buffers[0]"},

    // Materials and textures.
    {"TextureIndexMissing",
     {{"/materials/0/normalTexture", "{}"}},
     "f.gltf: materials[0].normalTexture.index: is missing"},
    {"TextureIndexOutOfRange",
     {{"/materials/0/normalTexture", "{\"index\": 1}"}},
     "f.gltf: materials[0].normalTexture.index: refers to textures[1], but the last is textures[0]"},
    {"TextureSourceOutOfRange",
     {{"/textures/0/source", "1"}},
     "f.gltf: textures[0].source: refers to images[1], but the last is images[0]"},
    {"TextureSamplerOutOfRange",
     {{"/textures/0/sampler", "1"}},
     "f.gltf: textures[0].sampler: refers to samplers[1], but the last is samplers[0]"},
    {"SamplerWrap",
     {{"/samplers/0/wrapS", "10496"}},
     "f.gltf: samplers[0].wrapS: expected 10497, 33071 or 33648, got 10496"},
    {"SamplerFilters",
     {{"/samplers/0/magFilter", "9987"}, {"/samplers/0/minFilter", "9730"}},
     "f.gltf: samplers[0].magFilter: expected 9728 or 9729, got 9987\n"
     "f.gltf: samplers[0].minFilter: expected 9728, 9729 or 9984 to 9987, got 9730"},
    {"ImageWithoutSource", {{"/images/0", "{}"}}, "f.gltf: images[0]: expected either a uri or a bufferView"},
    {"ImageWithTwoSources",
     {{"/images/0/bufferView", "0"}},
     "f.gltf: images[0]: expected either a uri or a bufferView"},
    {"ImageMissing",
     {{"/images/0/uri", "\"lost/wood.png\""}},
     "f.gltf: images[0].uri: \"lost/wood.png\" not found (tried \"lost/wood.png\"); used by "
     "materials[0].pbrMetallicRoughness.baseColorTexture (\"wood\")"},
    {"ImageUrl",
     {{"/images/0/uri", "\"http://example.org/wood.png\""}},
     "f.gltf: images[0].uri: \"http://example.org/wood.png\" is a URL or has a drive letter; only files "
     "given relative to the scene are read; used by materials[0].pbrMetallicRoughness.baseColorTexture "
     "(\"wood\")"},
    {"ImageViewOutOfRange",
     {{"/images/0", "{\"bufferView\": 4}"}},
     "f.gltf: images[0].bufferView: refers to bufferViews[4], but the last is bufferViews[3]"},
    {"ImageEmpty",
     {{"/images/0/uri", "\"data:image/png;base64,\""}},
     "f.gltf: images[0].uri: the data URI is empty; used by "
     "materials[0].pbrMetallicRoughness.baseColorTexture (\"wood\")"},
    {"AlphaMode",
     {{"/materials/0/alphaMode", "\"BLENDED\""}},
     "f.gltf: materials[0].alphaMode: expected one of \"OPAQUE\", \"MASK\", \"BLEND\", got \"BLENDED\" (did "
     "you mean \"BLEND\"?)"},
    {"FactorNotANumber",
     {{"/materials/0/pbrMetallicRoughness/metallicFactor", "\"1\""}},
     "f.gltf: materials[0].pbrMetallicRoughness.metallicFactor: expected a number, got \"1\""},
    {"ColourOfWrongLength",
     {{"/materials/0/pbrMetallicRoughness/baseColorFactor", "[1, 1, 1]"}},
     "f.gltf: materials[0].pbrMetallicRoughness.baseColorFactor: expected an array of 4 numbers, got an "
     "array of 3"},
    {"TextureTransform",
     {{"/materials/0/pbrMetallicRoughness/baseColorTexture/extensions",
       R"({"KHR_texture_transform": {"offset": [1], "rotation": 1e300, "scale": [1, "2"]}})"}},
     "f.gltf: materials[0].pbrMetallicRoughness.baseColorTexture.extensions.KHR_texture_transform.offset: "
     "expected an array of 2 numbers, got an array of 1\n"
     "f.gltf: materials[0].pbrMetallicRoughness.baseColorTexture.extensions.KHR_texture_transform.scale[1]: "
     "expected a number, got \"2\"\n"
     "f.gltf: materials[0].pbrMetallicRoughness.baseColorTexture.extensions.KHR_texture_transform.rotation: "
     "expected a number from -100000 to 100000, got 1e+300"},

    // Nodes and scenes.
    {"SceneOutOfRange", {{"/scene", "1"}}, "f.gltf: scene: refers to scenes[1], but the last is scenes[0]"},
    {"SceneNodeOutOfRange",
     {{"/scenes/0/nodes", "[3]"}},
     "f.gltf: scenes[0].nodes[0]: refers to nodes[3], but there are only 3"},
    {"SceneNodeNegative",
     {{"/scenes/0/nodes", "[-1]"}},
     "f.gltf: scenes[0].nodes[0]: expected the index of a node, got -1"},
    {"SceneNodeNotARoot",
     {{"/scenes/0/nodes", "[0, 1]"}},
     "f.gltf: scenes[0].nodes: nodes[1] is a child of nodes[0] and so no root"},
    {"SceneNodeTwice", {{"/scenes/0/nodes", "[0, 0]"}}, "f.gltf: scenes[0].nodes: nodes[0] is listed twice"},
    {"ChildOutOfRange",
     {{"/nodes/0/children", "[1, 2, 3]"}},
     "f.gltf: nodes[0].children[2]: refers to nodes[3], but there are only 3"},
    {"ChildTwice",
     {{"/nodes/0/children", "[1, 2, 2]"}},
     "f.gltf: nodes[2]: is a child of both nodes[0] and nodes[0]"},
    {"TwoParents",
     {{"/nodes/1/children", "[2]"}},
     "f.gltf: nodes[2]: is a child of both nodes[0] and nodes[1]"},
    {"OwnChild",
     {{"/nodes/0/children", "[1, 2, 0]"}},
     "f.gltf: nodes[0]: is its own ancestor\n"
     "f.gltf: scenes[0].nodes: nodes[0] is a child of nodes[0] and so no root"},
    {"Cycle",
     {{"/nodes/1/children", "[0]"}},
     "f.gltf: nodes[0]: is its own ancestor\n"
     "f.gltf: scenes[0].nodes: nodes[0] is a child of nodes[1] and so no root"},
    {"MeshOutOfRange",
     {{"/nodes/0/mesh", "1"}},
     "f.gltf: nodes[0].mesh: refers to meshes[1], but the last is meshes[0]"},
    {"MeshNegative",
     {{"/nodes/0/mesh", "-1"}},
     "f.gltf: nodes[0].mesh: expected a whole number of at least 0, got -1"},
    {"CameraOutOfRange",
     {{"/nodes/1/camera", "1"}},
     "f.gltf: nodes[1].camera: refers to cameras[1], but the last is cameras[0]"},
    {"LightOutOfRange",
     {{"/nodes/2/extensions/KHR_lights_punctual/light", "1"}},
     "f.gltf: nodes[2].extensions.KHR_lights_punctual.light: refers to lights[1], but the last is lights[0]"},
    {"MatrixOfWrongLength",
     {{"/nodes/0/matrix", "[1, 0, 0]"}},
     "f.gltf: nodes[0].matrix: expected an array of 16 numbers, got an array of 3"},
    {"MatrixAndTranslation",
     {{"/nodes/0/matrix", "[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]"}, {"/nodes/0/translation", "[0,0,0]"}},
     "f.gltf: nodes[0].translation: a node has either a matrix or translation, rotation and scale"},
    {"MatrixProjective",
     {{"/nodes/0/matrix", "[1,0,0,0, 0,1,0,0, 0,0,1,0.5, 0,0,0,1]"}},
     "f.gltf: nodes[0].matrix: the last row must be 0 0 0 1, got 0 0 0.5 1"},
    {"RotationZero",
     {{"/nodes/0/rotation", "[0, 0, 0, 0]"}},
     "f.gltf: nodes[0].rotation: expected a unit quaternion, got one without length"},
    {"TranslationFar",
     {{"/nodes/0/translation", "[1e300, 0, 0]"}},
     "f.gltf: nodes[1]: cameras[0] is more than 1000000000 m away\n"
     "f.gltf: nodes[2]: lights[0] is more than 1000000000 m away\n"
     "f.gltf: nodes[0]: meshes[0] reaches more than 1000000000 m from the origin"},
    {"CameraWithoutScale",
     {{"/nodes/1/scale", "[1, 1, 0]"}},
     "f.gltf: nodes[1]: cameras[0] cannot stand here: the matrix has no direction along Z: its third column "
     "is zero"},
    {"InstancesWithoutAttributes",
     {{"/nodes/0/extensions", R"({"EXT_mesh_gpu_instancing": {}})"}},
     "f.gltf: nodes[0].extensions.EXT_mesh_gpu_instancing.attributes: is missing"},
    {"InstancesCountDifferently",
     {{"/nodes/0/extensions",
       R"({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0, "ROTATION": 3}}})"}},
     "f.gltf: nodes[0].extensions.EXT_mesh_gpu_instancing.attributes: the attributes count differently: 2 "
     "and 3 instances"},
    {"InstanceRotationZero",
     {{"/nodes/0/extensions", R"({"EXT_mesh_gpu_instancing": {"attributes": {"ROTATION": 4}}})"},
      {"/accessors/4", R"({"count": 2, "type": "VEC4", "componentType": 5126})"}},
     "f.gltf: nodes[0].extensions.EXT_mesh_gpu_instancing.attributes.ROTATION: instance 0: expected a unit "
     "quaternion, got one without length"},
    {"InstancesWithoutEnd",
     {{"/nodes/0/extensions", R"({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 4}}})"},
      {"/accessors/4", R"({"count": 16777217, "type": "VEC3", "componentType": 5126})"}},
     "f.gltf: nodes[0].extensions.EXT_mesh_gpu_instancing.attributes.TRANSLATION: the file shows more than "
     "16777216 "
     "instances"},
    {"InstanceAttributeType",
     {{"/nodes/0/extensions", R"({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2}}})"}},
     "f.gltf: nodes[0].extensions.EXT_mesh_gpu_instancing.attributes.TRANSLATION: expected VEC3, got "
     "accessors[2] of type VEC2"},

    // Cameras and lights.
    {"CameraType",
     {{"/cameras/0/type", "\"fisheye\""}},
     "f.gltf: cameras[0].type: expected one of \"perspective\", \"orthographic\", got \"fisheye\""},
    {"CameraLensMissing", {{"/cameras/0/perspective", ""}}, "f.gltf: cameras[0].perspective: is missing"},
    {"CameraFieldOfView",
     {{"/cameras/0/perspective/yfov", "3.2"}},
     "f.gltf: cameras[0].perspective.yfov: expected a number between 0 and 3.141592653589793, got 3.2"},
    {"CameraNearZero",
     {{"/cameras/0/perspective/znear", "0"}},
     "f.gltf: cameras[0].perspective.znear: expected a number greater than 0, got 0"},
    {"CameraFarBeforeNear",
     {{"/cameras/0/perspective/zfar", "0.1"}},
     "f.gltf: cameras[0].perspective.zfar: must be beyond znear (0.1), got 0.1"},
    {"CameraAspect",
     {{"/cameras/0/perspective/aspectRatio", "0"}},
     "f.gltf: cameras[0].perspective.aspectRatio: expected a number greater than 0, got 0"},
    {"CameraOrthographic",
     {{"/cameras/0", R"({"type": "orthographic", "orthographic": {"xmag": 0, "ymag": -1, "znear": -1}})"}},
     "f.gltf: cameras[0].orthographic.xmag: expected a number greater than 0, got 0\n"
     "f.gltf: cameras[0].orthographic.ymag: expected a number greater than 0, got -1\n"
     "f.gltf: cameras[0].orthographic.znear: expected a number of at least 0, got -1\n"
     "f.gltf: cameras[0].orthographic.zfar: is missing"},
    {"LightType",
     {{"/extensions/KHR_lights_punctual/lights/0/type", "\"area\""}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].type: expected one of \"directional\", \"point\", "
     "\"spot\", got \"area\""},
    {"LightNegative",
     {{"/extensions/KHR_lights_punctual/lights/0/intensity", "-5"},
      {"/extensions/KHR_lights_punctual/lights/0/color", "[1, -1, 1]"}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].color[1]: expected a number of at least 0, got -1\n"
     "f.gltf: extensions.KHR_lights_punctual.lights[0].intensity: expected a number of at least 0, got -5"},
    {"LightRange",
     {{"/extensions/KHR_lights_punctual/lights/0/range", "0"}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].range: expected a number greater than 0, got 0"},
    {"LightSpotMissing",
     {{"/extensions/KHR_lights_punctual/lights/0/spot", ""}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].spot: is missing"},
    {"LightCones",
     {{"/extensions/KHR_lights_punctual/lights/0/spot/innerConeAngle", "0.6"}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].spot.innerConeAngle: must not exceed outerConeAngle "
     "(0.5), got 0.6"},
    {"LightConeWide",
     {{"/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle", "1.6"}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].spot.outerConeAngle: expected a number from 0 to "
     "1.5707964, got 1.6"},
    {"LightBlinding",
     {{"/extensions/KHR_lights_punctual/lights/0/intensity", "1e200"},
      {"/extensions/KHR_lights_punctual/lights/0/color", "[0, 2, 1]"}},
     "f.gltf: lights[0].intensity: 1e+200 times the colour's 2 is more than 1e+30"},

    // Our own extensions: what rigs say, in the words of glTF.
    {"ProjectorUnknownKey",
     {{"/extensions/KHR_lights_punctual/lights/0/extensions",
       R"({"LATERNA_projector": {"yfov": 1, "outsid": "clamp"}})"}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].extensions.LATERNA_projector.outsid: a projector has "
     "no key \"outsid\" (did you mean \"outside\"?)"},
    {"ProjectorInTheWordsOfRigs",
     {{"/extensions/KHR_lights_punctual/lights/0/extensions", R"({"LATERNA_projector": {"yfov_deg": 30}})"}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].extensions.LATERNA_projector: needs one of \"yfov\", "
     "\"xfov\", \"focalLength\", \"intrinsics\", \"orthographic\", \"frustum\", \"throwRatio\"\n"
     "f.gltf: extensions.KHR_lights_punctual.lights[0].extensions.LATERNA_projector.yfov_deg: a projector "
     "has no key \"yfov_deg\" (did you mean \"yfov\"?)"},
    {"ProjectorWide",
     {{"/extensions/KHR_lights_punctual/lights/0/extensions", R"({"LATERNA_projector": {"yfov": 4}})"}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].extensions.LATERNA_projector.yfov: expected a number "
     "between 0 and 3.141592653589793, got 4"},
    {"ProjectorSlide",
     {{"/extensions/KHR_lights_punctual/lights/0/extensions",
       R"({"LATERNA_projector": {"yfov": 1, "texture": {"index": 7}}})"}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].extensions.LATERNA_projector.texture.index: refers to "
     "textures[7], but the last is textures[0]"},
    {"ProjectorTwoSlides",
     {{"/extensions/KHR_lights_punctual/lights/0/extensions",
       R"({"LATERNA_projector": {"yfov": 1, "texture": {"index": 0}, "film": "wood.png"}})"}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].extensions.LATERNA_projector.film: give either film "
     "or texture, not both"},
    {"ProjectorImage",
     {{"/extensions/KHR_lights_punctual/lights/0/extensions",
       R"({"LATERNA_projector": {"yfov": 1, "intensityMap": {"uri": "none.exr"}}})"}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].extensions.LATERNA_projector.intensityMap.uri: "
     "\"none.exr\" not "
     "found (tried \"none.exr\")"},
    {"ProjectorFilmElsewhere",
     {{"/extensions/KHR_lights_punctual/lights/0/extensions",
       R"({"LATERNA_projector": {"yfov": 1, "film": "/tmp/f.####.png"}})"}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].extensions.LATERNA_projector.film: "
     "\"/tmp/f.####.png\" is an absolute path; only files given relative to the scene are read"},
    {"ProjectorWord",
     {{"/extensions/KHR_lights_punctual/lights/0/extensions",
       R"({"LATERNA_projector": {"yfov": 1, "profile": "flat_field"}})"}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].extensions.LATERNA_projector.profile: expected one of "
     "\"flatField\", \"uniformCandela\", got \"flat_field\" (did you mean \"flatField\"?)"},
    {"ProjectorShadow",
     {{"/extensions/KHR_lights_punctual/lights/0/extensions",
       R"({"LATERNA_projector": {"yfov": 1, "shadow": {"constantBias": "much"}}})"}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].extensions.LATERNA_projector.shadow.constantBias: "
     "expected a number from -1000000000 to 1000000000, got \"much\""},
    {"ProjectorFocus",
     {{"/extensions/KHR_lights_punctual/lights/0/extensions",
       R"({"LATERNA_projector": {"yfov": 1, "focusDistance": 2}})"}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].extensions.LATERNA_projector.focusDistance: needs "
     "\"apertureRadius\" beside it: through a pinhole all is in focus"},
    {"ProjectorFar",
     {{"/extensions/KHR_lights_punctual/lights/0/extensions",
       R"({"LATERNA_projector": {"yfov": 1, "zfar": 0.05}})"}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].extensions.LATERNA_projector.zfar: must be beyond "
     "znear (0.1), got 0.05"},
    {"ProjectorThatIsAPoint",
     {{"/extensions/KHR_lights_punctual/lights/0/type", R"("point")"},
      {"/extensions/KHR_lights_punctual/lights/0/extensions", R"({"LATERNA_projector": {"yfov": 1}})"}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].extensions.LATERNA_projector: only a light of type "
     "\"spot\" can be a projector"},
    {"ProjectorTwice",
     {{"/extensions/KHR_lights_punctual/lights/0/extensions",
       R"({"LATERNA_projector": {"yfov": 1}, "LATERNA_lighting": {}})"}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].extensions.LATERNA_lighting: stands beside "
     "LATERNA_projector, which says all of it: give one of them"},
    {"LightingCones",
     {{"/extensions/KHR_lights_punctual/lights/0/extensions",
       R"({"LATERNA_lighting": {"innerConeAngle": 0.75}})"}},
     "f.gltf: extensions.KHR_lights_punctual.lights[0].extensions.LATERNA_lighting.innerConeAngle: the inner "
     "cone (0.75) must not exceed the outer cone (0.5)"},
    {"LightingOfANode",
     {{"/nodes/0/extensions", R"({"LATERNA_lighting": {"castsShadow": 1, "casts_shadow": true}})"}},
     "f.gltf: nodes[0].extensions.LATERNA_lighting.castsShadow: expected true or false, got 1\n"
     "f.gltf: nodes[0].extensions.LATERNA_lighting.casts_shadow: a node has no key \"casts_shadow\""},
    {"LightingOfAScene",
     {{"/scenes/0/extensions", R"({"LATERNA_lighting": {"ambient": [0, 1, -1]}})"}},
     "f.gltf: scenes[0].extensions.LATERNA_lighting.ambient[2]: expected a number from 0 to 1000000000000, "
     "got -1"},
    {"LightingOfACamera",
     {{"/cameras/0/extensions",
       R"({"LATERNA_lighting": {"frustum": {"left": 1, "right": 0, "bottom": 0, "top": 1}}})"}},
     "f.gltf: cameras[0].extensions.LATERNA_lighting: the frustum has no width or no height"},

    // Several at once.
    {"Several",
     {{"/accessors/3/count", "-1"}, {"/nodes/1/camera", "5"}, {"/bufferViews/2/byteLength", "\"24\""}},
     "f.gltf: bufferViews[2].byteLength: expected a whole number of at least 1, got \"24\"\n"
     "f.gltf: accessors[3].count: expected a whole number from 1 to 1073741824, got -1\n"
     "f.gltf: nodes[1].camera: refers to cameras[5], but the last is cameras[0]"},
};

INSTANTIATE_TEST_SUITE_P(Gltf, InvalidGltf, testing::ValuesIn(kGltfCases), case_name);

}  // namespace
}  // namespace laterna
