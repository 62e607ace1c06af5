// Triangles in a plane, and the points that they hold: no point of a mesh is missed, and none is held twice.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <utility>

namespace laterna {

/// Twice the area of (a, b, p), positive where p lies to the left of a → b. Computed from the lesser end, so that two
/// triangles that share the edge agree about p to the last bit.
inline double side_of(glm::dvec2 a, glm::dvec2 b, const glm::dvec2& p) {
  const bool is_turned = b.x < a.x || (b.x == a.x && b.y < a.y);
  if (is_turned) std::swap(a, b);
  const double area = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  return is_turned ? -area : area;
}

/// Weights of a triangle's second and third corner.
struct FlatWeights {
  double b = 0, c = 0;
};

class FlatTriangle {
 public:
  explicit FlatTriangle(const std::array<glm::dvec2, 3>& corner) : corner_(corner) {
    is_turned_ = twice_area() < 0;
  }

  [[nodiscard]] double twice_area() const {
    const glm::dvec2 u = corner_[1] - corner_[0], v = corner_[2] - corner_[0];
    return u.x * v.y - u.y * v.x;
  }
  [[nodiscard]] glm::dvec2 low() const { return glm::min(corner_[0], glm::min(corner_[1], corner_[2])); }
  [[nodiscard]] glm::dvec2 high() const { return glm::max(corner_[0], glm::max(corner_[1], corner_[2])); }

  /// A point on an edge belongs to one of the two triangles that share it: the one to whose left it runs downward, or level
  /// to the left.
  [[nodiscard]] bool holds(const glm::dvec2& p) const {
    const auto& [a, b, c] = corner_;
    return is_turned_ ? lies_left(a, c, p) && lies_left(c, b, p) && lies_left(b, a, p)
                      : lies_left(a, b, p) && lies_left(b, c, p) && lies_left(c, a, p);
  }

  /// Of the triangle's point that is nearest to p; `distance_squared` is how far that is.
  [[nodiscard]] FlatWeights nearest(const glm::dvec2& p, double& distance_squared) const {
    const double area = twice_area();
    if (area != 0) {
      const glm::dvec2 from_a = p - corner_[0];
      const glm::dvec2 u = corner_[1] - corner_[0], v = corner_[2] - corner_[0];
      const double b = (from_a.x * v.y - from_a.y * v.x) / area;
      const double c = (u.x * from_a.y - u.y * from_a.x) / area;
      if (b >= 0 && c >= 0 && b + c <= 1) {
        distance_squared = 0;
        return {b, c};
      }
    }
    distance_squared = std::numeric_limits<double>::infinity();
    FlatWeights best;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec2 from = corner_[k], along = corner_[(k + 1) % 3] - from;
      const double length_squared = glm::dot(along, along);
      const double t =
          length_squared > 0 ? std::clamp(glm::dot(p - from, along) / length_squared, 0.0, 1.0) : 0.0;
      const glm::dvec2 beside = p - (from + along * t);
      const double squared = glm::dot(beside, beside);
      if (!(squared < distance_squared)) continue;
      distance_squared = squared;
      best = k == 0 ? FlatWeights{t, 0} : k == 1 ? FlatWeights{1 - t, t} : FlatWeights{0, 1 - t};
    }
    return best;
  }

 private:
  static bool lies_left(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
    const double side = side_of(a, b, p);
    return side > 0 || (side == 0 && (b.y < a.y || (b.y == a.y && b.x < a.x)));
  }

  std::array<glm::dvec2, 3> corner_;
  bool is_turned_;
};

}  // namespace laterna
