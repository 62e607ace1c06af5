// Primitives become triangles with everything that their material needs.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "scene/triangle_lists.h"
#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;
using Indices = std::vector<std::uint32_t>;

TEST(GltfPrimitives, StripsAndFansKeepTheirWinding) {
  using gltf::Topology;
  using gltf::triangle_list;
  EXPECT_EQ(triangle_list({}, 5, Topology::triangle_strip), (Indices{0, 1, 2, 1, 3, 2, 2, 3, 4}));
  EXPECT_EQ(triangle_list({}, 5, Topology::triangle_fan), (Indices{1, 2, 0, 2, 3, 0, 3, 4, 0}));
  EXPECT_EQ(triangle_list({4, 3, 2, 1}, 5, Topology::triangle_strip), (Indices{4, 3, 2, 3, 1, 2}));
  EXPECT_EQ(triangle_list({4, 3, 2, 1}, 5, Topology::triangle_fan), (Indices{3, 2, 4, 2, 1, 4}));
  EXPECT_EQ(triangle_list({}, 7, Topology::triangles), (Indices{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(triangle_list({}, 2, Topology::triangle_strip), Indices{});
}

GltfBuilder square_builder(int mode) {
  GltfBuilder builder;
  builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
  builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  builder.show({{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"mode", mode}});
  return builder;
}

TEST(GltfPrimitives, StripsAndFansLoad) {
  const TemporaryFolder folder;
  EXPECT_EQ(only_primitive(square_builder(5).load(folder)).indices, (Indices{0, 1, 2, 1, 3, 2}));
  EXPECT_EQ(only_primitive(square_builder(6).load(folder)).indices, (Indices{1, 2, 0, 2, 3, 0}));
}

TEST(GltfPrimitives, PointsAndLinesAreLeftOutWithAWarning) {
  const TemporaryFolder folder;
  for (const int mode : {0, 1, 2, 3}) {
    const Scene scene = square_builder(mode).load(folder);
    EXPECT_TRUE(scene.meshes[0].primitives.empty());
    EXPECT_EQ(warnings_of(scene), mode == 0 ? "meshes[0].primitives[0]: points are not drawn: left out\n"
                                            : "meshes[0].primitives[0]: lines are not drawn: left out\n");
  }
}

TEST(GltfPrimitives, LeftOverCornersAreDroppedWithAWarning) {
  const TemporaryFolder folder;
  const Scene scene = square_builder(4).load(folder);
  EXPECT_EQ(only_primitive(scene).positions.size(), 3U);
  EXPECT_TRUE(only_primitive(scene).indices.empty());
  EXPECT_EQ(warnings_of(scene),
            "meshes[0].primitives[0]: 4 corners make no whole number of triangles: the rest is left out\n");
}

TEST(GltfPrimitives, WithoutNormalsTheMeshIsFlatAndUnshared) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  // Two triangles of a tent, joined at an edge along y.
  builder.floats({0, 0, 0, 0, 1, 0, -1, 0, -1, 1, 0, -1}, "VEC3");
  builder.accessor<std::uint8_t>({0, 1, 2, 0, 3, 1}, "SCALAR", kU8);
  builder.show({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
  const Scene scene = builder.load(folder);
  const Primitive& primitive = only_primitive(scene);
  EXPECT_TRUE(primitive.indices.empty());
  ASSERT_EQ(primitive.positions.size(), 6U);
  const float h = std::sqrt(0.5F);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT(glm::distance(primitive.normals[i], glm::vec3(-h, 0, h)), 1e-6F);
    EXPECT_LT(glm::distance(primitive.normals[i + 3], glm::vec3(h, 0, h)), 1e-6F);
  }
}

TEST(GltfPrimitives, DegenerateTrianglesGetSomeUnitNormal) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  builder.floats({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0}, "VEC3");
  builder.show({{"attributes", {{"POSITION", 0}}}});
  const Scene scene = builder.load(folder);
  for (const glm::vec3& normal : only_primitive(scene).normals) EXPECT_EQ(glm::length(normal), 1);
}

TEST(GltfPrimitives, NormalsWithoutLengthComeFromTheFaces) {
  const TemporaryFolder folder;
  GltfBuilder builder = triangle_builder();
  builder.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
      builder.floats({0, 0, 1, 0, 0, 0, 0, 3, 4}, "VEC3");
  const Scene scene = builder.load(folder);
  const std::vector<glm::vec3>& normals = only_primitive(scene).normals;
  EXPECT_EQ(normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(normals[1], glm::vec3(0, 0, 1));
  EXPECT_LT(glm::distance(normals[2], glm::vec3(0, 0.6F, 0.8F)), 1e-6F);
  EXPECT_EQ(warnings_of(scene),
            "meshes[0].primitives[0]: 1 normals have no length: taken from the faces around\n");
}

TEST(GltfPrimitives, TwoSetsOfTextureCoordinates) {
  const TemporaryFolder folder;
  GltfBuilder builder = triangle_builder();
  json& attributes = builder.document["meshes"][0]["primitives"][0]["attributes"];
  attributes["TEXCOORD_0"] = builder.floats({0, 0, 1, 0, 0, 1}, "VEC2");
  attributes["TEXCOORD_1"] = builder.accessor<std::uint16_t>({0, 65535, 65535, 0, 0, 0}, "VEC2", kU16, true);
  const Scene scene = builder.load(folder);
  EXPECT_EQ(only_primitive(scene).uv[0], (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_EQ(only_primitive(scene).uv[1], (std::vector<glm::vec2>{{0, 1}, {1, 0}, {0, 0}}));
}

TEST(GltfPrimitives, TangentsOfTheFileAreKeptAndWIsASign) {
  const TemporaryFolder folder;
  GltfBuilder builder = triangle_builder();
  json& attributes = builder.document["meshes"][0]["primitives"][0]["attributes"];
  attributes["NORMAL"] = builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  attributes["TANGENT"] = builder.floats({1, 0, 0, 1, 0, 2, 0, -1, 0, 0, 0, 0}, "VEC4");
  const Scene scene = builder.load(folder);
  const std::vector<glm::vec4>& tangents = only_primitive(scene).tangents;
  EXPECT_EQ(tangents[0], glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(tangents[1], glm::vec4(0, 1, 0, -1));
  EXPECT_EQ(glm::length(glm::vec3(tangents[2])), 1);  // had no length
  EXPECT_EQ(tangents[2].z, 0);
}

// -------------------------------------------------------------------------------------------------- morph
// targets

GltfBuilder morphing_builder() {
  GltfBuilder builder = triangle_builder();
  const int first = builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  const int second = builder.floats({2, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3");
  builder.document["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", first}}, {{"POSITION", second}}};
  return builder;
}

TEST(GltfPrimitives, DefaultWeightsPoseTheMesh) {
  const TemporaryFolder folder;
  GltfBuilder builder = morphing_builder();
  EXPECT_EQ(only_primitive(builder.load(folder)).positions,
            (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  builder.document["meshes"][0]["weights"] = {0.5, -0.25};
  EXPECT_EQ(only_primitive(builder.load(folder)).positions,
            (std::vector<glm::vec3>{{-0.5F, 0, 0.5F}, {1, 0, 0.5F}, {0, 1, 0.5F}}));
}

TEST(GltfPrimitives, ANodesWeightsComeBeforeItsMeshs) {
  const TemporaryFolder folder;
  GltfBuilder builder = morphing_builder();
  builder.document["meshes"][0]["weights"] = {0, 0};
  builder.add("nodes", {{"mesh", 0}, {"weights", {1, 0}}});
  builder.add("nodes", {{"mesh", 0}, {"weights", {0, 0}}});
  const Scene scene = builder.load(folder);
  ASSERT_EQ(scene.meshes.size(), 2U);  // the pose that two nodes share is there once
  EXPECT_EQ(scene.meshes[static_cast<std::size_t>(scene.nodes[1].mesh)].primitives[0].positions[0].z, 1);
  EXPECT_EQ(scene.nodes[0].mesh, scene.nodes[2].mesh);
}

// Exporters let many primitives share one list of vertices: each keeps only its own.
TEST(GltfPrimitives, VerticesThatNoTriangleUsesAreDropped) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  std::vector<float> positions, normals, coordinates;
  for (int i = 0; i < 10; ++i) {
    positions.insert(positions.end(), {static_cast<float>(i), static_cast<float>(i * i), 0});
    normals.insert(normals.end(), {0, 0, 1});
    coordinates.insert(coordinates.end(), {static_cast<float>(i), 7});
  }
  builder.floats(positions, "VEC3");
  builder.floats(normals, "VEC3");
  builder.floats(coordinates, "VEC2");
  builder.accessor<std::uint8_t>({9, 3, 5, 5, 3, 9}, "SCALAR", kU8);
  builder.show({{"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TEXCOORD_1", 2}}}, {"indices", 3}});
  const Scene scene = builder.load(folder);
  const Primitive& primitive = only_primitive(scene);
  EXPECT_EQ(primitive.positions, (std::vector<glm::vec3>{{3, 9, 0}, {5, 25, 0}, {9, 81, 0}}));
  EXPECT_EQ(primitive.normals.size(), 3U);
  EXPECT_EQ(primitive.uv[1], (std::vector<glm::vec2>{{3, 7}, {5, 7}, {9, 7}}));
  EXPECT_EQ(primitive.indices, (std::vector<std::uint32_t>{2, 0, 1, 1, 0, 2}));
}

// -------------------------------------------------------------------------------------
// KHR_draco_mesh_compression

struct DracoFile {
  std::vector<std::byte> bytes;
  std::uint32_t position_id = 0, color_id = 0;
};

DracoFile encode_square() {
  const float p[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const std::uint8_t c[4][3] = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 255, 255}};
  const int faces[2][3] = {{0, 1, 2}, {1, 3, 2}};
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2);
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int color = builder.AddAttribute(draco::GeometryAttribute::COLOR, 3, draco::DT_UINT8);
  for (std::uint32_t f = 0; f < 2; ++f) {
    const int* corner = faces[f];
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(f), p[corner[0]], p[corner[1]],
                                      p[corner[2]]);
    builder.SetAttributeValuesForFace(color, draco::FaceIndex(f), c[corner[0]], c[corner[1]], c[corner[2]]);
  }
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::Encoder encoder;
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  DracoFile file;
  file.position_id = mesh->GetNamedAttribute(draco::GeometryAttribute::POSITION)->unique_id();
  file.color_id = mesh->GetNamedAttribute(draco::GeometryAttribute::COLOR)->unique_id();
  file.bytes.resize(buffer.size());
  std::memcpy(file.bytes.data(), buffer.data(), buffer.size());
  return file;
}

TEST(GltfPrimitives, DracoMeshes) {
  const TemporaryFolder folder;
  const DracoFile draco = encode_square();
  GltfBuilder builder;
  const int view = builder.view(draco.bytes);
  builder.add("accessors", {{"componentType", kF32}, {"count", 4}, {"type", "VEC3"}});
  builder.add("accessors", {{"componentType", kU8}, {"normalized", true}, {"count", 4}, {"type", "VEC3"}});
  builder.add("accessors", {{"componentType", kU16}, {"count", 6}, {"type", "SCALAR"}});
  builder.show({{"attributes", {{"POSITION", 0}, {"COLOR_0", 1}}},
                {"indices", 2},
                {"extensions",
                 {{"KHR_draco_mesh_compression",
                   {{"bufferView", view},
                    {"attributes", {{"POSITION", draco.position_id}, {"COLOR_0", draco.color_id}}}}}}}});
  builder.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  const Scene scene = builder.load(folder);
  const Primitive& primitive = only_primitive(scene);
  ASSERT_EQ(primitive.positions.size(), 6U);
  double area = 0;
  for (std::size_t t = 0; t < 6; t += 3) {
    const glm::vec3 cross = glm::cross(primitive.positions[t + 1] - primitive.positions[t],
                                       primitive.positions[t + 2] - primitive.positions[t]);
    area += cross.z / 2;  // counter-clockwise seen from +z
  }
  EXPECT_NEAR(area, 1, 1e-6);
  for (std::size_t i = 0; i < 6; ++i) {
    const glm::vec3 p = primitive.positions[i];
    const glm::vec4 expected = p.x < 0.5F ? (p.y < 0.5F ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 0, 1, 1))
                                          : (p.y < 0.5F ? glm::vec4(0, 1, 0, 1) : glm::vec4(1, 1, 1, 1));
    EXPECT_EQ(primitive.colors[i], expected);
  }
}

TEST(GltfPrimitives, SkinsAndAnimationsLoadInTheirStaticPose) {
  const TemporaryFolder folder;
  GltfBuilder builder = triangle_builder();
  const int joints = builder.accessor<std::uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC4", kU8);
  const int weights = builder.floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4");
  const int inverse = builder.floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "MAT4");
  json& attributes = builder.document["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = joints;
  attributes["WEIGHTS_0"] = weights;
  builder.document["nodes"][0]["skin"] = 0;
  builder.add("nodes", {{"name", "bone"}});
  builder.add("skins", {{"joints", {1}}, {"inverseBindMatrices", inverse}});
  const int times = builder.floats({0, 1}, "SCALAR"), values = builder.floats({0, 0, 0, 1, 2, 3}, "VEC3");
  builder.add("animations",
              {{"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}},
               {"samplers", {{{"input", times}, {"output", values}}}}});
  const Scene scene = builder.load(folder);
  EXPECT_EQ(only_primitive(scene).positions.size(), 3U);
  EXPECT_EQ(scene.nodes[1].parent_from_node, glm::dmat4(1.0));
  EXPECT_EQ(warnings_of(scene), "");
}

}  // namespace
}  // namespace laterna
