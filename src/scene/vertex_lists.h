// All that a primitive says of its vertices, for whoever reorders or copies them.
#pragma once

#include <cstddef>

#include "laterna/scene.h"

namespace laterna {

/// Calls visit(list, entries) for each list that has `entries` entries for each vertex, empty ones among them.
template <class Visit>
void for_each_vertex_list(Primitive& primitive, const Visit& visit) {
  visit(primitive.positions, std::size_t{1});
  visit(primitive.normals, std::size_t{1});
  visit(primitive.tangents, std::size_t{1});
  visit(primitive.colors, std::size_t{1});
  for (auto& uv : primitive.uv) visit(uv, std::size_t{1});
  for (MorphTarget& target : primitive.targets) {
    visit(target.positions, std::size_t{1});
    visit(target.normals, std::size_t{1});
    visit(target.tangents, std::size_t{1});
  }
  const auto influences = static_cast<std::size_t>(primitive.influences);
  visit(primitive.joints, influences);
  visit(primitive.joint_weights, influences);
}

}  // namespace laterna
