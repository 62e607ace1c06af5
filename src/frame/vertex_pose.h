// Vertices of a primitive in the world, at an instant: carried there by its node, or drawn toward morph targets and pulled by
// the joints of a skin.
#pragma once

#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "laterna/scene.h"

namespace laterna::frame {

/// What an instance of a mesh looks like at an instant, and all that its vertices depend on.
struct MeshPose {
  glm::dmat4 world_from_object{1.0};        ///< without a skin
  std::vector<glm::dmat4> world_from_bind;  ///< of each joint of its skin; empty: none
  std::vector<float> weights;               ///< of morph targets; empty: not drawn toward any
  bool operator==(const MeshPose&) const = default;
};

/// world_from_joint · joint_from_bind of each joint (glTF 2.0, 3.7.3.3).
std::vector<glm::dmat4> joint_matrices(const Skin& skin, std::span<const glm::dmat4> world_from_node);

/// Vertices of one primitive in one pose. Both must outlive it. Everything is calculated in double precision.
class VertexPoser {
 public:
  VertexPoser(const Primitive& primitive, const MeshPose& pose);

  /// Makes `vertex` the one that the following are about.
  void select(std::size_t vertex) {
    vertex_ = vertex;
    if (has_skin_) blend_joints();
  }
  [[nodiscard]] glm::dvec3 position_ws() const {
    return linear_ * morphed(primitive_.positions[vertex_], &MorphTarget::positions) + offset_;
  }
  /// Unit; zero where what is left of the surface has none.
  [[nodiscard]] glm::dvec3 normal_ws() const {
    return unit(normal_matrix_ * morphed(primitive_.normals[vertex_], &MorphTarget::normals));
  }
  [[nodiscard]] glm::dvec3 tangent_ws() const {
    return unit(linear_ * morphed(glm::vec3(primitive_.tangents[vertex_]), &MorphTarget::tangents));
  }

 private:
  struct ActiveTarget {
    const MorphTarget* target;
    double weight;
  };
  [[nodiscard]] glm::dvec3 morphed(const glm::vec3& base, std::vector<glm::vec3> MorphTarget::*list) const {
    glm::dvec3 sum(base);
    for (const ActiveTarget& active : targets_) {
      const std::vector<glm::vec3>& displacements = active.target->*list;
      if (!displacements.empty()) sum += active.weight * glm::dvec3(displacements[vertex_]);
    }
    return sum;
  }
  static glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0, 0, 0);
  }
  void blend_joints();

  const Primitive& primitive_;
  const MeshPose& pose_;
  std::vector<ActiveTarget> targets_;
  bool has_skin_;
  std::size_t vertex_ = 0;
  glm::dmat3 linear_;  // world from what the morph targets give, at the vertex
  glm::dvec3 offset_;
  glm::dmat3 normal_matrix_;
};

}  // namespace laterna::frame
