#include "scene/tangents.h"

#include <array>
#include <cstddef>
#include <glm/geometric.hpp>

#include "scene/normals.h"
#include "scene/triangle_geometry.h"
#include "scene/vertex_lists.h"
#include "scene/vertex_welding.h"

namespace laterna {
namespace {

// Which way (u, v) turns on a face. glTF's v points down, so a picture that is not mirrored turns clockwise.
enum class Hand : std::uint8_t { upright = 0, mirrored = 1, unknown = 2 };

float sign_of(Hand hand) { return hand == Hand::mirrored ? -1.0F : 1.0F; }

struct FaceTangent {
  glm::dvec3 along_u{0.0};
  Hand hand = Hand::unknown;
};

FaceTangent face_tangent(const Primitive& primitive, const std::vector<glm::vec2>& uv, Corners t) {
  const glm::dvec3 p(primitive.positions[t.a]);
  const glm::dvec3 edge1 = glm::dvec3(primitive.positions[t.b]) - p,
                   edge2 = glm::dvec3(primitive.positions[t.c]) - p;
  const glm::dvec2 uv1 = glm::dvec2(uv[t.b]) - glm::dvec2(uv[t.a]),
                   uv2 = glm::dvec2(uv[t.c]) - glm::dvec2(uv[t.a]);
  const double turn = uv1.x * uv2.y - uv1.y * uv2.x;
  if (turn == 0) return {};
  const glm::dvec3 direction = (edge1 * uv2.y - edge2 * uv1.y) * (turn > 0 ? 1.0 : -1.0);
  return {unit_or(direction, glm::dvec3(0.0)), turn > 0 ? Hand::mirrored : Hand::upright};
}

// Sums of both hands for each distinct (position, normal, uv).
struct TangentSums {
  std::vector<std::uint32_t> group_of_vertex;
  std::array<std::vector<glm::dvec3>, 2> sum;
  std::array<std::vector<bool>, 2> is_used;
  std::vector<Hand> hand_of_face;
};

void add_corner(TangentSums& sums, const Primitive& primitive, const FaceTangent& face, std::size_t at,
                std::size_t next, std::size_t previous) {
  const glm::dvec3 normal(primitive.normals[at]), p(primitive.positions[at]);
  const glm::dvec3 in_plane = face.along_u - normal * glm::dot(normal, face.along_u);
  const double angle =
      angle_between(glm::dvec3(primitive.positions[next]) - p, glm::dvec3(primitive.positions[previous]) - p);
  const std::size_t group = sums.group_of_vertex[at];
  const auto hand = static_cast<std::size_t>(face.hand);
  sums.sum[hand][group] += unit_or(in_plane, glm::dvec3(0.0)) * angle;
  sums.is_used[hand][group] = true;
}

TangentSums sum_tangents(const Primitive& primitive, const std::vector<glm::vec2>& uv) {
  TangentSums sums;
  const std::size_t count = primitive.positions.size();
  sums.group_of_vertex = weld_vertices<8>(count, [&](std::size_t i) {
    const glm::vec3 p = primitive.positions[i], n = primitive.normals[i];
    return std::array<float, 8>{p.x, p.y, p.z, n.x, n.y, n.z, uv[i].x, uv[i].y};
  });
  for (auto& sum : sums.sum) sum.assign(count, glm::dvec3(0.0));
  for (auto& is_used : sums.is_used) is_used.assign(count, false);
  for (std::size_t t = 0; t < triangle_count(primitive); ++t) {
    const Corners at = corners_of(primitive, t);
    const FaceTangent face = face_tangent(primitive, uv, at);
    sums.hand_of_face.push_back(face.hand);
    if (face.hand == Hand::unknown) continue;
    add_corner(sums, primitive, face, at.a, at.b, at.c);
    add_corner(sums, primitive, face, at.b, at.c, at.a);
    add_corner(sums, primitive, face, at.c, at.a, at.b);
  }
  return sums;
}

void append_copy(Primitive& primitive, std::size_t vertex) {
  for_each_vertex_list(primitive, [&](auto& values, std::size_t entries) {
    if (values.empty()) return;
    for (std::size_t k = 0; k < entries; ++k) {
      const auto value = values[vertex * entries + k];
      values.push_back(value);
    }
  });
}

// Gives each vertex one hand: the first that asks keeps it, corners of the other hand get a copy. Returns the
// hand of every vertex.
std::vector<Hand> split_by_hand(Primitive& primitive, TangentSums& sums) {
  constexpr std::uint32_t kNoCopy = 0xFFFFFFFF;
  std::vector<Hand> hands(primitive.positions.size(), Hand::unknown);
  std::vector<std::uint32_t> copy_of(primitive.positions.size(), kNoCopy);
  for (std::size_t corner = 0; corner < primitive.indices.size(); ++corner) {
    const Hand wanted = sums.hand_of_face[corner / 3];
    const std::uint32_t vertex = primitive.indices[corner];
    if (wanted == Hand::unknown || hands[vertex] == wanted) continue;
    if (hands[vertex] == Hand::unknown) {
      hands[vertex] = wanted;
      continue;
    }
    if (copy_of[vertex] == kNoCopy) {
      copy_of[vertex] = static_cast<std::uint32_t>(primitive.positions.size());
      append_copy(primitive, vertex);
      hands.push_back(wanted);
      copy_of.push_back(kNoCopy);
      sums.group_of_vertex.push_back(sums.group_of_vertex[vertex]);
    }
    primitive.indices[corner] = copy_of[vertex];
  }
  return hands;
}

std::vector<Hand> hands_of_corners(const TangentSums& sums) {
  std::vector<Hand> hands(sums.group_of_vertex.size(), Hand::unknown);
  for (std::size_t corner = 0; corner < sums.hand_of_face.size() * 3; ++corner) {
    hands[corner] = sums.hand_of_face[corner / 3];
  }
  return hands;
}

}  // namespace

void compute_tangents(Primitive& primitive, int uv_set) {
  TangentSums sums = sum_tangents(primitive, primitive.uv[static_cast<std::size_t>(uv_set)]);
  const std::vector<Hand> hands =
      primitive.indices.empty() ? hands_of_corners(sums) : split_by_hand(primitive, sums);
  primitive.tangents.resize(primitive.positions.size());
  for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
    const std::size_t group = sums.group_of_vertex[i];
    Hand hand = hands[i];
    // A vertex that only faces without area in uv touch goes with its neighbours.
    if (hand == Hand::unknown)
      hand = sums.is_used[1][group] && !sums.is_used[0][group] ? Hand::mirrored : Hand::upright;
    const glm::dvec3 normal(primitive.normals[i]);
    const glm::dvec3 tangent =
        unit_or(sums.sum[static_cast<std::size_t>(hand)][group], any_perpendicular(normal));
    primitive.tangents[i] = glm::vec4(glm::vec3(tangent), sign_of(hand));
  }
}

}  // namespace laterna
