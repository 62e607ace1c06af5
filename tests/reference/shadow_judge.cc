#include "reference/shadow_judge.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "frame/surface_alpha.h"

namespace laterna::reference {
namespace {

using Long = long double;
using LongVector = glm::tvec3<Long>;

// Signed distance of the line from the origin along `way` (unit) to the line through a and b.
Long distance_of_lines(const LongVector& way, const LongVector& a, const LongVector& b) {
  const LongVector across = glm::cross(way, b - a);
  const Long length = std::sqrt(glm::dot(across, across));
  return length == 0 ? 0 : glm::dot(across, a) / length;
}

double distance_to_triangle(const glm::dvec3& p, const glm::dvec3* corner) {
  const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  bool is_above = glm::length(normal) > 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const glm::dvec3 a = corner[k], side = corner[(k + 1) % 3] - a;
    is_above = is_above && glm::dot(glm::cross(side, p - a), normal) >= 0;
    const double along = glm::dot(side, side) == 0 ? 0 : glm::dot(p - a, side) / glm::dot(side, side);
    nearest = std::min(nearest, glm::distance(p, a + std::clamp(along, 0.0, 1.0) * side));
  }
  return is_above ? std::abs(glm::dot(p - corner[0], glm::normalize(normal))) : nearest;
}

}  // namespace

ShadowJudge::ShadowJudge(const frame::Frame& frame, const frame::PlacedLight& placed)
    : frame_(frame),
      position_ws_(placed.pose.position_ws),
      forward_ws_(placed.pose.forward_ws()),
      near_(-std::numeric_limits<double>::infinity()) {
  const Light& light = *placed.light;
  const bool is_projector = light.type == LightType::projector;
  is_parallel_ =
      light.type == LightType::directional || (is_projector && placed.view.projection.is_orthographic);
  if (is_projector || (light.type == LightType::directional && !light.fit))
    near_ = placed.view.projection.near;
  for (std::uint32_t c = 0; c < frame.clusters.size(); ++c) {
    const Cluster& cluster = frame.clusters[c];
    if ((cluster.flags & kCastsShadow) == 0 || (cluster.flags & kAlphaBlend) != 0) continue;
    for (std::uint32_t t = 0; t < cluster.triangle_count; ++t) {
      Caster caster = {c << kTriangleBits | t, {}};
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t v = cluster.first_vertex + (frame.corners[caster.id] >> (8 * k) & 255U);
        caster.corner[k] = frame.positions_ws[v];
      }
      casters_.push_back(caster);
    }
  }
}

Judgement ShadowJudge::judge_alpha(TriangleId id, double b, double c, double tolerance) const {
  const Cluster& cluster = frame_.clusters[cluster_of(id)];
  if ((cluster.flags & kAlphaMask) == 0) return Judgement::dark;
  const float alpha = frame::alpha_at(frame_, id, static_cast<float>(b), static_cast<float>(c));
  const float cutoff = frame_.surfaces[cluster.material].alpha_cutoff;
  if (std::abs(alpha - cutoff) < tolerance) return Judgement::tie;
  return alpha < cutoff ? Judgement::lit : Judgement::dark;
}

Judgement ShadowJudge::judge(const Caster& caster, const glm::dvec3& position_ws, double nearest,
                             double tolerance, double alpha_tolerance) const {
  const LongVector p(position_ws);
  const LongVector to_light = is_parallel_ ? -LongVector(forward_ws_) : LongVector(position_ws_) - p;
  const Long whole = std::sqrt(glm::dot(to_light, to_light));
  const LongVector way = to_light / whole;
  const LongVector corner[3] = {LongVector(caster.corner[0]) - p, LongVector(caster.corner[1]) - p,
                                LongVector(caster.corner[2]) - p};
  const LongVector normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  if (glm::dot(normal, normal) == 0) return Judgement::lit;  // a line or a point
  const Long against = glm::dot(normal, way);
  bool is_left = true, is_right = true;  // of every edge, or so nearly that it may be
  bool is_surely_left = true, is_surely_right = true;
  for (int k = 0; k < 3; ++k) {
    const Long distance = distance_of_lines(way, corner[k], corner[(k + 1) % 3]);
    is_left = is_left && distance >= -tolerance;
    is_right = is_right && distance <= tolerance;
    is_surely_left = is_surely_left && distance > tolerance;
    is_surely_right = is_surely_right && distance < -tolerance;
  }
  if (!is_left && !is_right) return Judgement::lit;
  if (against == 0) return tolerance > 0 ? Judgement::tie : Judgement::lit;
  const Long distance = glm::dot(normal, corner[0]) / against;
  // A triangle seen edge-on may be met anywhere along its depth.
  const Long doubt = tolerance * std::sqrt(glm::dot(normal, normal)) / std::abs(against);
  Long farthest = is_parallel_ ? std::numeric_limits<Long>::infinity() : whole;
  const Long along = glm::dot(p - LongVector(position_ws_), LongVector(forward_ws_));
  if (near_ > -std::numeric_limits<double>::infinity()) {
    farthest = is_parallel_ ? along - near_ : along > 0 ? whole * (1 - near_ / along) : 0;
  }
  if (distance < nearest - doubt || distance > farthest + doubt) return Judgement::lit;
  const LongVector hit = way * distance;
  const auto weight = [&](int k) {
    return glm::dot(glm::cross(corner[(k + 1) % 3] - hit, corner[(k + 2) % 3] - hit), normal) /
           glm::dot(normal, normal);
  };
  const Judgement surface =
      judge_alpha(caster.id, static_cast<double>(weight(1)), static_cast<double>(weight(2)), alpha_tolerance);
  if (surface == Judgement::lit) return Judgement::lit;
  const bool is_sure = (is_surely_left || is_surely_right) && distance > nearest + doubt &&
                       distance < farthest - doubt && surface == Judgement::dark;
  return is_sure ? Judgement::dark : Judgement::tie;
}

Judgement ShadowJudge::judge(const glm::dvec3& position_ws, TriangleId own, double nearest, double tolerance,
                             double alpha_tolerance) const {
  Judgement result = Judgement::lit;
  for (const Caster& caster : casters_) {
    if (caster.id == own) continue;
    const Judgement here = judge(caster, position_ws, nearest, tolerance, alpha_tolerance);
    if (here == Judgement::dark) return here;
    if (here == Judgement::tie) result = here;
  }
  return result;
}

TriangleId ShadowJudge::triangle_at(const glm::dvec3& position_ws) const {
  TriangleId nearest = kNoTriangle;
  double least = std::numeric_limits<double>::infinity();
  for (const Caster& caster : casters_) {
    const double distance = distance_to_triangle(position_ws, caster.corner);
    if (distance < least) least = distance, nearest = caster.id;
  }
  return nearest;
}

}  // namespace laterna::reference
