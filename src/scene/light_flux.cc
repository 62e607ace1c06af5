#include "scene/light_flux.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"

namespace laterna {
namespace {

// Solid angle of the quarter frustum between the axis and the side tangents x and y (signed).
double quarter_solid_angle(double x, double y) { return arctangent(x * y / std::sqrt(1 + x * x + y * y)); }

}  // namespace

double solid_angle(const Projection& p) {
  return quarter_solid_angle(p.right, p.top) - quarter_solid_angle(p.left, p.top) -
         quarter_solid_angle(p.right, p.bottom) + quarter_solid_angle(p.left, p.bottom);
}

double solid_angle_of_spot(const Light& spot) {
  // Between the cones the term is the square of what rises evenly with the cosine: a third of it on average. It rises
  // over 0.001 where the cones lie closer (shade/illumination.cc).
  const double outer = cosine(spot.outer_cone.in_radians());
  const double rise = std::max(0.001, cosine(spot.inner_cone.in_radians()) - outer);
  // Very narrow cones end before the term has risen.
  const double within = std::min(rise, 1 - outer);
  const double share = within / rise;
  return 2 * kPi * (share * share * within / 3 + std::max(0.0, 1 - outer - rise));
}

double candela_from_lumens(double lumens, const Projection& p, BeamProfile profile) {
  const double area = (p.right - p.left) * (p.top - p.bottom);  // at 1 m
  if (p.is_orthographic) return lumens / area;                  // lux, at any distance
  return lumens / (profile == BeamProfile::flat_field ? area : solid_angle(p));
}

}  // namespace laterna
