#include "shadow/exact_crossing.h"

#include <glm/geometric.hpp>
#include <tuple>

#include "frame/surface_alpha.h"

namespace laterna::shadow {
namespace {

bool comes_first(const glm::vec3& a, const glm::vec3& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

// Six times the volume between the way to the light and an edge: on which side of the edge the way passes. The edge's
// ends are taken in one order whatever the triangle's, so that the triangle beyond the edge sees exactly the opposite.
double side_of(const glm::dvec3& way, const glm::dvec3& from, const glm::vec3& a, const glm::vec3& b) {
  if (comes_first(b, a)) return -side_of(way, from, b, a);
  return glm::dot(way, glm::cross(glm::dvec3(a) - from, glm::dvec3(b) - from));
}

bool is_left(double side, const glm::vec3& a, const glm::vec3& b) {
  return side == 0 ? comes_first(a, b) : side > 0;
}

}  // namespace

CornersOfTriangle corners_of(const frame::Frame& frame, TriangleId id) {
  return {frame.corner_ws(id, 0), frame.corner_ws(id, 1), frame.corner_ws(id, 2)};
}

// Segura and Feito 2001, Algorithms to test ray-triangle intersection: signs of volumes.
Crossing find_crossing(const light::LightRays& light, const glm::vec3& position_ws, float nearest,
                       const CornersOfTriangle& t, OnEdge on_edge) {
  const glm::dvec3 p(position_ws);
  const glm::dvec3 way = light.away_at(p);
  const double of_a = side_of(way, p, t.b, t.c);
  const double of_b = side_of(way, p, t.c, t.a);
  const double of_c = side_of(way, p, t.a, t.b);
  bool is_outside = (of_a < 0 || of_b < 0 || of_c < 0) && (of_a > 0 || of_b > 0 || of_c > 0);
  if (on_edge == OnEdge::of_one) {
    // On an edge, the way is taken to pass on the left of it as its ends are ordered.
    const bool left_of_a = is_left(of_a, t.b, t.c), left_of_b = is_left(of_b, t.c, t.a);
    is_outside = left_of_a != left_of_b || left_of_a != is_left(of_c, t.a, t.b);
  }
  const double sum = of_a + of_b + of_c;
  if (is_outside || sum == 0) return {};
  const glm::dvec3 to_a = glm::dvec3(t.a) - p;
  const glm::dvec3 normal = glm::cross(glm::dvec3(t.b) - glm::dvec3(t.a), glm::dvec3(t.c) - glm::dvec3(t.a));
  const double against = glm::dot(normal, way);
  if (against == 0) return {};
  const double whole = glm::length(way);
  const double distance = -glm::dot(normal, to_a) / against * whole;
  if (distance < nearest || distance > light.length_at(p)) return {};
  return {true, static_cast<float>(of_b / sum), static_cast<float>(of_c / sum)};
}

bool darkens(const frame::Frame& frame, const light::LightRays& light, const glm::vec3& position_ws,
             float nearest, TriangleId id) {
  const Crossing crossing = find_crossing(light, position_ws, nearest, corners_of(frame, id));
  return crossing.blocks && !frame::is_hole(frame, id, crossing.b, crossing.c);
}

}  // namespace laterna::shadow
