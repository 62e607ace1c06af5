#include "scene/normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <type_traits>
#include <unordered_map>

#include "base/elementary.h"
#include "scene/triangle_geometry.h"
#include "scene/vertex_lists.h"
#include "scene/vertex_welding.h"

namespace laterna {
namespace {

constexpr glm::vec3 kAnyDirection{0, 0, 1};
constexpr std::size_t kMaxFacesAtCrease = 256;  // keeps a fan of n triangles from costing n²
// Single precision moves corners, so that a crease of exactly the limit must not depend on the direction it
// lies in.
constexpr double kCreaseTolerance = 1e-5;

// Normal of a face, its length twice the area; zero for a degenerate one.
glm::dvec3 area_vector(const Primitive& primitive, Corners t) {
  const glm::dvec3 a(primitive.positions[t.a]), b(primitive.positions[t.b]), c(primitive.positions[t.c]);
  return glm::cross(b - a, c - a);
}

// Makes vertex i of the result a copy of vertex from[i].
void gather_vertices(Primitive& primitive, const std::vector<std::uint32_t>& from) {
  for_each_vertex_list(primitive, [&](auto& values, std::size_t entries) {
    if (values.empty()) return;
    std::remove_reference_t<decltype(values)> gathered(from.size() * entries);
    for (std::size_t i = 0; i < from.size(); ++i) {
      for (std::size_t k = 0; k < entries; ++k) gathered[i * entries + k] = values[from[i] * entries + k];
    }
    values = std::move(gathered);
  });
}

// One corner of one face: what it adds to the normal of its position.
struct FaceCorner {
  glm::dvec3 face_normal;  // unit; zero for degenerate faces
  double angle;
};

// Faces sorted by the position they touch: corners of position p are corner_order[start[p] … start[p + 1]).
struct Fans {
  std::vector<std::uint32_t> position_of_vertex;
  std::vector<std::uint32_t> start, corner_order;
};

Fans make_fans(const Primitive& primitive, const std::vector<std::uint32_t>& corner_vertex) {
  Fans fans;
  fans.position_of_vertex = weld_vertices<3>(primitive.positions.size(), [&](std::size_t i) {
    const glm::vec3 p = primitive.positions[i];
    return std::array<float, 3>{p.x, p.y, p.z};
  });
  fans.start.assign(primitive.positions.size() + 1, 0);
  for (const std::uint32_t vertex : corner_vertex) ++fans.start[fans.position_of_vertex[vertex] + 1];
  for (std::size_t i = 1; i < fans.start.size(); ++i) fans.start[i] += fans.start[i - 1];
  std::vector<std::uint32_t> next(fans.start.begin(), fans.start.end() - 1);
  fans.corner_order.resize(corner_vertex.size());
  for (std::size_t corner = 0; corner < corner_vertex.size(); ++corner) {
    fans.corner_order[next[fans.position_of_vertex[corner_vertex[corner]]]++] =
        static_cast<std::uint32_t>(corner);
  }
  return fans;
}

std::vector<FaceCorner> face_corners(const Primitive& primitive) {
  std::vector<FaceCorner> corners;
  corners.reserve(triangle_count(primitive) * 3);
  for (std::size_t t = 0; t < triangle_count(primitive); ++t) {
    const Corners at = corners_of(primitive, t);
    const glm::dvec3 a(primitive.positions[at.a]), b(primitive.positions[at.b]), c(primitive.positions[at.c]);
    const glm::dvec3 normal = unit_or(area_vector(primitive, at), glm::dvec3(0.0));
    corners.push_back({normal, angle_between(b - a, c - a)});
    corners.push_back({normal, angle_between(c - b, a - b)});
    corners.push_back({normal, angle_between(a - c, b - c)});
  }
  return corners;
}

// Normals at corners, position by position.
class CornerNormals {
 public:
  CornerNormals(const Primitive& primitive, const std::vector<std::uint32_t>& corner_vertex, Angle crease)
      : fans_(make_fans(primitive, corner_vertex)),
        corners_(face_corners(primitive)),
        least_cosine_(cosine(crease.in_radians()) - kCreaseTolerance) {}

  [[nodiscard]] glm::vec3 at(std::size_t corner, std::uint32_t vertex) {
    const std::uint32_t position = fans_.position_of_vertex[vertex];
    const std::size_t first = fans_.start[position], last = fans_.start[position + 1];
    const glm::dvec3 own = corners_[corner].face_normal;
    if (last - first > kMaxFacesAtCrease || own == glm::dvec3(0.0)) return uncreased(position, first, last);
    glm::dvec3 sum(0.0);
    for (std::size_t i = first; i < last; ++i) {
      const FaceCorner& other = corners_[fans_.corner_order[i]];
      if (glm::dot(own, other.face_normal) >= least_cosine_) sum += other.face_normal * other.angle;
    }
    return glm::vec3(unit_or(sum, own));
  }

 private:
  // Of all faces around; calculated once for each position.
  glm::vec3 uncreased(std::uint32_t position, std::size_t first, std::size_t last) {
    const auto [known, is_new] = uncreased_.try_emplace(position, kAnyDirection);
    if (!is_new) return known->second;
    glm::dvec3 sum(0.0);
    for (std::size_t i = first; i < last; ++i) {
      const FaceCorner& other = corners_[fans_.corner_order[i]];
      sum += other.face_normal * other.angle;
    }
    return known->second = glm::vec3(unit_or(sum, kAnyDirection));
  }

  Fans fans_;
  std::vector<FaceCorner> corners_;
  double least_cosine_;
  std::unordered_map<std::uint32_t, glm::vec3> uncreased_;
};

}  // namespace

std::size_t triangle_count(const Primitive& primitive) {
  return (primitive.indices.empty() ? primitive.positions.size() : primitive.indices.size()) / 3;
}

Corners corners_of(const Primitive& primitive, std::size_t triangle) {
  const std::size_t first = triangle * 3;
  if (primitive.indices.empty()) return {first, first + 1, first + 2};
  return {primitive.indices[first], primitive.indices[first + 1], primitive.indices[first + 2]};
}

void unshare_vertices(Primitive& primitive) {
  if (primitive.indices.empty()) return;
  const std::vector<std::uint32_t> from = std::move(primitive.indices);
  primitive.indices.clear();
  gather_vertices(primitive, from);
}

void compute_flat_normals(Primitive& primitive) {
  primitive.tangents.clear();
  primitive.normals.clear();
  unshare_vertices(primitive);
  primitive.normals.resize(primitive.positions.size());
  for (std::size_t t = 0; t < triangle_count(primitive); ++t) {
    const Corners at = corners_of(primitive, t);
    const glm::vec3 normal(unit_or(area_vector(primitive, at), kAnyDirection));
    primitive.normals[at.a] = primitive.normals[at.b] = primitive.normals[at.c] = normal;
  }
}

void compute_smooth_normals(Primitive& primitive, Angle crease) {
  primitive.tangents.clear();
  primitive.normals.clear();
  std::vector<std::uint32_t> corner_vertex = primitive.indices;
  if (corner_vertex.empty()) {
    corner_vertex.resize(triangle_count(primitive) * 3);
    for (std::size_t i = 0; i < corner_vertex.size(); ++i) corner_vertex[i] = static_cast<std::uint32_t>(i);
  }
  CornerNormals corner_normals(primitive, corner_vertex, crease);

  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<std::uint32_t> from;     // result vertex → original vertex
  std::vector<glm::vec3> normals;      // of result vertices
  std::vector<std::uint32_t> sibling;  // another result vertex of the same original
  std::vector<std::uint32_t> first_of_vertex(primitive.positions.size(), kNone);
  primitive.indices.resize(corner_vertex.size());
  for (std::size_t corner = 0; corner < corner_vertex.size(); ++corner) {
    const std::uint32_t vertex = corner_vertex[corner];
    const glm::vec3 normal = corner_normals.at(corner, vertex);
    std::uint32_t found = first_of_vertex[vertex];
    while (found != kNone && normals[found] != normal) found = sibling[found];
    if (found == kNone) {
      found = static_cast<std::uint32_t>(from.size());
      from.push_back(vertex);
      normals.push_back(normal);
      sibling.push_back(first_of_vertex[vertex]);
      first_of_vertex[vertex] = found;
    }
    primitive.indices[corner] = found;
  }
  gather_vertices(primitive, from);
  primitive.normals = std::move(normals);
}

std::size_t repair_normals(Primitive& primitive) {
  std::vector<std::size_t> without;
  for (std::size_t i = 0; i < primitive.normals.size(); ++i) {
    const glm::vec3 n = primitive.normals[i];
    const float square = glm::dot(n, n);
    if (std::abs(square - 1) < 4e-6F) continue;  // unit already, to rounding: keep the file's bits
    if (square > 1e-30F && square < 1e30F) {
      primitive.normals[i] = n / std::sqrt(square);
    } else {
      primitive.normals[i] = glm::vec3(unit_or(n, glm::dvec3(0.0)));
      if (primitive.normals[i] == glm::vec3(0)) without.push_back(i);
    }
  }
  if (without.empty()) return 0;
  std::vector<glm::dvec3> sums(primitive.positions.size(), glm::dvec3(0.0));
  std::vector<bool> is_used(primitive.positions.size(), false);
  for (std::size_t t = 0; t < triangle_count(primitive); ++t) {
    const Corners at = corners_of(primitive, t);
    const glm::dvec3 area = area_vector(primitive, at);
    for (const std::size_t corner : {at.a, at.b, at.c}) {
      sums[corner] += area;
      is_used[corner] = true;
    }
  }
  std::size_t repaired = 0;
  for (const std::size_t i : without) {
    primitive.normals[i] = glm::vec3(unit_or(sums[i], kAnyDirection));
    repaired += is_used[i] ? 1 : 0;
  }
  return repaired;
}

}  // namespace laterna
