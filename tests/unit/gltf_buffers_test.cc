// Where a glTF file's bytes may come from: GLB, files beside it, data URIs, compressed views.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cmath>

#include "scene/meshopt_buffers.h"
#include "scene/uri.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

const std::vector<glm::vec3> kTriangle = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

std::string text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::vector<glm::vec3> positions_with_uri(const TemporaryFolder& folder, const std::string& uri) {
  GltfBuilder builder = triangle_builder();
  builder.document["buffers"] = json::array({{{"byteLength", 36}, {"uri", uri}}});
  return only_primitive(load_or_fail({folder.write("scene.gltf", builder.text())})).positions;
}

TEST(GltfBuffers, DataUrisWithAnyOrNoMediaType) {
  const TemporaryFolder folder;
  const std::string digits = base64(triangle_builder().binary);
  for (const std::string head :
       {"data:application/octet-stream;base64,", "data:application/gltf-buffer;base64,", "data:;base64,",
        "data:text/plain;charset=utf-8;base64,"}) {
    EXPECT_EQ(positions_with_uri(folder, head + digits), kTriangle) << head;
  }
}

TEST(GltfBuffers, DataUrisWithPercentEncoding) {
  const TemporaryFolder folder;
  std::string uri = "data:application/octet-stream,";
  for (const std::byte b : triangle_builder().binary) {
    char text[4];
    std::snprintf(text, sizeof text, "%%%02X", std::to_integer<unsigned>(b));
    uri += text;
  }
  EXPECT_EQ(positions_with_uri(folder, uri), kTriangle);
}

TEST(GltfBuffers, Base64OfEveryLength) {
  for (std::size_t length = 0; length < 9; ++length) {
    std::vector<std::byte> bytes(length);
    for (std::size_t i = 0; i < length; ++i) bytes[i] = static_cast<std::byte>(251 + 7 * i);
    const auto decoded = decode_data_uri("data:;base64," + base64(bytes));
    ASSERT_TRUE(decoded.has_value());
    EXPECT_EQ(*decoded, bytes);
  }
}

TEST(GltfBuffers, FilesWithAwkwardNames) {
  const TemporaryFolder folder;
  const std::string bytes = text_of(triangle_builder().binary);
  const struct {
    std::string file, uri;
  } cases[] = {{"plain.bin", "plain.bin"},
               {"with space.bin", "with space.bin"},
               {"with space.bin", "with%20space.bin"},
               {"Grüße.bin", "Grüße.bin"},
               {"Grüße.bin", "Gr%C3%BC%C3%9Fe.bin"},
               {"100%25.bin", "100%25.bin"},  // no file called "100%.bin": taken as written
               {"a%b.bin", "a%b.bin"},
               {"sub/deep.bin", "sub/deep.bin"},
               {"sub/deep.bin", "sub\\deep.bin"},
               {"sub/deep.bin", "./sub/../sub/deep.bin"}};
  for (const auto& [file, uri] : cases) {
    folder.write(file, bytes);
    EXPECT_EQ(positions_with_uri(folder, uri), kTriangle) << uri;
  }
}

TEST(GltfBuffers, ParentFoldersMayBeReferredTo) {
  const TemporaryFolder folder;
  folder.write("shared/triangle.bin", text_of(triangle_builder().binary));
  GltfBuilder builder = triangle_builder();
  builder.document["buffers"] = json::array({{{"byteLength", 36}, {"uri", "../shared/triangle.bin"}}});
  EXPECT_EQ(only_primitive(load_or_fail({folder.write("scene/scene.gltf", builder.text())})).positions,
            kTriangle);
}

TEST(GltfBuffers, GlbWithItsChunk) {
  const TemporaryFolder folder;
  const Scene scene = load_or_fail({folder.write("scene.glb", triangle_builder().glb())});
  EXPECT_EQ(only_primitive(scene).positions, kTriangle);
}

TEST(GltfBuffers, GlbPaddedWithNulsAndWithAnUnknownChunk) {
  const TemporaryFolder folder;
  GltfBuilder builder = triangle_builder();
  builder.document["buffers"] = json::array({{{"byteLength", 36}}});
  std::string text = builder.document.dump();
  text.resize((text.size() + 3) / 4 * 4 + 4, '\0');
  std::vector<std::byte> glb = GltfBuilder::make_glb(text, builder.binary);
  for (const unsigned value : {4U, 0U, 0U, 0U, 'X' + 0U, 'Y' + 0U, 'Z' + 0U, '1' + 0U, 1U, 2U, 3U, 4U}) {
    glb.push_back(static_cast<std::byte>(value));
  }
  const auto length = static_cast<std::uint32_t>(glb.size());
  std::memcpy(&glb[8], &length, 4);
  EXPECT_EQ(only_primitive(load_or_fail({folder.write("scene.glb", glb)})).positions, kTriangle);
}

// -------------------------------------------------------------------------------------------
// EXT_meshopt_compression

// Replaces the bytes of a view by a compressed form in a second buffer; the view itself moves to a buffer
// without data.
void compress_view(GltfBuilder& builder, int view, const std::vector<std::byte>& compressed,
                   std::size_t count, std::size_t stride, const std::string& mode,
                   const std::string& filter) {
  json& value = builder.document["bufferViews"][static_cast<std::size_t>(view)];
  std::vector<std::byte>& chunk = builder.binary;
  chunk.resize((chunk.size() + 3) / 4 * 4);
  value["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                    {"byteOffset", chunk.size()},
                                                    {"byteLength", compressed.size()},
                                                    {"byteStride", stride},
                                                    {"count", count},
                                                    {"mode", mode}};
  if (!filter.empty()) value["extensions"]["EXT_meshopt_compression"]["filter"] = filter;
  chunk.insert(chunk.end(), compressed.begin(), compressed.end());
  value["buffer"] = 1;
  value["byteOffset"] = 0;
}

Scene load_compressed(GltfBuilder& builder) {
  const TemporaryFolder folder;
  builder.document["extensionsRequired"] = {"EXT_meshopt_compression"};
  builder.document["buffers"] = json::array(
      {{{"byteLength", builder.binary.size()}},
       {{"byteLength", 1 << 20}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}});
  return load_or_fail({folder.write("scene.glb", builder.glb())});
}

std::vector<std::byte> encode_vertices(const std::vector<std::byte>& vertices, std::size_t stride) {
  const std::size_t count = vertices.size() / stride;
  std::vector<std::byte> out(meshopt_encodeVertexBufferBound(count, stride));
  out.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(out.data()), out.size(),
                                        vertices.data(), count, stride));
  return out;
}

// A strip of quads along x: 2 · n vertices, 2 · (n − 1) triangles.
struct Ribbon {
  std::vector<float> positions;
  std::vector<unsigned> indices;
};
Ribbon make_ribbon(unsigned n) {
  Ribbon ribbon;
  for (unsigned i = 0; i < n; ++i) {
    for (const float y : {0.0F, 1.0F})
      ribbon.positions.insert(ribbon.positions.end(), {static_cast<float>(i), y, 0.5F});
    if (i + 1 < n) {
      const unsigned k = 2 * i;
      ribbon.indices.insert(ribbon.indices.end(), {k, k + 2, k + 1, k + 1, k + 2, k + 3});
    }
  }
  return ribbon;
}

TEST(GltfMeshopt, AttributesAndTriangles) {
  const Ribbon ribbon = make_ribbon(200);
  const std::size_t vertices = ribbon.positions.size() / 3, indices = ribbon.indices.size();
  for (const bool wide : {true, false}) {
    GltfBuilder builder;
    builder.floats(ribbon.positions, "VEC3");
    if (wide) {
      builder.accessor(ribbon.indices, "SCALAR", kU32);
    } else {
      builder.accessor(std::vector<std::uint16_t>(ribbon.indices.begin(), ribbon.indices.end()), "SCALAR",
                       kU16);
    }
    builder.show({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
    std::vector<std::byte> packed(meshopt_encodeIndexBufferBound(indices, vertices));
    packed.resize(meshopt_encodeIndexBuffer(reinterpret_cast<unsigned char*>(packed.data()), packed.size(),
                                            ribbon.indices.data(), indices));
    compress_view(builder, 0, encode_vertices(bytes_of(ribbon.positions), 12), vertices, 12, "ATTRIBUTES",
                  "");
    compress_view(builder, 1, packed, indices, wide ? 4 : 2, "TRIANGLES", "NONE");
    const Scene scene = load_compressed(builder);
    const Primitive& primitive = only_primitive(scene);  // flat: one vertex per corner
    ASSERT_EQ(primitive.positions.size(), indices);
    // The codec may turn a triangle's corners round, but keeps their order.
    for (std::size_t t = 0; t < indices; t += 3) {
      bool found = false;
      for (std::size_t turn = 0; turn < 3; ++turn) {
        bool same = true;
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t v = ribbon.indices[t + (c + turn) % 3];
          const glm::vec3 expected(ribbon.positions[v * 3], ribbon.positions[v * 3 + 1],
                                   ribbon.positions[v * 3 + 2]);
          same &= primitive.positions[t + c] == expected;
        }
        found |= same;
      }
      EXPECT_TRUE(found) << "triangle " << t / 3;
    }
  }
}

// The extension tells programs that can decompress not to load what others fall back on.
TEST(GltfMeshopt, FallbackBuffersAreNotLookedFor) {
  const TemporaryFolder folder;
  GltfBuilder builder = triangle_builder();
  const std::vector<std::byte> compressed = encode_vertices(builder.binary, 12);
  compress_view(builder, 0, compressed, 3, 12, "ATTRIBUTES", "");
  builder.document["buffers"] =
      json::array({{{"byteLength", builder.binary.size()}},
                   {{"byteLength", 36},
                    {"uri", "nowhere.bin"},
                    {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}});
  EXPECT_EQ(only_primitive(load_or_fail({folder.write("scene.glb", builder.glb())})).positions, kTriangle);
}

TEST(GltfMeshopt, IndexSequences) {
  const std::vector<unsigned> strip = {0, 1, 2, 3};
  GltfBuilder builder;
  builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
  builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  builder.accessor(strip, "SCALAR", kU32);
  builder.show({{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 2}, {"mode", 5}});
  std::vector<std::byte> packed(meshopt_encodeIndexSequenceBound(4, 4));
  packed.resize(meshopt_encodeIndexSequence(reinterpret_cast<unsigned char*>(packed.data()), packed.size(),
                                            strip.data(), 4));
  compress_view(builder, 2, packed, 4, 4, "INDICES", "");
  EXPECT_EQ(only_primitive(load_compressed(builder)).indices, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
}

// Directions all around the sphere.
std::vector<glm::vec4> directions() {
  std::vector<glm::vec4> all;
  for (int i = 0; i < 500; ++i) {
    const double z = 1 - (2 * i + 1) / 500.0, angle = i * 2.399963, r = std::sqrt(1 - z * z);
    all.emplace_back(r * std::cos(angle), r * std::sin(angle), z, 1);
  }
  return all;
}

TEST(GltfMeshopt, OctahedralFilterGivesUnitNormals) {
  for (const std::size_t stride : {4U, 8U}) {
    const std::vector<glm::vec4> normals = directions();
    std::vector<std::byte> filtered(normals.size() * stride);
    meshopt_encodeFilterOct(filtered.data(), normals.size(), stride, stride == 4 ? 8 : 12, &normals[0].x);
    GltfBuilder builder;
    builder.floats(std::vector<float>(normals.size() * 3, 0.0F), "VEC3");
    const int view = builder.view(std::vector<std::byte>(filtered.size()), static_cast<int>(stride));
    builder.add("accessors", {{"bufferView", view},
                              {"componentType", stride == 4 ? kI8 : kI16},
                              {"count", normals.size()},
                              {"type", "VEC3"},
                              {"normalized", true}});
    std::vector<std::uint16_t> indices;
    for (std::uint16_t i = 0; i < 501; ++i) indices.push_back(i % 500);  // all are used, and kept
    builder.accessor(indices, "SCALAR", kU16);
    builder.show({{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 2}});
    compress_view(builder, view, encode_vertices(filtered, stride), normals.size(), stride, "ATTRIBUTES",
                  "OCTAHEDRAL");
    const Scene scene = load_compressed(builder);
    const Primitive& primitive = only_primitive(scene);
    ASSERT_EQ(primitive.normals.size(), normals.size());
    const double least =
        stride == 4 ? 0.9995 : 0.999995;  // 8 and 12 bits: within 1/127 and 1/2047 of the direction
    for (std::size_t i = 0; i < normals.size(); ++i) {
      EXPECT_GT(glm::dot(primitive.normals[i], glm::vec3(normals[i])), least) << i;
    }
  }
}

// Our filters and the library's, on the same bytes: the library's may be off by one through its
// approximations.
template <class T>
void expect_close(std::vector<std::byte> ours, std::vector<std::byte> theirs) {
  for (std::size_t at = 0; at < ours.size(); at += sizeof(T)) {
    T a, b;
    std::memcpy(&a, &ours[at], sizeof(T));
    std::memcpy(&b, &theirs[at], sizeof(T));
    EXPECT_NEAR(a, b, 1) << at;
  }
}

TEST(GltfMeshopt, FiltersAgreeWithTheLibrary) {
  std::vector<glm::vec4> units = directions();
  std::vector<std::byte> oct8(units.size() * 4), oct16(units.size() * 8), quat(units.size() * 8);
  meshopt_encodeFilterOct(oct8.data(), units.size(), 4, 8, &units[0].x);
  meshopt_encodeFilterOct(oct16.data(), units.size(), 8, 16, &units[0].x);
  for (glm::vec4& q : units) q = q / 1.41421356F;  // w = 1/√2 as well: a rotation by 90°
  meshopt_encodeFilterQuat(quat.data(), units.size(), 8, 16, &units[0].x);
  const auto decode = [](const std::vector<std::byte>& filtered, std::size_t stride,
                         gltf::MeshoptFilter filter) {
    return *gltf::decode_meshopt(encode_vertices(filtered, stride),
                                 {gltf::MeshoptMode::attributes, filter, filtered.size() / stride, stride});
  };
  const auto ours8 = decode(oct8, 4, gltf::MeshoptFilter::octahedral);
  const auto ours16 = decode(oct16, 8, gltf::MeshoptFilter::octahedral);
  const auto ours_quat = decode(quat, 8, gltf::MeshoptFilter::quaternion);
  meshopt_decodeFilterOct(oct8.data(), units.size(), 4);
  meshopt_decodeFilterOct(oct16.data(), units.size(), 8);
  meshopt_decodeFilterQuat(quat.data(), units.size(), 8);
  expect_close<std::int8_t>(ours8, oct8);
  expect_close<std::int16_t>(ours16, oct16);
  expect_close<std::int16_t>(ours_quat, quat);
}

TEST(GltfMeshopt, QuaternionFilterGivesRotationsOfInstances) {
  // 90° about each axis and none, as (x, y, z, w).
  const float h = std::sqrt(0.5F);
  const std::vector<float> rotations = {h, 0, 0, h, 0, h, 0, h, 0, 0, h, h, 0, 0, 0, 1};
  std::vector<std::byte> filtered(4 * 8);
  meshopt_encodeFilterQuat(filtered.data(), 4, 8, 16, rotations.data());
  GltfBuilder builder = triangle_builder();
  const int view = builder.view(std::vector<std::byte>(32), 8);
  const int accessor = builder.add(
      "accessors",
      {{"bufferView", view}, {"componentType", kI16}, {"count", 4}, {"type", "VEC4"}, {"normalized", true}});
  builder.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] = accessor;
  compress_view(builder, view, encode_vertices(filtered, 8), 4, 8, "ATTRIBUTES", "QUATERNION");
  const Scene scene = load_compressed(builder);
  ASSERT_EQ(scene.nodes.size(), 1U);
  ASSERT_EQ(scene.nodes[0].node_from_instance.size(), 4U);
  const glm::dvec4 x_axis(1, 0, 0, 0);
  const glm::dvec4 expected[] = {{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}};
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::dvec4 turned = scene.nodes[0].node_from_instance[i] * x_axis;
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(turned[c], expected[i][c], 1e-4) << i;
  }
}

TEST(GltfMeshopt, ExponentialFilterGivesFloats) {
  const std::vector<float> positions = {0, 0, 0, 1024.5F, -0.125F, 3e-3F, 0, 7, 1e5F};
  std::vector<std::byte> filtered(36);
  meshopt_encodeFilterExp(filtered.data(), 3, 12, 15, positions.data());
  GltfBuilder builder;
  builder.floats(positions, "VEC3");
  builder.show({{"attributes", {{"POSITION", 0}}}});
  compress_view(builder, 0, encode_vertices(filtered, 12), 3, 12, "ATTRIBUTES", "EXPONENTIAL");
  const Scene scene = load_compressed(builder);
  const Primitive& primitive = only_primitive(scene);
  meshopt_decodeFilterExp(filtered.data(), 3, 12);
  EXPECT_EQ(bytes_of(primitive.positions), filtered);  // exact in both
}

TEST(GltfMeshopt, RefusesMoreThanItsBytesCanHold) {
  using gltf::find_fault;
  using gltf::MeshoptFilter;
  using gltf::MeshoptMode;
  EXPECT_EQ(find_fault({MeshoptMode::attributes, MeshoptFilter::none, 1000, 16}, 1000), "");
  EXPECT_EQ(find_fault({MeshoptMode::attributes, MeshoptFilter::none, 1U << 30, 256}, 1000),
            "1073741824 elements cannot come out of 1000 compressed bytes");
  EXPECT_EQ(find_fault({MeshoptMode::indices, MeshoptFilter::none, 1001, 4}, 1000),
            "1001 elements cannot come out of 1000 compressed bytes");
  EXPECT_EQ(find_fault({MeshoptMode::triangles, MeshoptFilter::none, 1000, 4}, 1000),
            "count must be a multiple of 3 with mode \"TRIANGLES\", got 1000");
}

}  // namespace
}  // namespace laterna
