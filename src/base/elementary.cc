#include "base/elementary.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace laterna {
namespace {

// π/2 in three parts; the first two have trailing zero bits, so that quarter_turns · part is exact up to 2^20 turns
// (Cody and Waite, Software Manual for the Elementary Functions, 1980).
constexpr double kHalfPiHigh = 0x1.921fb544p+0;
constexpr double kHalfPiMiddle = 0x1.0b4611a4p-34;
constexpr double kHalfPiLow = 0x1.3198a2e037073p-69;

struct Reduced {
  double angle;  // in [−π/4, π/4]
  int quadrant;  // 0…3
};

Reduced reduce(double radians) {
  const double turns = std::nearbyint(radians * (2.0 / kPi));
  const double angle = ((radians - turns * kHalfPiHigh) - turns * kHalfPiMiddle) - turns * kHalfPiLow;
  return {angle, static_cast<int>(static_cast<std::int64_t>(turns) & 3)};
}

// Maclaurin series; at π/4 the first term left out is below 1e-19.
double sine_kernel(double x) {
  const double z = x * x;
  double sum = 0;
  for (int n = 19; n >= 3; n -= 2) sum = (1.0 + sum) * -z / (n * (n - 1.0));
  return x + x * sum;
}

double cosine_kernel(double x) {
  const double z = x * x;
  double sum = 0;
  for (int n = 20; n >= 2; n -= 2) sum = (1.0 + sum) * -z / (n * (n - 1.0));
  return 1.0 + sum;
}

constexpr double kLn2 = 0.69314718055994530942;

}  // namespace

double sine(double radians) {
  const Reduced r = reduce(radians);
  const double value = (r.quadrant & 1) != 0 ? cosine_kernel(r.angle) : sine_kernel(r.angle);
  return (r.quadrant & 2) != 0 ? -value : value;
}

double cosine(double radians) {
  const Reduced r = reduce(radians);
  const double value = (r.quadrant & 1) != 0 ? sine_kernel(r.angle) : cosine_kernel(r.angle);
  return r.quadrant == 1 || r.quadrant == 2 ? -value : value;
}

double tangent(double radians) { return sine(radians) / cosine(radians); }

double arctangent(double x) {
  if (x < 0) return -arctangent(-x);
  if (x > 1) return kPi / 2 - arctangent(1 / x);
  // atan x = 2 atan(x / (1 + √(1 + x²))), twice: the argument falls below tan(π/16) = 0.199.
  double t = x;
  for (int i = 0; i < 2; ++i) t = t / (1 + std::sqrt(1 + t * t));
  const double z = t * t;
  double sum = 0;
  for (int n = 25; n >= 3; n -= 2) sum = -z * (1.0 / n + sum);
  return 4 * (t + t * sum);
}

double arctangent2(double y, double x) {
  if (x == 0 && y == 0) return 0;
  if (std::abs(y) > std::abs(x)) {
    const double angle = kPi / 2 - arctangent(x / std::abs(y));
    return y < 0 ? -angle : angle;
  }
  const double angle = arctangent(y / x);
  if (x > 0) return angle;
  return y < 0 ? angle - kPi : angle + kPi;
}

double arcsine(double x) { return arctangent2(x, std::sqrt((1 - x) * (1 + x))); }
double arccosine(double x) { return arctangent2(std::sqrt((1 - x) * (1 + x)), x); }

double exponential2(double x) {
  if (x != x) return x;
  if (x >= 1024) return std::numeric_limits<double>::infinity();
  if (x < -1075) return 0;
  const double whole = std::nearbyint(x);
  const double y = (x - whole) * kLn2;  // |y| ≤ 0.35
  double sum = 0;
  for (int n = 16; n >= 1; --n) sum = (1.0 + sum) * y / n;
  return std::ldexp(1.0 + sum, static_cast<int>(whole));
}

double logarithm2(double x) {
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);  // in [0.5, 1)
  if (mantissa < 0.70710678118654752440) {
    mantissa *= 2;
    --exponent;
  }
  // ln m = 2 atanh((m − 1) / (m + 1)); the argument is below 0.1716.
  const double t = (mantissa - 1) / (mantissa + 1);
  const double z = t * t;
  double sum = 0;
  for (int n = 25; n >= 3; n -= 2) sum = z * (1.0 / n + sum);
  return exponent + 2 / kLn2 * (t + t * sum);
}

double power(double base, double exponent) {
  if (exponent == 0) return 1;
  if (base == 0) return exponent > 0 ? 0 : std::numeric_limits<double>::infinity();
  return exponential2(exponent * logarithm2(base));
}

double linear_from_srgb(double encoded) {
  if (encoded <= 0.04045) return encoded / 12.92;
  return power((encoded + 0.055) / 1.055, 2.4);
}

double srgb_from_linear(double linear) {
  if (linear <= 0.0031308) return linear * 12.92;
  return 1.055 * power(linear, 1 / 2.4) - 0.055;
}

}  // namespace laterna
