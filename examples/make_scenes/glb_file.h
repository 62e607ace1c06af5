// A binary glTF 2.0 file in the making.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "laterna/scene.h"

namespace laterna::examples {

class GlbFile {
 public:
  GlbFile();

  /// A material; `picture` is its base colour texture, or empty.
  struct Surface {
    std::string name;
    glm::vec3 color{1};
    float roughness = 0.8F;
    bool is_cut_by_alpha = false;  ///< MASK, seen from both sides
  };
  int add_material(const Surface& surface, const Image& picture = {});
  /// One node with one mesh.
  void add_object(const std::string& name, const Primitive& primitive, int material);

  Result<void> write(const std::filesystem::path& file) const;

 private:
  int add_view(std::span<const std::byte> bytes);
  int add_picture(const std::string& name, const Image& picture);
  template <class Element>
  int add_accessor(const std::vector<Element>& elements, int component_type, const char* type);

  nlohmann::ordered_json json_;
  std::vector<std::byte> buffer_;
};

}  // namespace laterna::examples
