// Elements of every kind of accessor arrive as the numbers that were stored.
#include <gtest/gtest.h>

#include "unit/gltf_builder.h"

namespace laterna {
namespace {

using namespace testing_scenes;

// Loads three vertices whose texture coordinates are read from `accessor`.
std::vector<glm::vec2> read_uv(GltfBuilder builder, int accessor) {
  const TemporaryFolder folder;
  const int position = builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  builder.show({{"attributes", {{"POSITION", position}, {"TEXCOORD_0", accessor}}}});
  return only_primitive(builder.load(folder)).uv[0];
}

template <class T>
std::vector<glm::vec2> read_uv_of(const std::vector<T>& values, int component_type, bool normalized) {
  GltfBuilder builder;
  const std::vector<std::byte> raw = bytes_of(values);
  const int stride = (static_cast<int>(sizeof(T)) * 2 + 3) / 4 * 4;
  std::vector<std::byte> padded(static_cast<std::size_t>(stride) * 3);
  for (std::size_t i = 0; i < 3; ++i) {
    std::copy_n(raw.begin() + static_cast<std::ptrdiff_t>(i * 2 * sizeof(T)), 2 * sizeof(T),
                padded.begin() + static_cast<std::ptrdiff_t>(i) * stride);
  }
  const int view = builder.view(padded, stride);
  const int accessor = builder.add("accessors", {{"bufferView", view},
                                                 {"componentType", component_type},
                                                 {"count", 3},
                                                 {"type", "VEC2"},
                                                 {"normalized", normalized}});
  return read_uv(builder, accessor);
}

using Uvs = std::vector<glm::vec2>;

TEST(GltfAccessors, PlainIntegersAreNumbers) {
  EXPECT_EQ(read_uv_of<std::int8_t>({-128, 127, 0, 1, -1, 5}, kI8, false),
            (Uvs{{-128, 127}, {0, 1}, {-1, 5}}));
  EXPECT_EQ(read_uv_of<std::uint8_t>({0, 255, 1, 2, 3, 4}, kU8, false), (Uvs{{0, 255}, {1, 2}, {3, 4}}));
  EXPECT_EQ(read_uv_of<std::int16_t>({-32768, 32767, 0, 1, -1, 5}, kI16, false),
            (Uvs{{-32768, 32767}, {0, 1}, {-1, 5}}));
  EXPECT_EQ(read_uv_of<std::uint16_t>({0, 65535, 1, 2, 3, 4}, kU16, false),
            (Uvs{{0, 65535}, {1, 2}, {3, 4}}));
  EXPECT_EQ(read_uv_of<float>({0, -0.25F, 1e-20F, 2, 3e20F, 4}, kF32, false),
            (Uvs{{0, -0.25F}, {1e-20F, 2}, {3e20F, 4}}));
}

TEST(GltfAccessors, NormalisedIntegersAreFractions) {
  // Both −128 and −127 are −1, as the standard's max(c / 127, −1) says.
  EXPECT_EQ(read_uv_of<std::int8_t>({-128, 127, 0, -127, 64, -64}, kI8, true),
            (Uvs{{-1, 1}, {0, -1}, {64 / 127.0F, -64 / 127.0F}}));
  EXPECT_EQ(read_uv_of<std::uint8_t>({0, 255, 51, 102, 1, 254}, kU8, true),
            (Uvs{{0, 1}, {51 / 255.0F, 102 / 255.0F}, {1 / 255.0F, 254 / 255.0F}}));
  EXPECT_EQ(read_uv_of<std::int16_t>({-32768, 32767, 0, -32767, 1, -1}, kI16, true),
            (Uvs{{-1, 1}, {0, -1}, {1 / 32767.0F, -1 / 32767.0F}}));
  EXPECT_EQ(read_uv_of<std::uint16_t>({0, 65535, 32768, 1, 2, 3}, kU16, true),
            (Uvs{{0, 1}, {32768 / 65535.0F, 1 / 65535.0F}, {2 / 65535.0F, 3 / 65535.0F}}));
}

TEST(GltfAccessors, InterleavedAttributesShareOneView) {
  GltfBuilder builder;
  //                             x  y  z  u     v
  const std::vector<float> all = {0, 0, 0, 0.1F, 0.2F,  //
                                  1, 0, 0, 0.3F, 0.4F,  //
                                  0, 1, 0, 0.5F, 0.6F};
  const int view = builder.view(bytes_of(all), 20);
  builder.add("accessors", {{"bufferView", view}, {"componentType", kF32}, {"count", 3}, {"type", "VEC3"}});
  builder.add(
      "accessors",
      {{"bufferView", view}, {"byteOffset", 12}, {"componentType", kF32}, {"count", 3}, {"type", "VEC2"}});
  builder.show({{"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}}}});
  const TemporaryFolder folder;
  const Scene scene = builder.load(folder);
  const Primitive& primitive = only_primitive(scene);
  EXPECT_EQ(primitive.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(primitive.uv[0], (Uvs{{0.1F, 0.2F}, {0.3F, 0.4F}, {0.5F, 0.6F}}));
}

TEST(GltfAccessors, OneViewHoldsSeveralAccessorsAfterEachOther) {
  GltfBuilder builder;
  const int view = builder.view(bytes_of<float>({9, 9, 1, 2, 3, 4, 5, 6}));
  const int accessor = builder.add(
      "accessors",
      {{"bufferView", view}, {"byteOffset", 8}, {"componentType", kF32}, {"count", 3}, {"type", "VEC2"}});
  EXPECT_EQ(read_uv(builder, accessor), (Uvs{{1, 2}, {3, 4}, {5, 6}}));
}

json sparse_values(GltfBuilder& builder, const std::vector<std::byte>& indices, int index_type) {
  const int index_view = builder.view(indices);
  const int value_view = builder.view(bytes_of<float>({7, 8, 5, 6}));
  return {{"count", 2},
          {"indices", {{"bufferView", index_view}, {"componentType", index_type}}},
          {"values", {{"bufferView", value_view}}}};
}

TEST(GltfAccessors, SparseValuesReplaceStoredOnes) {
  for (const int type : {kU8, kU16, kU32}) {
    GltfBuilder builder;
    const int accessor = builder.floats({1, 1, 2, 2, 3, 3}, "VEC2");
    const std::vector<std::byte> indices = type == kU8    ? bytes_of<std::uint8_t>({0, 2})
                                           : type == kU16 ? bytes_of<std::uint16_t>({0, 2})
                                                          : bytes_of<std::uint32_t>({0, 2});
    builder.document["accessors"][0]["sparse"] = sparse_values(builder, indices, type);
    EXPECT_EQ(read_uv(builder, accessor), (Uvs{{7, 8}, {2, 2}, {5, 6}})) << type;
  }
}

TEST(GltfAccessors, SparseValuesReplaceZerosWhereNothingIsStored) {
  GltfBuilder builder;
  const json sparse = sparse_values(builder, bytes_of<std::uint8_t>({1, 2}), kU8);
  const int accessor =
      builder.add("accessors", {{"componentType", kF32}, {"count", 3}, {"type", "VEC2"}, {"sparse", sparse}});
  EXPECT_EQ(read_uv(builder, accessor), (Uvs{{0, 0}, {7, 8}, {5, 6}}));
}

TEST(GltfAccessors, WithoutDataAllIsZero) {
  GltfBuilder builder;
  const int accessor = builder.add("accessors", {{"componentType", kF32}, {"count", 3}, {"type", "VEC2"}});
  EXPECT_EQ(read_uv(builder, accessor), (Uvs{{0, 0}, {0, 0}, {0, 0}}));
}

std::vector<std::uint32_t> read_indices(const std::vector<std::byte>& bytes, int component_type) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
  builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  const int view = builder.view(bytes);
  builder.add("accessors",
              {{"bufferView", view}, {"componentType", component_type}, {"count", 6}, {"type", "SCALAR"}});
  builder.show({{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 2}});
  return only_primitive(builder.load(folder)).indices;
}

TEST(GltfAccessors, IndicesOfEveryType) {
  const std::vector<std::uint32_t> expected = {0, 1, 2, 2, 1, 3};
  EXPECT_EQ(read_indices(bytes_of<std::uint8_t>({0, 1, 2, 2, 1, 3}), kU8), expected);
  EXPECT_EQ(read_indices(bytes_of<std::uint16_t>({0, 1, 2, 2, 1, 3}), kU16), expected);
  EXPECT_EQ(read_indices(bytes_of<std::uint32_t>({0, 1, 2, 2, 1, 3}), kU32), expected);
}

TEST(GltfAccessors, SparseIndices) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
  builder.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3");
  builder.accessor<std::uint16_t>({0, 1, 2, 2, 1, 0}, "SCALAR", kU16);
  const int index_view = builder.view(bytes_of<std::uint8_t>({5}));
  const int value_view = builder.view(bytes_of<std::uint16_t>({3}));
  builder.document["accessors"][2]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", index_view}, {"componentType", kU8}}},
      {"values", {{"bufferView", value_view}}}};
  builder.show({{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}, {"indices", 2}});
  EXPECT_EQ(only_primitive(builder.load(folder)).indices, (std::vector<std::uint32_t>{0, 1, 2, 2, 1, 3}));
}

TEST(GltfAccessors, ColoursOfEveryTypeAndWidth) {
  const auto read = [](auto values, const std::string& type, int component_type, bool normalized) {
    const TemporaryFolder folder;
    GltfBuilder builder = triangle_builder();
    using Value = typename decltype(values)::value_type;
    const auto width = static_cast<std::size_t>(type.back() - '0');
    const std::size_t stride = (width * sizeof(Value) + 3) / 4 * 4;
    std::vector<std::byte> bytes(stride * 3);
    for (std::size_t i = 0; i < 3; ++i)
      std::memcpy(&bytes[i * stride], &values[i * width], width * sizeof(Value));
    const int view = builder.view(bytes, static_cast<int>(stride));
    const int accessor = builder.add("accessors", {{"bufferView", view},
                                                   {"componentType", component_type},
                                                   {"count", 3},
                                                   {"type", type},
                                                   {"normalized", normalized}});
    builder.document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = accessor;
    return only_primitive(builder.load(folder)).colors;
  };
  using Colors = std::vector<glm::vec4>;
  const Colors expected = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}};
  EXPECT_EQ(read(std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 255}, "VEC3", kU8, true), expected);
  EXPECT_EQ(read(std::vector<std::uint16_t>{65535, 0, 0, 0, 65535, 0, 0, 0, 65535}, "VEC3", kU16, true),
            expected);
  EXPECT_EQ(read(std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3", kF32, false), expected);
  // Integers are fractions even where the file forgets to say so.
  EXPECT_EQ(read(std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 255}, "VEC3", kU8, false), expected);
  EXPECT_EQ(read(std::vector<std::uint8_t>{255, 0, 0, 51, 0, 255, 0, 0, 0, 0, 255, 255}, "VEC4", kU8, true),
            (Colors{{1, 0, 0, 0.2F}, {0, 1, 0, 0}, {0, 0, 1, 1}}));
  EXPECT_EQ(read(std::vector<float>{1, 2, 3, 0.5F, 0, 0, 0, 0, 0, 0, 0, 1}, "VEC4", kF32, false),
            (Colors{{1, 2, 3, 0.5F}, {0, 0, 0, 0}, {0, 0, 0, 1}}));
}

TEST(GltfAccessors, QuantisedPositionsAreNumbersAndNormalsFractions) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  const int positions = builder.view(bytes_of<std::int16_t>({0, 0, 0, 0, 100, 0, 0, 0, 0, -100, 0, 0}), 8);
  builder.add("accessors",
              {{"bufferView", positions}, {"componentType", kI16}, {"count", 3}, {"type", "VEC3"}});
  const int normals = builder.view(bytes_of<std::int8_t>({0, 0, 127, 0, 0, 127, 0, 0, 90, 90, 0, 0}), 4);
  builder.add("accessors", {{"bufferView", normals},
                            {"componentType", kI8},
                            {"count", 3},
                            {"type", "VEC3"},
                            {"normalized", true}});
  builder.show({{"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}});
  builder.document["extensionsRequired"] = {"KHR_mesh_quantization"};
  const Scene scene = builder.load(folder);
  const Primitive& primitive = only_primitive(scene);
  EXPECT_EQ(primitive.positions, (std::vector<glm::vec3>{{0, 0, 0}, {100, 0, 0}, {0, -100, 0}}));
  EXPECT_EQ(primitive.normals[0], glm::vec3(0, 0, 1));
  EXPECT_EQ(primitive.normals[1], glm::vec3(0, 1, 0));
  EXPECT_NEAR(primitive.normals[2].x, std::sqrt(0.5F), 1e-7F);  // brought to unit length
}

}  // namespace
}  // namespace laterna
