// How a real lens bends a projector's picture: OpenCV's distortion, in both directions.
#pragma once

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "laterna/view.h"

namespace laterna {

/// OpenCV's five coefficients, in its order (k1, k2, p1, p2, k3): radial k, tangential p. They belong to the lens axis and
/// to tangents at unit distance, x to the right and y DOWNWARD, as calibrations have them; field of view, aspect and
/// shift of the frame change nothing about them.
///
/// A calibration treats a projector as a camera run backward: `distorted` takes the direction of a point in front of the
/// lens to the place on the slide that lights it. So looking a slide up is closed form, and only where a given place of
/// the slide is thrown to must be searched for (`undistorted`). A negative k1 makes photographs barrels; thrown through
/// the same lens a slide becomes a pincushion, and such a photograph straight again.
struct LensDistortion {
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  [[nodiscard]] bool is_none() const { return k1 == 0 && k2 == 0 && p1 == 0 && p2 == 0 && k3 == 0; }
  bool operator==(const LensDistortion&) const = default;
};

/// Largest size of a coefficient, and the tangent of the widest angle off the axis (89.94°) at which a lens with
/// distortion shows anything.
inline constexpr double kMaxDistortion = 1e6;
inline constexpr double kWidestLensField = 1e3;

/// With r² = x² + y² and f = 1 + k1 r² + k2 r⁴ + k3 r⁶:
/// x' = x f + 2 p1 x y + p2 (r² + 2 x²),  y' = y f + p1 (r² + 2 y²) + 2 p2 x y  (OpenCV, calib3d, projectPoints).
glm::dvec2 distorted(const LensDistortion& lens, glm::dvec2 direction);
/// Its derivative by the direction: symmetric, for `distorted` is the gradient of a potential.
glm::dmat2 distorted_by(const LensDistortion& lens, glm::dvec2 direction);

/// How far from the axis, as a tangent, `distorted` is one to one: up to there it surely does not fold back on itself.
/// At most kWidestLensField. Nothing is thrown to directions beyond.
double lens_field(const LensDistortion& lens);

/// The direction within lens_field() that `distorted` takes to `place`; nothing where there is none.
std::optional<glm::dvec2> undistorted(const LensDistortion& lens, glm::dvec2 place);

/// Says where the lens folds, when part of a frame is thrown nowhere; empty when all of it is thrown. Coefficients that
/// are not finite or exceed kMaxDistortion, and parallel frames, are faults too.
std::string find_fault(const LensDistortion& lens, const Projection& frame);

}  // namespace laterna
