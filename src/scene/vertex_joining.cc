#include "scene/vertex_joining.h"

#include <array>
#include <cstdint>

#include "scene/vertex_lists.h"
#include "scene/vertex_welding.h"

namespace laterna {
namespace {

void keep_vertices(Primitive& primitive, const std::vector<std::uint32_t>& kept) {
  for_each_vertex_list(primitive, [&](auto& values, std::size_t entries) {
    if (values.empty()) return;
    for (std::size_t i = 0; i < kept.size(); ++i) {  // kept[i] ≥ i
      for (std::size_t k = 0; k < entries; ++k) values[i * entries + k] = values[kept[i] * entries + k];
    }
    values.resize(kept.size() * entries);
    values.shrink_to_fit();
  });
}

template <class T>
T value_or_zero(const std::vector<T>& values, std::size_t i) {
  return values.empty() ? T(0) : values[i];
}

}  // namespace

void join_identical_vertices(Primitive& primitive) {
  const std::size_t count = primitive.positions.size();
  const std::vector<std::uint32_t> first = weld_vertices<14>(count, [&](std::size_t i) {
    const glm::vec3 p = primitive.positions[i], n = value_or_zero(primitive.normals, i);
    const glm::vec2 s = value_or_zero(primitive.uv[0], i), t = value_or_zero(primitive.uv[1], i);
    const glm::vec4 c = value_or_zero(primitive.colors, i);
    return std::array<float, 14>{p.x, p.y, p.z, n.x, n.y, n.z, s.x, s.y, t.x, t.y, c.x, c.y, c.z, c.w};
  });
  std::vector<std::uint32_t> kept, new_index(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (first[i] == i) {
      new_index[i] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(static_cast<std::uint32_t>(i));
    } else {
      new_index[i] = new_index[first[i]];
    }
  }
  if (primitive.indices.empty()) {
    primitive.indices = new_index;
  } else {
    for (std::uint32_t& index : primitive.indices) index = new_index[index];
  }
  keep_vertices(primitive, kept);
}

void drop_unused_vertices(Primitive& primitive) {
  // With as many corners as vertices it is not worth a look.
  if (primitive.indices.empty() || primitive.indices.size() >= primitive.positions.size()) return;
  constexpr std::uint32_t kUnused = 0xFFFFFFFF;
  std::vector<std::uint32_t> new_index(primitive.positions.size(), kUnused), kept;
  for (const std::uint32_t index : primitive.indices) new_index[index] = index;
  for (std::uint32_t& index : new_index) {
    if (index == kUnused) continue;
    kept.push_back(index);
    index = static_cast<std::uint32_t>(kept.size() - 1);
  }
  for (std::uint32_t& index : primitive.indices) index = new_index[index];
  keep_vertices(primitive, kept);
}

}  // namespace laterna
