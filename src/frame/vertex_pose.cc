#include "frame/vertex_pose.h"

#include <algorithm>
#include <glm/matrix.hpp>

namespace laterna::frame {
namespace {

// The inverse transpose but for a positive factor; also there where a matrix flattens space and has no inverse.
glm::dmat3 turned_cofactors(const glm::dmat3& m) {
  const glm::dvec3 x = glm::cross(m[1], m[2]), y = glm::cross(m[2], m[0]), z = glm::cross(m[0], m[1]);
  return glm::dot(m[0], x) < 0 ? glm::dmat3(-x, -y, -z) : glm::dmat3(x, y, z);
}

}  // namespace

std::vector<glm::dmat4> joint_matrices(const Skin& skin, std::span<const glm::dmat4> world_from_node) {
  std::vector<glm::dmat4> matrices(skin.joints.size());
  for (std::size_t i = 0; i < matrices.size(); ++i)
    matrices[i] = world_from_node[static_cast<std::size_t>(skin.joints[i])] * skin.joint_from_bind[i];
  return matrices;
}

VertexPoser::VertexPoser(const Primitive& primitive, const MeshPose& pose)
    : primitive_(primitive),
      pose_(pose),
      has_skin_(!pose.world_from_bind.empty() && primitive.influences > 0),
      linear_(pose.world_from_object),
      offset_(pose.world_from_object[3]),
      normal_matrix_(glm::transpose(glm::inverse(linear_))) {
  const std::size_t count = std::min(pose.weights.size(), primitive.targets.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (pose.weights[i] != 0) targets_.push_back({&primitive.targets[i], pose.weights[i]});
  }
}

void VertexPoser::blend_joints() {
  const auto influences = static_cast<std::size_t>(primitive_.influences);
  const std::uint16_t* joints = primitive_.joints.data() + vertex_ * influences;
  const float* weights = primitive_.joint_weights.data() + vertex_ * influences;
  linear_ = glm::dmat3(0.0);
  offset_ = glm::dvec3(0);
  for (std::size_t k = 0; k < influences; ++k) {
    if (weights[k] == 0) continue;
    const glm::dmat4& matrix = pose_.world_from_bind[joints[k]];
    const double weight = weights[k];
    for (int column = 0; column < 3; ++column) linear_[column] += weight * glm::dvec3(matrix[column]);
    offset_ += weight * glm::dvec3(matrix[3]);
  }
  normal_matrix_ = turned_cofactors(linear_);
}

}  // namespace laterna::frame
