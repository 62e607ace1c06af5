#include "light/light_samples.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/elementary.h"

namespace laterna::light {
namespace {

constexpr double kGoldenRatio = 0.61803398874989484820;

double fraction(double x) { return x - std::floor(x); }

// A number in (0, 1), one in each of `count` equal fields.
double field_centre(int i, int count) { return (i + 0.5) / count; }

// Another number in (0, 1), to go with the field.
double second_number(SampleIndex sample) { return sample_number(sample, SampleDimension::source); }

// From the middle, in units of the sides.
glm::dvec2 in_rectangle(const LightSource& source, SampleIndex sample) {
  const double first = field_centre(sample_field(sample), sample.count) - 0.5;
  const double second = second_number(sample) - 0.5;
  if (source.width == 0) return {0, first};  // a strip
  if (source.height == 0) return {first, 0};
  return {first, second};
}

glm::dvec2 turned(double radius, int i) {
  const double angle = 2 * kPi * fraction(i * kGoldenRatio);
  return {radius * cosine(angle), radius * sine(angle)};
}

// Vogel, A better way to construct the sunflower head, 1979: evenly over the unit disc.
glm::dvec2 in_disc(SampleIndex sample) {
  const int i = sample_field(sample);
  return turned(std::sqrt(field_centre(i, sample.count)), i);
}

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

glm::dvec3 in_ball(SampleIndex sample) {
  const int i = sample_field(sample);
  const double z = 1 - 2 * field_centre(i, sample.count);
  const glm::dvec2 around = turned(std::sqrt(std::max(0.0, 1 - z * z)), i);
  return ball_radius(second_number(sample)) * glm::dvec3(around, z);
}

// From the middle, metres.
glm::dvec3 offset_ws(const LightSource& source, const Pose& pose, SampleIndex sample) {
  if (source.radius > 0) return source.radius * in_ball(sample);
  const glm::dvec2 at = in_rectangle(source, sample);
  return at.x * source.width * pose.right_ws() + at.y * source.height * pose.up_ws();
}

// Light from another point of the disc in the sky.
void turn(Pose& pose, const LightSource& source, SampleIndex sample) {
  const glm::dvec2 at = tangent(0.5 * source.angular_diameter.in_radians()) * in_disc(sample);
  const glm::dvec3 forward = pose.forward_ws() + at.x * pose.right_ws() + at.y * pose.up_ws();
  pose.world_from_view_rotation = Pose::look_at({0, 0, 0}, forward, pose.up_ws())->world_from_view_rotation;
}

// To another point of the lens. What is at tangent t from the middle of the lens on the plane at the focal distance f is
// at t − offset / f from there, and all points throw the slide onto that plane alike.
void shear(frame::PlacedLight& placed, const Aperture& aperture, SampleIndex sample) {
  const glm::dvec2 offset = aperture.radius * in_disc(sample);
  placed.pose.position_ws += offset.x * placed.pose.right_ws() + offset.y * placed.pose.up_ws();
  const glm::dvec2 shift = offset / aperture.focal_distance;
  Projection& p = placed.view.projection;
  p.left -= shift.x;
  p.right -= shift.x;
  p.bottom -= shift.y;
  p.top -= shift.y;
}

}  // namespace

bool has_samples(const Light& light) { return light.source.has_size() || light.aperture.radius > 0; }

frame::PlacedLight at_sample(const frame::PlacedLight& placed, SampleIndex sample) {
  const Light& light = *placed.light;
  frame::PlacedLight moved = placed;
  if (!has_samples(light) || sample.count == 1) return moved;
  if (light.aperture.radius > 0) {
    shear(moved, light.aperture, sample);
  } else if (light.type == LightType::directional) {
    turn(moved.pose, light.source, sample);
  } else {
    moved.pose.position_ws += offset_ws(light.source, placed.pose, sample);
  }
  moved.view.pose = moved.pose;
  return moved;
}

}  // namespace laterna::light
