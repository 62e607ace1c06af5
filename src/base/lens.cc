#include "laterna/lens.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <vector>

#include "base/camera_distortion.h"
#include "base/elementary.h"

namespace laterna {
namespace {

// Places along each side of a frame at which it is tried whether a lens throws it.
constexpr int kPlacesPerSide = 64;

// Coefficient i belongs to x^i.
using Polynomial = std::vector<double>;

Polynomial without_leading_zeros(Polynomial p) {
  while (p.size() > 1 && p.back() == 0) p.pop_back();
  return p;
}

double value(const Polynomial& p, double x) {
  double sum = 0;
  for (std::size_t i = p.size(); i-- > 0;) sum = sum * x + p[i];
  return sum;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial d;
  for (std::size_t i = 1; i < p.size(); ++i) d.push_back(static_cast<double>(i) * p[i]);
  return d;
}

// Where the polynomial changes its sign in (low, high): between the roots of its derivative it is monotone.
std::vector<double> sign_changes(const Polynomial& p, double low, double high) {
  if (p.size() < 2) return {};
  std::vector<double> ends = sign_changes(derivative(p), low, high);
  ends.push_back(high);
  std::vector<double> found;
  for (const double end : ends) {
    double a = low, b = end;
    low = end;
    const bool is_negative = value(p, a) < 0;
    if ((value(p, b) < 0) == is_negative) continue;
    for (double middle = (a + b) / 2; middle > a && middle < b; middle = (a + b) / 2)
      ((value(p, middle) < 0) == is_negative ? a : b) = middle;
    found.push_back(b);
  }
  return found;
}

// The same lens in the longer formula, whose denominator is 1.
CameraDistortion camera_distortion(const LensDistortion& l) {
  return {{l.k1, l.k2, l.k3, 0, 0, 0}, {l.p1, l.p2}};
}

// Newton's method, held within the field, each step halved until it brings `place` nearer. Whether it was reached.
bool approach(const LensDistortion& lens, double field, glm::dvec2 place, glm::dvec2& direction) {
  constexpr double kExact = 1e-13;
  constexpr int kMostSteps = 60, kMostHalvings = 40;
  glm::dvec2 missing = place - distorted(lens, direction);
  for (int step = 0; step < kMostSteps; ++step) {
    if (glm::length(missing) <= kExact * (1 + glm::length(place))) return true;
    const glm::dmat2 slope = distorted_by(lens, direction);
    const double determinant = slope[0][0] * slope[1][1] - slope[1][0] * slope[0][1];
    if (!(determinant > 0)) return false;
    glm::dvec2 move = glm::dvec2(slope[1][1] * missing.x - slope[1][0] * missing.y,
                                 slope[0][0] * missing.y - slope[0][1] * missing.x) /
                      determinant;
    bool is_nearer = false;
    for (int halving = 0; halving < kMostHalvings && !is_nearer; ++halving, move *= 0.5) {
      const glm::dvec2 next = direction + move;
      if (glm::length(next) > field) continue;
      const glm::dvec2 left = place - distorted(lens, next);
      is_nearer = glm::length(left) < glm::length(missing);
      if (!is_nearer) continue;
      direction = next;
      missing = left;
    }
    // Within rounding of the place, no step brings it nearer.
    if (!is_nearer) return glm::length(missing) <= 1e-11 * (1 + glm::length(place));
  }
  return false;
}

// `undistorted` for a lens whose field is known.
std::optional<glm::dvec2> undistorted_within(const LensDistortion& lens, double field, glm::dvec2 place) {
  if (!std::isfinite(place.x) || !std::isfinite(place.y)) return std::nullopt;
  const double distance = glm::length(place);
  glm::dvec2 direction = distance > field ? place * (field / distance) : place;
  if (approach(lens, field, place, direction)) return direction;
  // Lenses that bend much: from the axis outward, so that Newton's method always starts near by.
  constexpr int kStages = 8;
  direction = glm::dvec2(0);
  for (int stage = 1; stage <= kStages; ++stage) {
    if (!approach(lens, field, place * (stage / double{kStages}), direction)) return std::nullopt;
  }
  return direction;
}

std::string fold_message(double field, glm::dvec2 slide) {
  return fmt::format(
      "cannot be inverted: it folds back {:.4g} degrees off the lens axis (tangent {:.4g}), so that the "
      "slide's point ({:.3g}, {:.3g}), from its top-left corner, is thrown nowhere",
      Angle::radians(arctangent(field)).in_degrees(), field, slide.x, slide.y);
}

}  // namespace

glm::dvec2 distorted(const LensDistortion& l, glm::dvec2 p) { return distorted(camera_distortion(l), p); }

glm::dmat2 distorted_by(const LensDistortion& l, glm::dvec2 p) {
  const double r2 = glm::dot(p, p);
  const double f = radial_factor(camera_distortion(l), r2),
               slope = 2 * (l.k1 + r2 * (2 * l.k2 + r2 * 3 * l.k3));
  const double xx = f + slope * p.x * p.x + 2 * l.p1 * p.y + 6 * l.p2 * p.x;
  const double yy = f + slope * p.y * p.y + 6 * l.p1 * p.y + 2 * l.p2 * p.x;
  const double xy = slope * p.x * p.y + 2 * l.p1 * p.x + 2 * l.p2 * p.y;
  return {xx, xy, xy, yy};
}

// A map whose Jacobian is symmetric and positive definite all over a disc is one to one there. Without tangential terms
// the Jacobian's eigenvalues are (r f)' along the radius and f across it; q = (p2, p1) adds
// 2 (q pᵀ + p qᵀ) + 2 (q·p), which lowers either by at most 6 |q| r, and the first by just that where p is against q.
double lens_field(const LensDistortion& l) {
  const double tangential = -6 * std::sqrt(l.p1 * l.p1 + l.p2 * l.p2);
  double field = kWidestLensField;
  for (const Polynomial& eigenvalue : {Polynomial{1, tangential, 3 * l.k1, 0, 5 * l.k2, 0, 7 * l.k3},
                                       Polynomial{1, tangential, l.k1, 0, l.k2, 0, l.k3}}) {
    const std::vector<double> folds = sign_changes(without_leading_zeros(eigenvalue), 0, field);
    if (!folds.empty()) field = std::min(field, folds.front());
  }
  return field;
}

std::optional<glm::dvec2> undistorted(const LensDistortion& lens, glm::dvec2 place) {
  return undistorted_within(lens, lens_field(lens), place);
}

std::string find_fault(const LensDistortion& lens, const Projection& frame) {
  for (const double coefficient : {lens.k1, lens.k2, lens.p1, lens.p2, lens.k3}) {
    if (!(std::abs(coefficient) <= kMaxDistortion)) {
      return fmt::format("expected finite coefficients of at most {:g}, got {:g}", kMaxDistortion,
                         coefficient);
    }
  }
  if (lens.is_none()) return {};
  if (frame.is_orthographic) return "only a perspective frame has a lens that distorts";
  const double field = lens_field(lens);
  // What is one to one throws a frame whole if it throws its sides. Corners first: they are the farthest.
  for (const int step : {0, 1}) {
    for (int i = 0; i < kPlacesPerSide; i += step == 0 ? kPlacesPerSide : 1) {
      const double t = i / double{kPlacesPerSide};
      for (const glm::dvec2 slide :
           {glm::dvec2(t, 0), glm::dvec2(1, t), glm::dvec2(1 - t, 1), glm::dvec2(0, 1 - t)}) {
        const glm::dvec2 place(frame.left + slide.x * (frame.right - frame.left),
                               -frame.top + slide.y * (frame.top - frame.bottom));
        if (!undistorted_within(lens, field, place)) return fold_message(field, slide);
      }
    }
  }
  return {};
}

}  // namespace laterna
