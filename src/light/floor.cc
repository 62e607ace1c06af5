#include "light/floor.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace laterna::light {
namespace {

// Cosine of 0.8°: what is told of normals in single precision, also of thin triangles.
constexpr double kHorizontal = 0.9999;

struct Level {
  double height, area;
};

// Those whose front is up, or all that can be seen from above.
std::vector<Level> horizontal_triangles(const frame::Frame& frame, bool by_either_side) {
  constexpr std::uint32_t kNeeded = kReceivesShadow | kVisible;
  std::vector<Level> levels;
  for (std::size_t c = 0; c < frame.clusters.size(); ++c) {
    const Cluster& cluster = frame.clusters[c];
    if ((cluster.flags & kNeeded) != kNeeded) continue;
    const bool has_two_sides = by_either_side && (cluster.flags & kDoubleSided) != 0;
    for (std::uint32_t t = 0; t < cluster.triangle_count; ++t) {
      const auto id = static_cast<TriangleId>(c << kTriangleBits | t);
      const glm::dvec3 p0(frame.corner_ws(id, 0));
      const glm::dvec3 n =
          glm::cross(glm::dvec3(frame.corner_ws(id, 1)) - p0, glm::dvec3(frame.corner_ws(id, 2)) - p0);
      const double up = has_two_sides ? std::abs(n.y) : n.y;
      if (up > 0 && up >= kHorizontal * glm::length(n)) levels.push_back({p0.y, 0.5 * up});
    }
  }
  return levels;
}

// Those at most `thickness` over the lowest of them as one, from below.
std::vector<Level> join_levels(std::vector<Level> triangles, double thickness) {
  std::sort(triangles.begin(), triangles.end(), [](const Level& a, const Level& b) {
    return a.height != b.height ? a.height < b.height : a.area < b.area;
  });
  std::vector<Level> planes;
  for (std::size_t first = 0, end = 0; first < triangles.size(); first = end) {
    double area = 0;
    double moment = 0;  // about the lowest, so that nothing is lost far from the origin
    const double lowest = triangles[first].height;
    for (; end < triangles.size() && triangles[end].height <= lowest + thickness; ++end) {
      area += triangles[end].area;
      moment += triangles[end].area * (triangles[end].height - lowest);
    }
    planes.push_back({area > 0 ? lowest + moment / area : lowest, area});
  }
  return planes;
}

}  // namespace

double plane_tolerance(const frame::Frame& frame) {
  const glm::dvec3 low(frame.bounds.low);
  const glm::dvec3 high(frame.bounds.high);
  return frame.bounds.is_empty ? 0 : 2e-5 * glm::length(high - low);
}

std::optional<ShadowPlane> find_floor(const frame::Frame& frame) {
  // The lower side of a slab is no floor, even where its material has two sides.
  std::vector<Level> triangles = horizontal_triangles(frame, false);
  if (triangles.empty()) triangles = horizontal_triangles(frame, true);
  const std::vector<Level> planes = join_levels(std::move(triangles), plane_tolerance(frame));
  double largest = 0;
  for (const Level& plane : planes) largest = std::max(largest, plane.area);
  for (const Level& plane : planes) {
    if (plane.area > 0 && plane.area >= 0.5 * largest) return ShadowPlane{{0, 1, 0}, plane.height};
  }
  return std::nullopt;
}

}  // namespace laterna::light
