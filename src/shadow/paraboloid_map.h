// All directions from a light in two square maps, front and back: Heidrich and Seidel, View-independent environment maps,
// 1998; as shadow maps: Brabec, Annen and Seidel, Shadow mapping for hemispherical and omnidirectional light sources, 2002.
#pragma once

#include <array>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "base/task_pool.h"
#include "frame/frame.h"
#include "light/light_plan.h"

namespace laterna::shadow {

/// Directions ↔ texels. A map shows what a paraboloid mirror before it reflects: direction (x, y, z) is at (x, y) / (1 + z),
/// the half with z > 0 within the unit circle. Each map is drawn past that circle to its square's corners, and a few
/// texels farther, so that a filter at the seam finds all it asks for in one map.
///
/// "Local" directions have the first map's axis as +z and the second's as −z.
class ParaboloidPair {
 public:
  /// `resolution`: texels across the unit circle. `border`: texels beyond it on each side.
  ParaboloidPair(const Pose& pose, int resolution, int border);

  [[nodiscard]] int side() const { return side_; }
  [[nodiscard]] glm::dvec3 to_local(const glm::dvec3& direction_ws) const {
    return local_from_world_ * direction_ws;
  }
  [[nodiscard]] glm::dvec3 to_eye(const glm::dvec3& position_ws) const {
    return to_local(position_ws - eye_ws_);
  }
  /// 0 or 1: the map whose half the direction lies in.
  static int map_of(const glm::dvec3& local) { return local.z >= 0 ? 0 : 1; }
  /// Texels have their centres at halves. `local` has length 1.
  [[nodiscard]] glm::dvec2 texel_of(const glm::dvec3& local, int map) const {
    const double scale = 1 / ((1 + (map == 0 ? local.z : -local.z)) * step_);
    return {local.x * scale + 0.5 * side_, local.y * scale + 0.5 * side_};
  }
  /// Of length 1.
  [[nodiscard]] glm::dvec3 direction_of(const glm::dvec2& texel, int map) const {
    const double u = (texel.x - 0.5 * side_) * step_, v = (texel.y - 0.5 * side_) * step_;
    const double r2 = u * u + v * v;
    const double scale = 1 / (1 + r2);
    const double z = (1 - r2) * scale;
    return {2 * u * scale, 2 * v * scale, map == 0 ? z : -z};
  }
  /// Width of a texel there, radians: the map is conformal.
  [[nodiscard]] double texel_angle(const glm::dvec3& local) const {
    return step_ * (1 + (local.z >= 0 ? local.z : -local.z));
  }

  /// Texels x_first ≤ x < x_end, y_first ≤ y < y_end.
  struct Texels {
    int x_first = 0, x_end = 0, y_first = 0, y_end = 0;
    [[nodiscard]] bool is_empty() const { return x_first >= x_end || y_first >= y_end; }
  };
  /// Texels that may see some of the cone about `axis` (unit, local) with this cosine of its half angle, at least 0.
  [[nodiscard]] Texels find_cone(const glm::dvec3& axis, double cosine, int map) const;
  [[nodiscard]] Texels all_texels() const { return {0, side_, 0, side_}; }
  bool operator==(const ParaboloidPair&) const = default;

 private:
  glm::dvec3 eye_ws_;
  glm::dmat3 local_from_world_;
  int side_;
  double step_;  // of u or v from one texel to the next
};

/// Seen from the light. Corners are local, relative to it.
struct LocalTriangle {
  std::array<glm::dvec3, 3> corner;

  LocalTriangle(const frame::Frame& frame, TriangleId id, const ParaboloidPair& pair);
  /// Six times the volume between light and triangle; positive where the light sees its front: local axes are the world's
  /// mirrored.
  [[nodiscard]] double volume() const;
};

/// The nearest caster in every texel of both maps: the reverse of its distance along the texel's own ray, and its id.
class ParaboloidMap {
 public:
  struct Texel {
    float reverse_distance = 0;  ///< 0: nothing
    TriangleId id = kNoTriangle;
  };

  /// Of opaque casters those whose clusters' flags, where `mask` has bits, are `flags`.
  struct Casters {
    CasterFaces faces = CasterFaces::both;
    std::uint32_t mask = 0, flags = 0;
  };
  /// Draws both at once, over a map of other casters seen by the same pair where `under` is one: as if all were drawn at once. Straight edges are curves here, so nothing is drawn vertex by vertex: each texel's ray is tested
  /// against planes through the light and the triangle's edges, in double precision, and none passes between two triangles.
  /// Once `asks_to_stop` what is left stays empty.
  ParaboloidMap(const frame::Frame& frame, const ParaboloidPair& pair, const Casters& casters,
                const ParaboloidMap* under, const TaskPool& pool, const std::function<bool()>& asks_to_stop);

  [[nodiscard]] const ParaboloidPair& pair() const { return pair_; }
  /// Beyond the map's sides, the nearest that it has.
  [[nodiscard]] const Texel& at(int map, int x, int y) const;
  [[nodiscard]] std::size_t memory_bytes() const {
    return (texels_[0].size() + texels_[1].size()) * sizeof(Texel);
  }

 private:
  class Painter;

  ParaboloidPair pair_;
  std::array<std::vector<Texel>, 2> texels_;  // row by row
};

}  // namespace laterna::shadow
