// Strips and fans become lists of triangles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace laterna::gltf {

enum class Topology : std::uint8_t {
  points,
  lines,
  line_loop,
  line_strip,
  triangles,
  triangle_strip,
  triangle_fan
};

/// Three indices per triangle, wound as glTF 2.0, 3.7.2.1 says. `indices` empty: vertices 0 … vertex_count −
/// 1 in turn. For Topology::triangles what is left over at the end is dropped.
std::vector<std::uint32_t> triangle_list(std::vector<std::uint32_t> indices, std::size_t vertex_count,
                                         Topology topology);

}  // namespace laterna::gltf
