#include "scene/mesh_check.h"

#include <fmt/format.h>

#include <cmath>

#include "scene/normals.h"
#include "scene/number_scans.h"
#include "scene/scene_check.h"
#include "scene/surface_attributes.h"

namespace laterna {
namespace {

class MeshCheck : SceneCheck {
 public:
  MeshCheck(const Scene& scene, FaultList& faults) : SceneCheck(scene, faults) {}

  void run() { check_meshes(); }

 private:
  void check_meshes();
  template <class Vector>
  void check_attribute(const std::vector<Vector>& values, const Primitive& primitive,
                       const std::string& place);
  void check_directions(const Primitive& primitive, const std::string& place);
  void check_triangles(const Primitive& primitive, const std::string& place);
  void check_primitive(const Primitive& primitive, const std::string& place);
};

void MeshCheck::check_meshes() {
  std::uint64_t vertices = 0, triangles = 0;
  for (std::size_t m = 0; m < scene_.meshes.size(); ++m) {
    const std::vector<Primitive>& primitives = scene_.meshes[m].primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      check_primitive(primitives[p], item(item("meshes", m) + ".primitives", p));
      vertices += primitives[p].positions.size();
      triangles += triangle_count(primitives[p]);
    }
  }
  if (vertices > kMaxVertices)
    fault("meshes", fmt::format("{} vertices are more than {}", vertices, kMaxVertices));
  if (triangles > kMaxTriangles)
    fault("meshes", fmt::format("{} triangles are more than {}", triangles, kMaxTriangles));
}

template <class Vector>
void MeshCheck::check_attribute(const std::vector<Vector>& values, const Primitive& primitive,
                                const std::string& place) {
  if (!values.empty() && values.size() != primitive.positions.size()) {
    fault(place, fmt::format("has {} elements, but there are {} positions", values.size(),
                             primitive.positions.size()));
  }
  const std::span<const float> components = components_of(values);
  const std::size_t bad = first_not_finite(components);
  if (bad == components.size()) return;
  fault(item(place, bad / static_cast<std::size_t>(Vector::length())), "expected finite numbers");
}

void MeshCheck::check_directions(const Primitive& primitive, const std::string& place) {
  const auto flat = std::find(primitive.normals.begin(), primitive.normals.end(), glm::vec3(0));
  if (flat != primitive.normals.end()) {
    fault(item(place + ".normals", static_cast<std::size_t>(flat - primitive.normals.begin())),
          "a normal has no length");
  }
  for (std::size_t i = 0; i < primitive.tangents.size(); ++i) {
    const glm::vec4 tangent = primitive.tangents[i];
    if (glm::vec3(tangent) != glm::vec3(0) && std::abs(tangent.w) == 1) continue;
    fault(item(place + ".tangents", i), "expected a direction, and w = 1 or -1");
    break;
  }
  if (!primitive.tangents.empty() && primitive.normals.empty()) {
    fault(place + ".tangents", "tangents mean nothing without normals");
  }
}

void MeshCheck::check_triangles(const Primitive& primitive, const std::string& place) {
  if (primitive.indices.empty()) {
    if (primitive.positions.size() % 3 == 0) return;
    fault(place + ".positions",
          fmt::format("without indices, expected a multiple of 3, got {}", primitive.positions.size()));
    return;
  }
  if (primitive.indices.size() % 3 != 0) {
    fault(place + ".indices", fmt::format("expected a multiple of 3, got {}", primitive.indices.size()));
  }
  const std::size_t beyond = first_beyond(primitive.indices, primitive.positions.size());
  if (beyond == primitive.indices.size()) return;
  fault(item(place + ".indices", beyond),
        fmt::format("{} is beyond the {} positions", primitive.indices[beyond], primitive.positions.size()));
}

void MeshCheck::check_primitive(const Primitive& primitive, const std::string& place) {
  check_attribute(primitive.positions, primitive, place + ".positions");
  check_attribute(primitive.normals, primitive, place + ".normals");
  check_attribute(primitive.tangents, primitive, place + ".tangents");
  check_attribute(primitive.uv[0], primitive, place + ".uv[0]");
  check_attribute(primitive.uv[1], primitive, place + ".uv[1]");
  check_attribute(primitive.colors, primitive, place + ".colors");
  check_directions(primitive, place);
  check_triangles(primitive, place);
  check_reference(place + ".material", primitive.material, scene_.materials.size(), "materials");
  if (primitive.material < 0 || static_cast<std::size_t>(primitive.material) >= scene_.materials.size())
    return;
  for (const Texture* texture : textures_of(scene_.materials[static_cast<std::size_t>(primitive.material)])) {
    const auto set = static_cast<std::size_t>(texture->uv_set);
    if (!texture->is_set() || set > 1 || primitive.positions.empty() || !primitive.uv[set].empty()) continue;
    fault(fmt::format("{}.uv[{}]", place, set),
          fmt::format("is empty, but materials[{}] has a texture that uses it", primitive.material));
    return;
  }
}

}  // namespace

void check_meshes(const Scene& scene, FaultList& faults) { MeshCheck(scene, faults).run(); }

}  // namespace laterna
