#include "scene/triangle_lists.h"

#include <numeric>

namespace laterna::gltf {

std::vector<std::uint32_t> triangle_list(std::vector<std::uint32_t> indices, std::size_t vertex_count,
                                         Topology topology) {
  if (indices.empty()) {
    indices.resize(vertex_count);
    std::iota(indices.begin(), indices.end(), 0U);
  }
  if (topology == Topology::triangles) {
    indices.resize(indices.size() / 3 * 3);
    return indices;
  }
  std::vector<std::uint32_t> list;
  if (indices.size() < 3) return list;
  list.reserve((indices.size() - 2) * 3);
  for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
    if (topology == Topology::triangle_fan) {
      list.insert(list.end(), {indices[i + 1], indices[i + 2], indices[0]});
    } else {  // every second triangle of a strip swaps its last two corners
      list.insert(list.end(), {indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]});
    }
  }
  return list;
}

}  // namespace laterna::gltf
