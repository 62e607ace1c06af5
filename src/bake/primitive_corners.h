// The corners of a primitive's triangles: three in a row are a triangle, with an index list or without.
#pragma once

#include <cstddef>
#include <cstdint>

#include "laterna/scene.h"

namespace laterna::bake {

inline std::size_t corner_count(const Primitive& primitive) {
  return primitive.indices.empty() ? primitive.positions.size() : primitive.indices.size();
}

/// The vertex at a corner below `corner_count`.
inline std::uint32_t vertex_of(const Primitive& primitive, std::size_t corner) {
  return primitive.indices.empty() ? static_cast<std::uint32_t>(corner) : primitive.indices[corner];
}

}  // namespace laterna::bake
