// A View is a pose and a projection. Camera, slide projector, spotlight, sun, shadow map, photograph: each is a
// View with an image. Conventions: docs/conventions.md.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "laterna/result.h"

namespace laterna {

/// An angle that cannot be given in the wrong unit.
class Angle {
 public:
  constexpr Angle() = default;
  static constexpr Angle radians(double value) { return Angle(value); }
  static constexpr Angle degrees(double value) { return Angle(value * (kPi / 180.0)); }
  [[nodiscard]] constexpr double in_radians() const { return radians_; }
  [[nodiscard]] constexpr double in_degrees() const { return radians_ * (180.0 / kPi); }
  constexpr auto operator<=>(const Angle&) const = default;

 private:
  static constexpr double kPi = 3.14159265358979323846;
  constexpr explicit Angle(double radians) : radians_(radians) {}
  double radians_ = 0;
};

/// Where a camera or light stands. It looks down its own −Z; +X is its right, +Y its up.
struct Pose {
  glm::dvec3 position_ws{0};                 ///< metres
  glm::dmat3 world_from_view_rotation{1.0};  ///< columns: right, up, backward; orthonormal, right-handed

  /// Pose at `position_ws` looking at `target_ws`. `up_ws` need not be perpendicular to the gaze.
  /// Error: the two points coincide, a component is not finite, or up is zero or along the gaze.
  static Result<Pose> look_at(glm::dvec3 position_ws, glm::dvec3 target_ws, glm::dvec3 up_ws);

  /// The pose of a glTF node: its scale and shear are dropped (node scale never changes brightness or cone).
  /// Error: an axis of the matrix has no length, or an entry is not finite.
  static Result<Pose> from_matrix(const glm::dmat4& world_from_node);

  [[nodiscard]] glm::dvec3 right_ws() const { return world_from_view_rotation[0]; }
  [[nodiscard]] glm::dvec3 up_ws() const { return world_from_view_rotation[1]; }
  [[nodiscard]] glm::dvec3 forward_ws() const { return -world_from_view_rotation[2]; }
  [[nodiscard]] glm::dmat4 world_from_view() const;
  [[nodiscard]] glm::dmat4 view_from_world() const;
};

/// A perspective or orthographic frustum, possibly off centre.
struct Projection {
  bool is_orthographic = false;
  /// The four sides, x to the right and y up: tangents at unit distance (perspective) or metres (orthographic).
  double left = -1, right = 1, bottom = -1, top = 1;
  /// Distances along the axis in metres. Perspective: near > 0; far may be infinite. Orthographic: both finite.
  double near = 0.1, far = std::numeric_limits<double>::infinity();

  /// `aspect` is width / height. yfov in (0°, 180°).
  static Projection perspective(Angle yfov, double aspect, double near, double far);
  static Projection orthographic(double half_width, double half_height, double near, double far);
  /// OpenCV's pinhole: pixels, centre of the top-left pixel at (0, 0), y down.
  static Projection from_intrinsics(double fx, double fy, double cx, double cy, double width, double height,
                                    double near, double far);
  /// A lens of `focal_length` before a sensor or panel of that width and height, all three in the same unit.
  static Projection from_focal_length(double focal_length, double width, double height, double near,
                                      double far);
  /// A projector's throw ratio: distance / width of the picture.
  static Projection from_throw_ratio(double throw_ratio, double aspect, double near, double far);

  /// Lens shift: the frustum moved sideways by fractions of its own width (to the right) and height (up), as data sheets
  /// of projectors give it. At (0, 0.5) the lower side is on the axis.
  [[nodiscard]] Projection shifted(double widths, double heights) const;

  [[nodiscard]] double aspect() const { return (right - left) / (top - bottom); }
  [[nodiscard]] Angle yfov() const;  ///< perspective only
};

/// Finds what is wrong with a projection: sides that cross, near and far out of order, values not finite.
/// Returns the message, or an empty string.
std::string find_fault(const Projection& projection);

/// A pose with a projection, and every matrix that follows. All matrices are column-vector matrices named
/// destination_from_source.
struct View {
  Pose pose;
  Projection projection;

  [[nodiscard]] glm::dmat4 view_from_world() const { return pose.view_from_world(); }
  /// OpenGL clip space: x, y, z in [−w, w], w the distance along the axis (perspective) or 1 (orthographic).
  [[nodiscard]] glm::dmat4 clip_from_view() const;
  [[nodiscard]] glm::dmat4 clip_from_world() const;
  /// Image coordinates s, t in [0, 1], (0, 0) the top-left corner, and depth in [0, 1], after the divide by w:
  /// the scale-and-bias matrix folded into clip_from_world (document 003; rows 82, 83 of the papers' list).
  [[nodiscard]] glm::dmat4 image_from_world() const;
};

/// image_from_clip: scale-and-bias from [−1, 1]³ to image coordinates, with t counted from the top row.
glm::dmat4 image_from_clip();

}  // namespace laterna
