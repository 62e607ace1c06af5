// The directions in which an eye sees points, as whole numbers: on which side of an edge a line of sight passes is then
// decided without rounding, also where points lie behind the eye or infinitely far away. No clipping is needed: Olano
// and Greer, Triangle scan conversion using 2D homogeneous coordinates, 1997.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "frame/frame.h"
#include "raster/raster_view.h"

namespace laterna::shadow {

/// A direction from the eye; its length says nothing. Components are at most kDirectionScale, which the largest one is:
/// in a picture as wide as it is far away, 4096 pixels, whole numbers are then 1/250,000 pixel apart.
struct EyeDirection {
  std::int32_t x = 0, y = 0, w = 0;
};
inline constexpr std::int32_t kDirectionScale = std::int32_t{1} << 30U;

/// Across the plane of the eye and two directions a, b: a × b. Two products below 2⁶⁰ fit 64 bits with sign.
struct EdgeNormal {
  std::int64_t x, y, w;
};
EdgeNormal edge_between(const EyeDirection& a, const EyeDirection& b);

/// 1 where the direction is on the normal's side, −1 on the other: exact. A direction in the plane counts as if it lay
/// an infinitely small step to the right of that, a still smaller one below, and a smaller one yet farther on (Edelsbrunner
/// and Mücke, Simulation of simplicity, 1990), so that a line of sight through the common edge of two triangles meets
/// one of them. 0 only where the edge has no length.
int side_of(const EdgeNormal& edge, const EyeDirection& direction);

/// The sign of the determinant of three directions, exact: 0 where the eye lies in the triangle's plane.
int turn_of(const EyeDirection& a, const EyeDirection& b, const EyeDirection& c);

/// What sees: a perspective camera's eye. Lines of sight of an orthographic camera would all meet at infinity, where
/// shadow volumes end; in its place there is an eye far behind the scene. It need not see what the camera sees: any
/// lines through the samples may count what they cross.
class Eye {
 public:
  Eye(const raster::RasterView& camera, const frame::Bounds& bounds);

  /// Of a point and of a point infinitely far away in a direction.
  [[nodiscard]] EyeDirection to_point(const glm::dvec3& position_ws) const;
  [[nodiscard]] EyeDirection to_infinity(const glm::dvec3& direction_ws) const;

  /// Pixels from the middle of the picture = unit() · x / w.
  [[nodiscard]] double unit() const { return unit_; }
  /// Of the determinant of three directions and of right, down and forward: −1 where the axes are mirrored.
  [[nodiscard]] int handedness() const { return handedness_; }

 private:
  glm::dvec3 position_ws_;
  glm::dvec3 x_row_, y_row_, w_row_;  // of differences of positions; x and y in units of unit_ pixels
  double unit_ = 1;
  int handedness_ = 1;
};

}  // namespace laterna::shadow
