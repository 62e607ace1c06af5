// Surfaces cut into pieces that can be laid flat.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace laterna::bake {

/// Some of a surface's triangles, seen along one direction.
struct Chart {
  std::vector<std::uint32_t> triangles;
  glm::dvec3 axis_u{0}, axis_v{0};  ///< unit, square to each other and to that direction
  glm::dvec2 low{0}, size{0};       ///< of the triangles along the axes, in metres

  [[nodiscard]] glm::dvec2 flat(const glm::dvec3& point_ws) const;
};

/// No triangle of a chart is turned farther from the direction in which it is laid flat than this: its area shrinks to no
/// less than cos 30° = 0.87, and lengths do not shrink more.
inline constexpr double kLeastChartCosine = 0.8660254037844387;

/// Every triangle that has an area is in one chart. `corners_ws`: three for each triangle, equal where they are one vertex.
/// Charts grow over edges that two triangles share, the largest triangle first, as in Lévy et al. 2002 (Least squares
/// conformal maps, section 3.2), but by normals alone: they need no parametrisation. Each is turned so that its rectangle is
/// the smallest, the longer side along u. None overlaps itself by more than part of a square of `resolution` metres, and
/// none of several triangles is longer than `max_size` metres.
std::vector<Chart> cut_into_charts(std::span<const glm::dvec3> corners_ws, double resolution,
                                   double max_size);

/// Whether triangles in a plane cover the middle of a square of `resolution` more than once. Three corners each, any
/// orientation. Edges belong to one of the two triangles that share them.
bool overlap(std::span<const glm::dvec2> corners, double resolution);

}  // namespace laterna::bake
