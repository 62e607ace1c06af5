// Rotations of photographs' cameras.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "base/elementary.h"
#include "scene/photograph_cameras.h"

namespace laterna {
namespace {

// Of dot products of a rotation's rows: files with three digits are still understood.
constexpr double kLooseRotation = 1e-2;

// `rows[i]` is row i.
bool is_rotation(const glm::dmat3& rows) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      // NaN fails.
      if (!(std::abs(glm::dot(rows[i], rows[j]) - (i == j ? 1 : 0)) <= kLooseRotation)) return false;
    }
  }
  return glm::determinant(rows) > 0;
}

}  // namespace

std::optional<Pose> pose_from_camera(const glm::dmat3& camera_from_world, const glm::dvec3& position_ws) {
  const glm::dmat3 rows = glm::transpose(camera_from_world);
  if (!is_rotation(rows)) return std::nullopt;
  // Gram-Schmidt, beginning with the way it looks.
  const glm::dvec3 forward = glm::normalize(rows[2]);
  const glm::dvec3 right = glm::normalize(rows[0] - forward * glm::dot(rows[0], forward));
  Pose pose;
  pose.position_ws = position_ws;
  pose.world_from_view_rotation = glm::dmat3(right, glm::cross(right, forward), -forward);
  return pose;
}

std::optional<Pose> pose_from_translation(const glm::dmat3& camera_from_world,
                                          const glm::dvec3& translation) {
  return pose_from_camera(camera_from_world, -(glm::transpose(camera_from_world) * translation));
}

std::optional<glm::dmat3> rotation_from_quaternion(double w, double x, double y, double z) {
  const double length = std::sqrt(w * w + x * x + y * y + z * z);
  if (!(length > 1e-6) || !std::isfinite(length)) return std::nullopt;
  w /= length, x /= length, y /= length, z /= length;
  const glm::dmat3 rows(glm::dvec3(1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
                        glm::dvec3(2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
                        glm::dvec3(2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)));
  return glm::transpose(rows);
}

glm::dmat3 rotation_from_vector(const glm::dvec3& r) {
  const double angle = std::sqrt(glm::dot(r, r));
  const glm::dvec3 axis = angle > 0 ? r / angle : glm::dvec3(0, 0, 1);
  const double c = cosine(angle), s = sine(angle);
  glm::dmat3 rotation(1.0);
  for (int column = 0; column < 3; ++column) {
    glm::dvec3 unit(0);
    unit[column] = 1;
    rotation[column] = unit * c + glm::cross(axis, unit) * s + axis * (glm::dot(axis, unit) * (1 - c));
  }
  return rotation;
}

}  // namespace laterna
