#include "light/source_points.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "base/elementary.h"

namespace laterna::light {
namespace {

constexpr double kGoldenRatio = 0.61803398874989484820;

// Steps that spread points over a square: powers of the plastic number (Roberts, The unreasonable effectiveness of
// quasirandom sequences, 2018).
constexpr double kPlasticStep = 0.75487766624669276, kPlasticStepSquared = 0.56984029099805327;

double fraction(double x) { return x - std::floor(x); }

// All of 0 … count − 1, in an order in which the first few are spread over the whole.
int spread(SourcePoint point) {
  int step = std::max(1, static_cast<int>(kPlasticStepSquared * point.count));
  while (std::gcd(step, point.count) != 1) ++step;
  return static_cast<int>(static_cast<std::int64_t>(point.index) * step % point.count);
}

// A number in (0, 1), one in each of `count` equal fields.
double field_centre(int i, int count) { return (i + 0.5) / count; }

// Another number in (0, 1) for the point that is taken as number `index`.
double second_number(int index) { return fraction(0.5 + index * kPlasticStep); }

// From the middle, in units of the sides.
glm::dvec2 in_rectangle(const LightSource& source, SourcePoint point) {
  const double first = field_centre(spread(point), point.count) - 0.5;
  const double second = second_number(point.index) - 0.5;
  if (source.width == 0) return {0, first};  // a strip
  if (source.height == 0) return {first, 0};
  return {first, second};
}

glm::dvec2 turned(double radius, int i) {
  const double angle = 2 * kPi * fraction(i * kGoldenRatio);
  return {radius * cosine(angle), radius * sine(angle)};
}

// Vogel, A better way to construct the sunflower head, 1979: evenly over the unit disc.
glm::dvec2 in_disc(int i, int count) { return turned(std::sqrt(field_centre(i, count)), i); }

// A ball's points at radius r with density 1 / √(1 − r²) are projected to an even disc from every side (Abel's
// integral). The share of them within r is (2/π) (asin r − r √(1 − r²)).
double ball_radius(double share) {
  double low = 0, high = 1;
  for (int step = 0; step < 50; ++step) {
    const double r = 0.5 * (low + high);
    const double within = 2 / kPi * (arcsine(r) - r * std::sqrt(1 - r * r));
    (within < share ? low : high) = r;
  }
  return 0.5 * (low + high);
}

glm::dvec3 in_ball(SourcePoint point) {
  const int i = spread(point);
  const double z = 1 - 2 * field_centre(i, point.count);
  const glm::dvec2 around = turned(std::sqrt(std::max(0.0, 1 - z * z)), i);
  return ball_radius(second_number(point.index)) * glm::dvec3(around, z);
}

// From the middle, metres.
glm::dvec3 offset_ws(const LightSource& source, const Pose& pose, SourcePoint point) {
  if (source.radius > 0) return source.radius * in_ball(point);
  const glm::dvec2 at = in_rectangle(source, point);
  return at.x * source.width * pose.right_ws() + at.y * source.height * pose.up_ws();
}

// Light from another point of the disc in the sky.
void turn(Pose& pose, const LightSource& source, SourcePoint point) {
  const glm::dvec2 at =
      tangent(0.5 * source.angular_diameter.in_radians()) * in_disc(spread(point), point.count);
  const glm::dvec3 forward = pose.forward_ws() + at.x * pose.right_ws() + at.y * pose.up_ws();
  pose.world_from_view_rotation = Pose::look_at({0, 0, 0}, forward, pose.up_ws())->world_from_view_rotation;
}

}  // namespace

frame::PlacedLight at_source_point(const frame::PlacedLight& placed, SourcePoint point) {
  const LightSource& source = placed.light->source;
  frame::PlacedLight moved = placed;
  if (!source.has_size() || point.count == 1) return moved;
  if (placed.light->type == LightType::directional) {
    turn(moved.pose, source, point);
  } else {
    moved.pose.position_ws += offset_ws(source, placed.pose, point);
  }
  moved.view.pose = moved.pose;
  return moved;
}

}  // namespace laterna::light
