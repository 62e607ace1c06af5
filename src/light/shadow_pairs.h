// Which objects can shade which: Chen and Tung, Real-time shadow rendering using projective texture, section 3.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace laterna::light {

struct BoundingSphere {
  glm::dvec3 centre{0};
  double radius = 0;
};

struct ShadowPair {
  std::uint32_t occluder = 0, receiver = 0;
  /// The occluder as a whole is nearer to the light. Otherwise the two overlap in distance, and either may be before
  /// the other.
  bool is_ordered = false;
  bool operator==(const ShadowPair&) const = default;
};

/// A sphere as a light sees it: a cone about a direction, or with parallel rays a circle on a plane, and the range of
/// distances from the light that it takes up (rows 38–40).
class SphereOutline {
 public:
  /// `light` is (position, 1) or (direction toward it, 0).
  SphereOutline(const BoundingSphere& sphere, const glm::dvec4& light);

  /// Whether outlines overlap. Those that touch do not, and one with the light inside overlaps every other.
  [[nodiscard]] bool overlaps(const SphereOutline& other) const;
  /// Whether all of this is nearer to the light than all of `other`.
  [[nodiscard]] bool lies_before(const SphereOutline& other) const { return farthest_ < other.nearest_; }

  /// Where the outline lies along an axis: of unit directions, or of the plane.
  struct Span {
    double low, high;
  };
  [[nodiscard]] Span along(int axis) const;

 private:
  bool is_parallel_;
  bool holds_light_ = false;
  glm::dvec3 middle_{0};          // unit direction, or the place on the plane
  double sine_ = 0, cosine_ = 1;  // of the cone's half-angle θ = asin(r/d)
  double half_sine_ = 0, half_cosine_ = 1;
  double radius_ = 0;  // of the circle
  double nearest_, farthest_;
};

/// Every pair of which the first may shade the second, by occluder and then receiver; each sphere compared with each, as
/// the paper does: O(n²).
std::vector<ShadowPair> find_shadow_pairs(std::span<const BoundingSphere> spheres, const glm::dvec4& light);

/// The same pairs by sweep and prune (row 48; Cohen et al., I-COLLIDE, 1995): outlines are sorted along the axis on which
/// they lie farthest apart, and compared only where they overlap on it and share a band of the next. O(n log n) where
/// few do.
std::vector<ShadowPair> sweep_shadow_pairs(std::span<const BoundingSphere> spheres, const glm::dvec4& light);

}  // namespace laterna::light
