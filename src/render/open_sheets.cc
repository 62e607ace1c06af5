#include "render/open_sheets.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <tuple>

namespace laterna::render {
namespace {

// Numbers the places of corners. Corners nearer than `tolerance` share one: where a shape meets itself, as along the
// seam of a torus, generators and exporters round differently.
class Places {
 public:
  explicit Places(float tolerance) : tolerance_(tolerance) {}

  std::uint32_t number_of(const glm::vec3& p) {
    const glm::dvec3 cell = glm::floor(glm::dvec3(p) / (2.0 * tolerance_));
    for (int i = 0; i < 27; ++i) {
      const auto found = cells_.find(key(cell + glm::dvec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)));
      if (found == cells_.end()) continue;
      for (const auto& [place, number] : found->second) {
        if (glm::distance(place, p) <= tolerance_) return number;
      }
    }
    cells_[key(cell)].emplace_back(p, count_);
    return count_++;
  }

 private:
  using Key = std::tuple<double, double, double>;
  static Key key(const glm::dvec3& cell) { return {cell.x, cell.y, cell.z}; }

  float tolerance_;
  std::uint32_t count_ = 0;
  std::map<Key, std::vector<std::pair<glm::vec3, std::uint32_t>>> cells_;
};

float extent_of(const Mesh& mesh) {
  glm::vec3 low(std::numeric_limits<float>::max());
  glm::vec3 high(-std::numeric_limits<float>::max());
  for (const Primitive& primitive : mesh.primitives) {
    for (const glm::vec3& p : primitive.positions) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z, std::numeric_limits<float>::min()});
}

}  // namespace

bool is_closed(const Mesh& mesh) {
  Places places(1e-5F * extent_of(mesh));
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;  // of an edge's directions
  for (const Primitive& primitive : mesh.primitives) {
    const bool is_indexed = !primitive.indices.empty();
    const std::size_t corners = is_indexed ? primitive.indices.size() : primitive.positions.size();
    std::vector<std::uint32_t> at(corners);
    for (std::size_t i = 0; i < corners; ++i) {
      at[i] = places.number_of(primitive.positions[is_indexed ? primitive.indices[i] : i]);
    }
    for (std::size_t first = 0; first + 2 < corners; first += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = at[first + k];
        const std::uint32_t to = at[first + (k + 1) % 3];
        if (from != to) balance[std::minmax(from, to)] += from < to ? 1 : -1;
      }
    }
  }
  return std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

void warn_of_open_sheets(Scene& scene) {
  const auto light = std::find_if(scene.lights.begin(), scene.lights.end(), [](const Light& l) {
    return l.enabled && l.shadow.caster_faces == CasterFaces::back_only;
  });
  if (light == scene.lights.end()) return;
  std::vector<bool> casts(scene.meshes.size());
  for (const Node& node : scene.nodes) {
    if (node.mesh >= 0 && node.casts_shadow) casts[static_cast<std::size_t>(node.mesh)] = true;
  }
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    if (!casts[i] || is_closed(scene.meshes[i])) continue;
    scene.warnings.push_back(
        {{},
         {},
         "mesh \"" + scene.meshes[i].name + "\" is not closed: light \"" + light->name +
             "\" draws only back faces into its shadow map, and where it falls on the mesh's "
             "front there is no shadow"});
  }
}

}  // namespace laterna::render
