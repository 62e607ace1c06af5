// Builds small glTF files for tests, number by number.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "unit/scene_test_files.h"

namespace laterna::testing_scenes {

using nlohmann::json;

inline constexpr int kI8 = 5120, kU8 = 5121, kI16 = 5122, kU16 = 5123, kU32 = 5125, kF32 = 5126;

template <class T>
std::vector<std::byte> bytes_of(const std::vector<T>& values) {
  std::vector<std::byte> bytes(values.size() * sizeof(T));
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

inline std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63U];
    }
  }
  return text;
}

class GltfBuilder {
 public:
  json document = {{"asset", {{"version", "2.0"}}}};
  std::vector<std::byte> binary;

  /// Appends bytes at a multiple of four; returns the view's index.
  int view(const std::vector<std::byte>& bytes, int stride = 0) {
    binary.resize((binary.size() + 3) / 4 * 4);
    json value = {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
    if (stride > 0) value["byteStride"] = stride;
    binary.insert(binary.end(), bytes.begin(), bytes.end());
    return add("bufferViews", std::move(value));
  }

  /// An accessor of its own view.
  template <class T>
  int accessor(const std::vector<T>& values, const std::string& type, int component_type,
               bool normalized = false) {
    const int width = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : type.back() - '0';
    json value = {{"bufferView", view(bytes_of(values))},
                  {"componentType", component_type},
                  {"count", values.size() / static_cast<std::size_t>(width)},
                  {"type", type}};
    if (normalized) value["normalized"] = true;
    return add("accessors", std::move(value));
  }

  int floats(const std::vector<float>& values, const std::string& type) {
    return accessor(values, type, kF32);
  }

  int add(const std::string& list, json value) {
    json& all = document[list];
    all.push_back(std::move(value));
    return static_cast<int>(all.size()) - 1;
  }

  /// A node that shows a mesh of one primitive.
  GltfBuilder& show(json primitive) {
    add("meshes", {{"primitives", json::array({std::move(primitive)})}});
    add("nodes", {{"mesh", document["meshes"].size() - 1}});
    return *this;
  }

  /// The document with its bytes in a base64 data URI, unless it names its own buffers.
  [[nodiscard]] json embedded() const {
    json result = document;
    if (!result.contains("buffers") && !binary.empty()) {
      result["buffers"] = json::array({{{"byteLength", binary.size()},
                                        {"uri", "data:application/octet-stream;base64," + base64(binary)}}});
    }
    return result;
  }

  [[nodiscard]] std::string text() const { return embedded().dump(); }

  /// The same as a GLB.
  [[nodiscard]] std::vector<std::byte> glb() const {
    json result = document;
    if (!result.contains("buffers") && !binary.empty())
      result["buffers"] = json::array({{{"byteLength", binary.size()}}});
    return make_glb(result.dump(), binary);
  }

  static std::vector<std::byte> make_glb(std::string text, const std::vector<std::byte>& chunk) {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t padded = (chunk.size() + 3) / 4 * 4;
    std::vector<std::byte> file;
    const auto put = [&file](std::size_t value) {
      for (int i = 0; i < 4; ++i) file.push_back(static_cast<std::byte>(value >> (8 * i) & 0xFF));
    };
    put(0x46546C67);
    put(2);
    put(12 + 8 + text.size() + (chunk.empty() ? 0 : 8 + padded));
    put(text.size());
    put(0x4E4F534A);
    for (const char c : text) file.push_back(static_cast<std::byte>(c));
    if (chunk.empty()) return file;
    put(padded);
    put(0x004E4942);
    file.insert(file.end(), chunk.begin(), chunk.end());
    file.resize(file.size() + padded - chunk.size());
    return file;
  }

  /// Writes scene.gltf into the folder and loads it.
  [[nodiscard]] Scene load(const TemporaryFolder& folder) const {
    return load_or_fail({folder.write("scene.gltf", text())});
  }
};

/// The triangle (0,0,0) (1,0,0) (0,1,0), its accessor 0.
inline GltfBuilder triangle_builder() {
  GltfBuilder builder;
  builder.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  builder.show({{"attributes", {{"POSITION", 0}}}});
  return builder;
}

inline const Primitive& only_primitive(const Scene& scene) {
  static const Primitive none;
  const bool has_one = scene.meshes.size() == 1 && scene.meshes[0].primitives.size() == 1;
  EXPECT_TRUE(has_one);
  return has_one ? scene.meshes[0].primitives[0] : none;
}

}  // namespace laterna::testing_scenes
