// OpenCV's lens, the one formula for projectors' lenses and for photographs'.
#pragma once

#include <array>
#include <glm/vec2.hpp>

namespace laterna {

/// With r² = x² + y² and f = (1 + k1 r² + k2 r⁴ + k3 r⁶) / (1 + k4 r² + k5 r⁴ + k6 r⁶):
/// x' = x f + 2 p1 x y + p2 (r² + 2 x²),  y' = y f + p1 (r² + 2 y²) + 2 p2 x y  (OpenCV, calib3d, projectPoints);
/// x, y a pinhole's coordinates at unit distance, y downward, and x', y' the lens's.
struct CameraDistortion {
  std::array<double, 6> k{};
  std::array<double, 2> p{};

  [[nodiscard]] bool is_none() const { return k == decltype(k){} && p == decltype(p){}; }
};

/// f.
double radial_factor(const CameraDistortion& lens, double r2);
/// (x', y').
glm::dvec2 distorted(const CameraDistortion& lens, glm::dvec2 point);

}  // namespace laterna
