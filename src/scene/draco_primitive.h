// KHR_draco_mesh_compression: the triangles of one primitive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "laterna/result.h"

namespace draco {
class Mesh;
}

namespace laterna::gltf {

class DracoMesh {
 public:
  /// Error: the reason, without a place.
  static tl::expected<DracoMesh, std::string> decode(std::span<const std::byte> compressed);

  [[nodiscard]] std::size_t vertex_count() const;
  /// Three per triangle, all below vertex_count().
  [[nodiscard]] std::vector<std::uint32_t> indices() const;

  /// The attribute of that id as vertex_count() · components finite floats; integers as fractions where
  /// `normalized`.
  tl::expected<std::vector<float>, std::string> attribute(std::uint64_t unique_id, std::size_t components,
                                                          bool normalized) const;

 private:
  explicit DracoMesh(std::shared_ptr<const draco::Mesh> mesh) : mesh_(std::move(mesh)) {}
  std::shared_ptr<const draco::Mesh> mesh_;
};

}  // namespace laterna::gltf
