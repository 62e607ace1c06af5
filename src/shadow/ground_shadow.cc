#include "shadow/ground_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "frame/surface_alpha.h"
#include "light/floor.h"
#include "light/ground_transformation.h"
#include "light/light_rays.h"

namespace laterna::shadow {
namespace {

// Cosine of 0.8°: a triangle's normal in single precision is hardly worse, however thin it is.
constexpr double kLiesInPlane = 0.9999;

// Two axes of the plane, each at most 1 in any coordinate's direction: which ones does not matter.
std::array<glm::dvec3, 2> axes_in(const glm::dvec3& normal) {
  const glm::dvec3 other = std::abs(normal.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 first = glm::normalize(glm::cross(other, normal));
  return {first, glm::cross(normal, first)};
}

// A rectangle of the plane.
struct Rectangle {
  double s_low, s_high, t_low, t_high;
  void include(double s, double t) {
    s_low = std::min(s_low, s), s_high = std::max(s_high, s);
    t_low = std::min(t_low, t), t_high = std::max(t_high, t);
  }
  static constexpr Rectangle nowhere() { return {1e300, -1e300, 1e300, -1e300}; }
};

// A caster's corner after the ground transformation: its shadow is at s/w, t/w.
struct Corner {
  double s, t, w;
  double height;    // before it, over the plane
  double in_front;  // of the light's near plane
};

// Which sides of a rectangle a corner's shadow lies beyond. No division: where all corners of a triangle lie beyond the
// same side, its shadow does so as well, and what is beyond by a negative w is no shadow.
unsigned beyond(const Corner& c, const Rectangle& r) {
  return (c.s < r.s_low * c.w ? 1U : 0U) | (c.s > r.s_high * c.w ? 2U : 0U) |
         (c.t < r.t_low * c.w ? 4U : 0U) | (c.t > r.t_high * c.w ? 8U : 0U);
}

// The least and the largest that row · (point, 1) is in a cluster's box.
struct Extremes {
  double least, most;
};
Extremes extremes_of(const glm::dvec4& row, const glm::dvec3& centre, const glm::dvec3& half) {
  const double middle = glm::dot(glm::dvec3(row), centre) + row.w;
  const double reach = glm::dot(glm::abs(glm::dvec3(row)), half);
  return {middle - reach, middle + reach};
}

// Up to a group of samples on the plane.
struct Chunk {
  std::size_t count = 0;
  std::array<std::uint16_t, kGroupSize> sample{};
  std::array<double, kGroupSize> s{}, t{};
  std::array<bool, kGroupSize> is_lit{};
  Rectangle bounds = Rectangle::nowhere();
};

// The shadow of one triangle on the plane: not a polygon, but the edge functions of one, over homogeneous coordinates.
// So nothing is clipped where corners lie behind the light.
class ShadowPolygon {
 public:
  ShadowPolygon(const Corner& a, const Corner& b, const Corner& c) : corners_{a, b, c} {
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner& p = corners_[(k + 1) % 3];
      const Corner& q = corners_[(k + 2) % 3];
      // Of neighbours that share an edge, exactly the negative: no point slips between them.
      edges_[k] = {p.t * q.w - q.t * p.w, p.w * q.s - q.w * p.s, p.s * q.t - q.s * p.t};
    }
  }

  // Weights of the corners, by any factor, of the point that shades (s, t); whether there is one.
  bool covers(double s, double t, glm::dvec3& weights) const {
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3& e = edges_[static_cast<std::size_t>(k)];
      weights[k] = e.x * s + (e.y * t + e.z);
    }
    if (weights.x <= 0 && weights.y <= 0 && weights.z <= 0) weights = -weights;
    if (weights.x < 0 || weights.y < 0 || weights.z < 0) return false;
    // Seen edge-on it has no area, and its neighbours cover what is there.
    return at(weights, &Corner::w) > 0 && at(weights, &Corner::height) >= 0 &&
           at(weights, &Corner::in_front) >= 0;
  }

 private:
  [[nodiscard]] double at(const glm::dvec3& weights, double Corner::*value) const {
    return weights.x * corners_[0].*value + (weights.y * corners_[1].*value + weights.z * corners_[2].*value);
  }

  std::array<Corner, 3> corners_;
  std::array<glm::dvec3, 3> edges_;
};

}  // namespace

struct GroundShadow::Batch {
  std::array<Chunk, kMaxGroups> chunks;
  std::size_t count = 0;
  std::size_t lit = 0;
  Rectangle bounds = Rectangle::nowhere();
};

GroundShadow::GroundShadow(const light::PlannedLight& planned, const frame::Frame& frame)
    : frame_(frame), tolerance_(light::plane_tolerance(frame)), in_front_(0, 0, 0, 1) {
  const frame::PlacedLight& placed = *planned.placed;
  const glm::dvec4 light = light::homogeneous_light(placed);
  // A light whose box is fitted to the scene has nothing before it.
  const light::LightRays rays(placed);
  if (rays.has_near) in_front_ = {rays.forward_ws, -glm::dot(rays.forward_ws, rays.position_ws) - rays.near};
  for (const ShadowPlane& plane : planned.ground_planes) {
    glm::dvec4 height = light::plane_equation(plane);
    const double light_height = glm::dot(height, light);
    // A light in the plane grazes it: shadows would be infinitely long.
    if (light_height == 0) continue;
    if (light_height < 0) height = -height;
    const glm::dmat4 rows = glm::transpose(light::ground_transformation(height, light));
    const glm::dvec3 normal(height);
    const glm::dvec3 origin = normal * -height.w;
    const std::array<glm::dvec3, 2> axes = axes_in(normal);
    const auto in_plane = [&](const glm::dvec3& axis) {
      return axis.x * rows[0] + axis.y * rows[1] + axis.z * rows[2] - glm::dot(axis, origin) * rows[3];
    };
    receivers_.push_back({height, in_plane(axes[0]), in_plane(axes[1]), rows[3]});
  }
}

void GroundShadow::draw_cluster(const Receiver& receiver, std::size_t cluster, Batch& batch) const {
  const Cluster& c = frame_.clusters[cluster];
  const bool has_holes = (c.flags & kAlphaMask) != 0;
  std::array<Corner, kVerticesPerCluster> corners;
  std::array<std::uint8_t, kVerticesPerCluster> outside;
  // What does not rise from the plane by more than the tolerance is part of it.
  constexpr unsigned kFlat = 16, kBehind = 32;
  for (std::size_t v = 0; v < c.vertex_count; ++v) {
    const std::size_t i = c.first_vertex + v;
    const glm::dvec4 p(frame_.positions_ws[i], 1);
    Corner& corner = corners[v];
    corner = {glm::dot(receiver.s, p), glm::dot(receiver.t, p), glm::dot(receiver.w, p),
              glm::dot(receiver.height, p), glm::dot(in_front_, p)};
    outside[v] =
        static_cast<std::uint8_t>(beyond(corner, batch.bounds) | (corner.height <= tolerance_ ? kFlat : 0U) |
                                  (corner.in_front < 0 || corner.w <= 0 ? kBehind : 0U));
  }
  for (std::uint32_t t = 0; t < c.triangle_count && batch.lit > 0; ++t) {
    const auto id = static_cast<TriangleId>(cluster << kTriangleBits | t);
    const std::uint32_t packed = frame_.corners[id];
    const std::uint32_t i0 = packed & 255U, i1 = packed >> 8U & 255U, i2 = packed >> 16U & 255U;
    if ((outside[i0] & outside[i1] & outside[i2]) != 0) continue;
    const ShadowPolygon polygon(corners[i0], corners[i1], corners[i2]);
    for (std::size_t k = 0; k < batch.count; ++k) {
      Chunk& chunk = batch.chunks[k];
      if ((beyond(corners[i0], chunk.bounds) & beyond(corners[i1], chunk.bounds) &
           beyond(corners[i2], chunk.bounds)) != 0) {
        continue;
      }
      for (std::size_t i = 0; i < chunk.count; ++i) {
        glm::dvec3 weights;
        if (!chunk.is_lit[i] || !polygon.covers(chunk.s[i], chunk.t[i], weights)) continue;
        if (has_holes) {
          const double sum = weights.x + (weights.y + weights.z);
          const float alpha = frame::alpha_at(frame_, id, static_cast<float>(weights.y / sum),
                                              static_cast<float>(weights.z / sum));
          if (alpha < frame_.surfaces[c.material].alpha_cutoff) continue;
        }
        chunk.is_lit[i] = false;
        --batch.lit;
      }
    }
  }
}

// Each sample is dark or not, however many polygons lie over it: darkened once (row 96).
void GroundShadow::darken(const Receiver& receiver, Batch& batch, Arrival& arrival) const {
  const Rectangle& r = batch.bounds;
  // Sides of the pyramid between the samples and the light, as rows over (point, 1): at least 0 inside.
  const std::array<glm::dvec4, 4> sides = {
      receiver.s - r.s_low * receiver.w, r.s_high * receiver.w - receiver.s,
      receiver.t - r.t_low * receiver.w, r.t_high * receiver.w - receiver.t};
  for (std::size_t c = 0; c < frame_.clusters.size() && batch.lit > 0; ++c) {
    const Cluster& cluster = frame_.clusters[c];
    // Panes: see shadow/panes.h.
    if (!is_opaque_caster(cluster)) continue;
    const glm::dvec3 low(cluster.low_ws[0], cluster.low_ws[1], cluster.low_ws[2]);
    const glm::dvec3 high(cluster.high_ws[0], cluster.high_ws[1], cluster.high_ws[2]);
    const glm::dvec3 centre = 0.5 * (low + high);
    const glm::dvec3 half = 0.5 * (high - low);
    if (extremes_of(receiver.height, centre, half).most <= tolerance_) continue;
    const bool is_outside = std::any_of(sides.begin(), sides.end(), [&](const glm::dvec4& side) {
      return extremes_of(side, centre, half).most < 0;
    });
    if (!is_outside) draw_cluster(receiver, c, batch);
  }
  for (std::size_t k = 0; k < batch.count; ++k) {
    const Chunk& chunk = batch.chunks[k];
    for (std::size_t i = 0; i < chunk.count; ++i) {
      if (!chunk.is_lit[i]) arrival.alpha[chunk.sample[i]] = 0;
    }
  }
}

double GroundShadow::find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                                  Arrival& arrival) const {
  arrival.is_tinted = false;
  std::fill_n(arrival.alpha.data(), samples.group_count * kGroupSize, 1.0F);
  const double tolerance = std::max<double>(tolerance_, 4 * static_cast<double>(samples.position_error));
  for (const Receiver& receiver : receivers_) {
    Batch batch;
    for (std::size_t group = 0; group < samples.group_count; ++group) {
      Chunk& chunk = batch.chunks[batch.count];
      for (unsigned mask = wanted[group]; mask != 0; mask &= mask - 1) {
        const std::size_t i = group * kGroupSize + static_cast<std::size_t>(__builtin_ctz(mask));
        const glm::dvec4 p(samples.x_ws[i], samples.y_ws[i], samples.z_ws[i], 1);
        const glm::dvec3 normal(samples.normal_x_ws[i], samples.normal_y_ws[i], samples.normal_z_ws[i]);
        if (std::abs(glm::dot(receiver.height, p)) > tolerance) continue;
        if (std::abs(glm::dot(glm::dvec3(receiver.height), normal)) < kLiesInPlane) continue;
        const double w = glm::dot(receiver.w, p);
        if (!(w > 0)) continue;  // beside a light that all but touches the plane
        const double s = glm::dot(receiver.s, p) / w;
        const double t = glm::dot(receiver.t, p) / w;
        chunk.sample[chunk.count] = static_cast<std::uint16_t>(i);
        chunk.s[chunk.count] = s;
        chunk.t[chunk.count] = t;
        chunk.is_lit[chunk.count] = true;
        chunk.bounds.include(s, t);
        batch.bounds.include(s, t);
        ++chunk.count;
      }
      batch.lit += chunk.count;
      if (chunk.count > 0) ++batch.count;
    }
    if (batch.count > 0) darken(receiver, batch, arrival);
  }
  return 0;
}

}  // namespace laterna::shadow
