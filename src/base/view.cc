#include "laterna/view.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>

#include "base/elementary.h"

namespace laterna {
namespace {

bool is_finite(glm::dvec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

tl::unexpected<Error> fault(std::string message) {
  return tl::unexpected(Error(Failure::bad_input, Diagnostic{{}, {}, std::move(message)}));
}

}  // namespace

Result<Pose> Pose::look_at(glm::dvec3 position_ws, glm::dvec3 target_ws, glm::dvec3 up_ws) {
  if (!is_finite(position_ws) || !is_finite(target_ws) || !is_finite(up_ws)) {
    return fault("position, target and up must be finite numbers");
  }
  const glm::dvec3 gaze = target_ws - position_ws;
  if (glm::length(gaze) == 0)
    return fault("position and target are the same point: there is no direction to look in");
  if (glm::length(up_ws) == 0) return fault("up is the zero vector");
  const glm::dvec3 forward = gaze / glm::length(gaze);
  const glm::dvec3 side = glm::cross(forward, up_ws / glm::length(up_ws));
  // Below this the cross product's own rounding decides the roll.
  if (glm::length(side) < 1e-9) return fault("up points along the direction of view: give another up");
  const glm::dvec3 right = side / glm::length(side);
  Pose pose;
  pose.position_ws = position_ws;
  pose.world_from_view_rotation = glm::dmat3(right, glm::cross(right, forward), -forward);
  return pose;
}

Result<Pose> Pose::from_matrix(const glm::dmat4& world_from_node) {
  glm::dvec3 axes[3];
  for (int i = 0; i < 3; ++i) {
    axes[i] = glm::dvec3(world_from_node[i]);
    if (!is_finite(axes[i])) return fault("the matrix holds a value that is not finite");
  }
  if (!is_finite(glm::dvec3(world_from_node[3]))) return fault("the matrix holds a value that is not finite");
  // −Z is what a camera or light looks along, so it keeps its direction; the others are made perpendicular to it.
  if (glm::length(axes[2]) == 0)
    return fault("the matrix has no direction along Z: its third column is zero");
  const glm::dvec3 backward = axes[2] / glm::length(axes[2]);
  const glm::dvec3 side = glm::cross(axes[1], backward);
  if (glm::length(side) <= 1e-12 * glm::length(axes[1]) || glm::length(axes[1]) == 0) {
    return fault("the matrix has no up direction: its second column is zero or along the third");
  }
  const glm::dvec3 right = side / glm::length(side);
  Pose pose;
  pose.position_ws = glm::dvec3(world_from_node[3]);
  pose.world_from_view_rotation = glm::dmat3(right, glm::cross(backward, right), backward);
  return pose;
}

glm::dmat4 Pose::world_from_view() const {
  glm::dmat4 matrix(world_from_view_rotation);
  matrix[3] = glm::dvec4(position_ws, 1);
  return matrix;
}

glm::dmat4 Pose::view_from_world() const {
  const glm::dmat3 rotation = glm::transpose(world_from_view_rotation);
  glm::dmat4 matrix(rotation);
  matrix[3] = glm::dvec4(-(rotation * position_ws), 1);
  return matrix;
}

Projection Projection::perspective(Angle yfov, double aspect, double near, double far) {
  const double half_height = tangent(yfov.in_radians() / 2);
  return {false, -half_height * aspect, half_height * aspect, -half_height, half_height, near, far};
}

Projection Projection::orthographic(double half_width, double half_height, double near, double far) {
  return {true, -half_width, half_width, -half_height, half_height, near, far};
}

Projection Projection::from_intrinsics(double fx, double fy, double cx, double cy, double width,
                                       double height, double near, double far) {
  // OpenCV counts pixel centres from 0; the picture's left side is at −0.5, its right side at width − 0.5.
  return {false, (-0.5 - cx) / fx, (width - 0.5 - cx) / fx, -(height - 0.5 - cy) / fy, (0.5 + cy) / fy, near,
          far};
}

Projection Projection::from_focal_length(double focal_length, double width, double height, double near,
                                         double far) {
  const double x = width / (2 * focal_length), y = height / (2 * focal_length);
  return {false, -x, x, -y, y, near, far};
}

Projection Projection::from_throw_ratio(double throw_ratio, double aspect, double near, double far) {
  return from_focal_length(throw_ratio, 1, 1 / aspect, near, far);
}

Projection Projection::shifted(double widths, double heights) const {
  Projection moved = *this;
  const double x = widths * (right - left), y = heights * (top - bottom);
  moved.left += x;
  moved.right += x;
  moved.bottom += y;
  moved.top += y;
  return moved;
}

Angle Projection::yfov() const { return Angle::radians(arctangent(top) - arctangent(bottom)); }

std::string find_fault(const Projection& p) {
  for (const double side : {p.left, p.right, p.bottom, p.top}) {
    if (!std::isfinite(side))
      return "the frustum's sides must be finite (is the field of view 180° or more?)";
  }
  if (p.left >= p.right || p.bottom >= p.top) return "the frustum has no width or no height";
  if (!std::isfinite(p.near) || std::isnan(p.far)) return "near and far must be numbers, near finite";
  if (p.near >= p.far) return "near must be less than far";
  if (!p.is_orthographic && p.near <= 0) return "near must be greater than zero";
  if (p.is_orthographic && !std::isfinite(p.far)) return "an orthographic view needs a finite far distance";
  return {};
}

glm::dmat4 View::clip_from_view() const {
  const Projection& p = projection;
  const double width = p.right - p.left;
  const double height = p.top - p.bottom;
  glm::dmat4 m(0.0);
  if (p.is_orthographic) {
    m[0][0] = 2 / width;
    m[1][1] = 2 / height;
    m[2][2] = -2 / (p.far - p.near);
    m[3] = glm::dvec4(-(p.right + p.left) / width, -(p.top + p.bottom) / height,
                      -(p.far + p.near) / (p.far - p.near), 1);
    return m;
  }
  m[0][0] = 2 / width;
  m[1][1] = 2 / height;
  m[2][0] = (p.right + p.left) / width;
  m[2][1] = (p.top + p.bottom) / height;
  m[2][3] = -1;
  if (std::isinf(p.far)) {
    m[2][2] = -1;
    m[3][2] = -2 * p.near;
  } else {
    m[2][2] = -(p.far + p.near) / (p.far - p.near);
    m[3][2] = -2 * p.far * p.near / (p.far - p.near);
  }
  return m;
}

glm::dmat4 View::clip_from_world() const { return clip_from_view() * view_from_world(); }

glm::dmat4 View::image_from_world() const { return image_from_clip() * clip_from_world(); }

glm::dmat4 image_from_clip() {
  glm::dmat4 m(1.0);
  m[0][0] = 0.5;
  m[1][1] = -0.5;  // row 0 is the top
  m[2][2] = 0.5;
  m[3] = glm::dvec4(0.5, 0.5, 0.5, 1);
  return m;
}

}  // namespace laterna
