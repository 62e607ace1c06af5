// A glTF file in the making: lists of JSON objects, and the bytes that they refer to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "laterna/result.h"

namespace laterna::gltf {

/// Members in the order in which they are set.
using Json = nlohmann::ordered_json;

/// The number that reads back as `value` in single precision, in as few digits as that takes.
double shortest(float value);
/// An array of a vector's components, each as shortest() has it.
template <int N, class T, glm::qualifier Q>
Json components(const glm::vec<N, T, Q>& vector) {
  Json array = Json::array();
  for (int i = 0; i < N; ++i) {
    if constexpr (std::is_same_v<T, float>) {
      array.push_back(shortest(vector[i]));
    } else {
      array.push_back(vector[i]);
    }
  }
  return array;
}

/// Sets a member unless it would be the default.
template <class T>
void set_unless(Json& object, std::string_view name, const T& value, const T& usual) {
  if (value != usual) object[std::string(name)] = value;
}

class Document {
 public:
  /// What a buffer view holds.
  enum class Target : std::uint16_t { none = 0, attributes = 34962, indices = 34963 };

  /// Appends to one of the file's lists ("meshes", "nodes", …) and gives the index there.
  int add(std::string_view list, Json value);
  [[nodiscard]] std::size_t count(std::string_view list) const;
  Json& at(std::string_view list, int index);
  /// The file's own extensions, such as the list of lights.
  Json& extension(std::string_view name);

  /// To "extensionsUsed".
  void use(std::string_view extension) { used_.emplace(extension); }
  /// `object.extensions[name] = value`, and use().
  void extend(Json& object, std::string_view name, Json value);

  /// Bytes at a multiple of four; gives the view's index.
  int add_view(std::span<const std::byte> bytes, Target target = Target::none);
  /// The same with an accessor. Views and accessors hold these elements alone.
  int add_accessor(std::span<const std::byte> bytes, Target target, int component_type, std::string_view type,
                   std::size_t count);
  int add_floats(std::span<const float> values, std::string_view type, std::size_t count);

  void warn(std::string place, std::string message) {
    warnings_.push_back({{}, std::move(place), std::move(message)});
  }
  [[nodiscard]] std::vector<Diagnostic>& warnings() { return warnings_; }

  [[nodiscard]] const std::vector<std::byte>& binary() const { return binary_; }
  /// The file's JSON, with one buffer where there are bytes: at `buffer_uri`, or a .glb's own where that is empty.
  [[nodiscard]] std::string text(const std::string& buffer_uri) const;

 private:
  std::map<std::string, Json, std::less<>> lists_;
  Json extensions_ = Json::object();
  std::set<std::string, std::less<>> used_;
  std::vector<std::byte> binary_;
  std::vector<Diagnostic> warnings_;
};

}  // namespace laterna::gltf
