#include "frame/slide_lens.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "base/elementary.h"

namespace laterna::frame {
namespace {

// The sides of a thrown picture are curves: so many chords to a side, and of its size this much of a margin for what lies
// beyond them and for single precision.
constexpr int kChordsPerSide = 64;
constexpr double kMargin = 1e-3;

// The directions to which a frame's sides are thrown, all the way round. OpenCV's axes: y downward.
std::vector<glm::dvec2> thrown_sides(const LensDistortion& distortion, const Projection& frame) {
  const glm::dvec2 corners[] = {{frame.left, -frame.top},
                                {frame.right, -frame.top},
                                {frame.right, -frame.bottom},
                                {frame.left, -frame.bottom}};
  std::vector<glm::dvec2> sides;
  for (std::size_t i = 0; i < 4; ++i) {
    for (int k = 0; k < kChordsPerSide; ++k) {
      const glm::dvec2 place =
          glm::mix(corners[i], corners[(i + 1) % 4], static_cast<double>(k) / kChordsPerSide);
      sides.push_back(undistorted(distortion, place).value_or(place));
    }
  }
  return sides;
}

// Of the triangle between the axis and two directions, turned right-handed with y downward. Van Oosterom and Strackee,
// The solid angle of a plane triangle, 1983, equation 8.
double solid_angle_of(glm::dvec2 a, glm::dvec2 b) {
  const double along_a = std::sqrt(1 + glm::dot(a, a)), along_b = std::sqrt(1 + glm::dot(b, b));
  return 2 * arctangent2(a.x * b.y - a.y * b.x, along_a * along_b + along_a + along_b + 1 + glm::dot(a, b));
}

}  // namespace

SlideLens::SlideLens(const LensDistortion& of, const Projection& ideal)
    : distortion(of), frame(ideal), beam(ideal), field(lens_field(of)) {
  const std::vector<glm::dvec2> sides = thrown_sides(distortion, frame);
  glm::dvec2 low = sides.front(), high = low;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const glm::dvec2 a = sides[i], b = sides[(i + 1) % sides.size()];
    area += (a.x * b.y - a.y * b.x) / 2;
    solid_angle += solid_angle_of(a, b);
    low = glm::min(low, a);
    high = glm::max(high, a);
  }
  const glm::dvec2 margin = kMargin * (high - low);
  beam.left = low.x - margin.x;
  beam.right = high.x + margin.x;
  beam.bottom = -(high.y + margin.y);
  beam.top = -(low.y - margin.y);
}

std::optional<glm::dvec2> SlideLens::slide_from_beam(glm::dvec2 image) const {
  const glm::dvec2 direction(beam.left + image.x * (beam.right - beam.left),
                             -beam.top + image.y * (beam.top - beam.bottom));
  if (!(glm::dot(direction, direction) <= field * field)) return std::nullopt;
  const glm::dvec2 place = distorted(distortion, direction);
  return glm::dvec2((place.x - frame.left) / (frame.right - frame.left),
                    (place.y + frame.top) / (frame.top - frame.bottom));
}

}  // namespace laterna::frame
