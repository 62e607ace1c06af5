// Elementary functions whose results do not depend on the machine. glibc picks variants of sin, pow and the like by
// the processor's features, and their last bits differ; everything that reaches a picture uses these instead.
// sqrt, +, −, ×, ÷ are exact in IEEE 754 and need no replacement. Relative error below 4e-16 unless stated.
#pragma once

namespace laterna {

inline constexpr double kPi = 3.14159265358979323846;

double sine(double radians);     ///< |radians| ≤ 1e5
double cosine(double radians);   ///< |radians| ≤ 1e5
double tangent(double radians);  ///< |radians| ≤ 1e5
double arctangent(double x);
double arctangent2(double y, double x);  ///< in (−π, π]
double arcsine(double x);                ///< x in [−1, 1]
double arccosine(double x);              ///< x in [−1, 1]
double exponential2(double x);           ///< 2^x, 0 below −1074, +inf above 1024
double logarithm2(double x);             ///< x > 0
/// base^exponent for base ≥ 0. power(0, e > 0) = 0, power(x, 0) = 1.
double power(double base, double exponent);

/// IEC 61966-2-1. Both accept any finite value; outside [0, 1] the curve continues.
double linear_from_srgb(double encoded);
double srgb_from_linear(double linear);

}  // namespace laterna
