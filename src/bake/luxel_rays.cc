#include "bake/luxel_rays.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "base/elementary.h"
#include "base/sample_sequence.h"

namespace laterna::bake {
namespace {

double fraction_of(double x) { return x - std::floor(x); }

// A unit vector of the hemisphere about `normal` whose density is its cosine over π (Malley's method): a point of the disc,
// lifted. The frame: Duff and others, Building an orthonormal basis, revisited, 2017.
glm::vec3 cosine_weighted(const glm::vec3& normal, double u, double v) {
  const double radius = std::sqrt(u);
  const double angle = 2 * kPi * v;
  const auto x = static_cast<float>(radius * cosine(angle));
  const auto y = static_cast<float>(radius * sine(angle));
  const auto z = static_cast<float>(std::sqrt(1 - u));
  const float sign = std::copysign(1.0F, normal.z);
  const float a = -1 / (sign + normal.z);
  const float b = normal.x * normal.y * a;
  const glm::vec3 tangent(1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
  const glm::vec3 bitangent(b, sign + normal.y * normal.y * a, -normal.y);
  return tangent * x + bitangent * y + normal * z;
}

// A luxel's position and the planes of its triangle's neighbours are off by roundings of the triangle's coordinates; nearer
// than a few of these nothing is met.
float nearest_met(const frame::Frame& frame, const Luxel& luxel) {
  glm::vec3 size(0);
  for (unsigned k = 0; k < 3; ++k) size = glm::max(size, glm::abs(frame.corner_ws(luxel.triangle, k)));
  return 4 * std::numeric_limits<float>::epsilon() * std::max(size.x, std::max(size.y, size.z));
}

}  // namespace

PlaceShift shift_of(std::uint32_t place) {
  constexpr double kPlastic = 1.32471795724474602596;  // x³ = x + 1
  return {fraction_of(place / kPlastic), fraction_of(place / (kPlastic * kPlastic))};
}

namespace {

// A lattice of rays, shifted.
glm::vec3 direction_of(const Luxel& luxel, int ray, int count, const PlaceShift& shift) {
  const LatticePoint point = lattice_point({ray, count});
  return cosine_weighted(luxel.normal_ws, fraction_of(point.u + shift.u), fraction_of(point.v + shift.v));
}

// With no order in them at all, as nothing else is independent of shift_of(): the mixing of bits of SplitMix64 (Steele, Lea and Flood,
// Fast splittable pseudorandom number generators, 2014).
PlaceShift probe_shift_of(std::uint32_t place) {
  std::uint64_t bits = (std::uint64_t{place} + 1) * 0x9E3779B97F4A7C15U;
  bits = (bits ^ bits >> 30U) * 0xBF58476D1CE4E5B9U;
  bits = (bits ^ bits >> 27U) * 0x94D049BB133111EBU;
  bits ^= bits >> 31U;
  return {static_cast<double>(bits >> 32U) / 4294967296.0,
          static_cast<double>(bits & 0xFFFFFFFFU) / 4294967296.0};
}

}  // namespace

float LuxelRays::probe(std::uint32_t place, int ray, int count) const {
  const Luxel& luxel = tree_.luxels()[place];
  const glm::vec3 direction = direction_of(luxel, ray, count, probe_shift_of(place));
  const auto hit = rays_.find_nearest(luxel.position_ws, direction, nearest_met(frame_, luxel),
                                      std::numeric_limits<float>::infinity(), luxel.triangle);
  return hit ? hit->distance : std::numeric_limits<float>::infinity();
}

Sight LuxelRays::look(std::uint32_t place, int ray, int count, Scratch& scratch) const {
  const Luxel& luxel = tree_.luxels()[place];
  const glm::vec3 direction = direction_of(luxel, ray, count, shift_of(place));
  const float near = nearest_met(frame_, luxel);
  const auto hit = rays_.find_nearest(luxel.position_ws, direction, near,
                                      std::numeric_limits<float>::infinity(), luxel.triangle);
  if (!hit) return {};
  const std::uint32_t met = grids_.place_at(*hit, direction);
  if (met == kNoLuxel) return {hit->distance};
  return {hit->distance, met, tint_along(luxel, direction, near, hit->distance, scratch)};
}

glm::vec3 LuxelRays::transmittance(std::uint32_t from, std::uint32_t to, Scratch& scratch) const {
  const Luxel& start = tree_.luxels()[from];
  const glm::vec3 way = tree_.luxels()[to].position_ws - start.position_ws;
  const float length = glm::length(way);
  const float near = nearest_met(frame_, start);
  const float far = length - std::max(near, 1e-4F * length);  // short of the other luxel's triangle
  if (!(far > near)) return glm::vec3(1);
  const glm::vec3 direction = way / length;
  if (rays_.is_blocked(start.position_ws, direction, near, far, start.triangle)) return glm::vec3(0);
  return tint_along(start, direction, near, far, scratch);
}

glm::vec3 LuxelRays::tint_along(const Luxel& from, const glm::vec3& direction_ws, float near, float far,
                                Scratch& scratch) const {
  glm::vec3 tint(1);
  if (!has_panes()) return tint;
  scratch.panes.clear();
  rays_.find_panes(from.position_ws, direction_ws, near, far, from.triangle, scratch.panes);
  if (scratch.panes.empty()) return tint;
  scratch.crossings.clear();
  for (const trace::RayScene::Pane& pane : scratch.panes)
    scratch.crossings.push_back({0, pane.id, pane.b, pane.c});
  scratch.colors.resize(scratch.crossings.size());
  // The same numbers come from every instruction set.
  shadow::transmit_through_for(InstructionSet::scalar)(frame_, scratch.crossings, scratch.colors.data());
  for (const shadow::PaneColor& color : scratch.colors) tint *= glm::vec3(color.r, color.g, color.b);
  return tint;
}

}  // namespace laterna::bake
