// The surface of a light's shadow volumes: what is cut off from the light by its casters, without a camera. Crow, Shadow
// algorithms for computer graphics, 1977.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "frame/frame.h"
#include "light/light_rays.h"

namespace laterna::shadow {

/// A corner of the surface: a point, or where the ray from the light through that point ends, infinitely far away.
struct VolumeCorner {
  std::uint32_t point = 0;
  bool is_infinite = false;
  bool operator==(const VolumeCorner&) const = default;
};

enum class VolumePart : std::uint8_t {
  cap,   ///< a caster's triangle, where its shadow begins
  side,  ///< from an edge to infinity
  end,   ///< the shadow's end, infinitely far away
  cutout,  ///< of one triangle's own volume, which is shadow only where the light meets the triangle's opaque parts
};

/// A triangle of the surface, counter-clockwise seen from outside of the volume.
struct VolumeTriangle {
  VolumeCorner corner[3];
  /// How many times the triangle is in the surface, at least 1.
  std::int32_t count = 1;
  VolumePart part = VolumePart::cap;
};

/// The shadow of one triangle of a cut-out, which is shadow only where the light meets its opaque parts.
struct VolumePrism {
  std::array<std::uint32_t, 3> point;  ///< counter-clockwise as the light sees them
  TriangleId caster;
};

/// Each opaque caster's triangle has a prism of shadow, from itself to infinity away from the light, whichever side of it the
/// light sees. A point in n prisms has n triangles between itself and the light. Walls that two prisms share, on edges
/// between triangles that lie on either side of it, cancel; what remains are the silhouettes, twice where a surface
/// folds back, once where it ends. So open and closed meshes, inconsistent windings, edges of three triangles and lights
/// inside a mesh are all one case: Bergeron, A general version of Crow's shadow volumes, 1986; Kim, Kim, Kong and Nehab,
/// Shadow volumes for non-manifold meshes, 2008.
class VolumeSurface {
 public:
  VolumeSurface(const frame::Frame& frame, const light::LightRays& light);

  [[nodiscard]] const std::vector<glm::dvec3>& points_ws() const { return points_ws_; }
  [[nodiscard]] const std::vector<VolumeTriangle>& triangles() const { return triangles_; }
  [[nodiscard]] const std::vector<VolumePrism>& prisms() const { return prisms_; }
  /// The closed surface of a prism.
  [[nodiscard]] std::vector<VolumeTriangle> surface_of(const VolumePrism& prism) const;
  /// Edges with walls.
  [[nodiscard]] std::size_t silhouette_edges() const { return silhouette_edges_; }
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  class Builder;
  using Corners = std::array<std::uint32_t, 3>;

  void append_ends(const Corners& corners, std::vector<VolumeTriangle>& triangles) const;
  void append_wall(std::uint32_t from, std::uint32_t to, std::int32_t count,
                   std::vector<VolumeTriangle>& triangles) const;

  bool is_parallel_;
  std::vector<glm::dvec3> points_ws_;
  std::vector<VolumeTriangle> triangles_;
  std::vector<VolumePrism> prisms_;
  std::size_t silhouette_edges_ = 0;
};

}  // namespace laterna::shadow
