#include "scene/texture_transform.h"

#include <cmath>
#include <vector>

#include "base/elementary.h"

namespace laterna {
namespace {

// A number that was found by calculation, and those near it that someone may have typed.
std::vector<double> likely(double value) {
  std::vector<double> numbers = {value, static_cast<double>(static_cast<float>(value))};
  double unit = 1;
  for (int digits = 0; digits < 10; ++digits, unit *= 10) numbers.push_back(std::round(value * unit) / unit);
  return numbers;
}

// The scale along one axis of a rotation that gives two entries of the matrix.
std::optional<double> scale_for(double a, double b, float entry_a, float entry_b) {
  for (const double scale : likely(entry_a * a + entry_b * b)) {
    if (static_cast<float>(a * scale) == entry_a && static_cast<float>(b * scale) == entry_b) return scale;
  }
  return std::nullopt;
}

// With rows [c sx, s sy], [−s sx, c sy].
std::optional<TextureTransform> rotated(const std::array<float, 6>& m, double rotation) {
  const double c = cosine(rotation), s = sine(rotation);
  const std::optional<double> x = scale_for(c, -s, m[0], m[3]), y = scale_for(s, c, m[1], m[4]);
  if (!x || !y) return std::nullopt;
  return TextureTransform{{m[2], m[5]}, rotation, {*x, *y}};
}

}  // namespace

std::array<float, 6> composed(const TextureTransform& transform) {
  // The direction of rotation is what the extension's implementations agree on.
  const double c = cosine(transform.rotation), s = sine(transform.rotation);
  const glm::dvec2 scale = transform.scale, offset = transform.offset;
  const double rows[6] = {c * scale.x, s * scale.y, offset.x, -s * scale.x, c * scale.y, offset.y};
  std::array<float, 6> matrix{};
  for (std::size_t i = 0; i < 6; ++i) matrix[i] = static_cast<float>(rows[i]);
  return matrix;
}

std::optional<TextureTransform> decomposed(const std::array<float, 6>& m) {
  if (m[1] == 0 && m[3] == 0) return TextureTransform{{m[2], m[5]}, 0, {m[0], m[4]}};
  // Both columns say the angle; the longer one more exactly, and either may be turned round by a negative scale.
  const double by_x = arctangent2(-static_cast<double>(m[3]), m[0]), by_y = arctangent2(m[1], m[4]);
  for (const double near : {by_x, by_y, (by_x + by_y) / 2}) {
    for (const double rotation : likely(near)) {
      if (const auto found = rotated(m, rotation)) return found;
    }
  }
  const double c = cosine(by_x), s = sine(by_x);
  TextureTransform nearest{{m[2], m[5]}, by_x, {m[0] * c - m[3] * s, m[1] * s + m[4] * c}};
  const std::array<float, 6> made = composed(nearest);
  constexpr double kRounding = 1e-6;
  const double size = std::abs(nearest.scale.x) + std::abs(nearest.scale.y);
  for (std::size_t i = 0; i < 6; ++i) {
    if (std::abs(static_cast<double>(made[i]) - m[i]) > kRounding * size && i % 3 != 2) return std::nullopt;
  }
  return nearest;
}

}  // namespace laterna
