#include "laterna/light_color.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/elementary.h"
#include "image/luminance.h"

namespace laterna {
namespace {

// CIE 1931 standard colorimetric observer (ISO/CIE 11664-1), 380 to 780 nm in steps of 10 nm.
struct Observer {
  double x, y, z;
};
constexpr std::array<Observer, 41> kObserver = {{
    {0.001368, 0.000039, 0.006450}, {0.004243, 0.000120, 0.020050}, {0.014310, 0.000396, 0.067850},
    {0.043510, 0.001210, 0.207400}, {0.134380, 0.004000, 0.645600}, {0.283900, 0.011600, 1.385600},
    {0.348280, 0.023000, 1.747060}, {0.336200, 0.038000, 1.772110}, {0.290800, 0.060000, 1.669200},
    {0.195360, 0.090980, 1.287640}, {0.095640, 0.139020, 0.812950}, {0.032010, 0.208020, 0.465180},
    {0.004900, 0.323000, 0.272000}, {0.009300, 0.503000, 0.158200}, {0.063270, 0.710000, 0.078250},
    {0.165500, 0.862000, 0.042160}, {0.290400, 0.954000, 0.020300}, {0.433450, 0.994950, 0.008750},
    {0.594500, 0.995000, 0.003900}, {0.762100, 0.952000, 0.002100}, {0.916300, 0.870000, 0.001650},
    {1.026300, 0.757000, 0.001100}, {1.062200, 0.631000, 0.000800}, {1.002600, 0.503000, 0.000340},
    {0.854450, 0.381000, 0.000190}, {0.642400, 0.265000, 0.000050}, {0.447900, 0.175000, 0.000020},
    {0.283500, 0.107000, 0.000000}, {0.164900, 0.061000, 0.000000}, {0.087400, 0.032000, 0.000000},
    {0.046770, 0.017000, 0.000000}, {0.022700, 0.008210, 0.000000}, {0.011359, 0.004102, 0.000000},
    {0.005790, 0.002091, 0.000000}, {0.002899, 0.001047, 0.000000}, {0.001440, 0.000520, 0.000000},
    {0.000690, 0.000249, 0.000000}, {0.000332, 0.000120, 0.000000}, {0.000166, 0.000060, 0.000000},
    {0.000083, 0.000030, 0.000000}, {0.000042, 0.000015, 0.000000},
}};
constexpr double kFirstMicrometres = 0.38, kStepMicrometres = 0.01;

constexpr double kLogarithm2OfE = 1.44269504088896340736;
// hc/k in µm K (CODATA 2018, exact but for its decimals).
constexpr double kSecondRadiation = 14387.76877;

// Planck's law, but for a factor.
double radiance(double micrometres, double kelvin) {
  const double fifth = micrometres * micrometres * micrometres * micrometres * micrometres;
  const double exponent = kSecondRadiation / (micrometres * kelvin);
  return 1 / (fifth * (exponential2(exponent * kLogarithm2OfE) - 1));
}

glm::dvec3 xyz_of_temperature(double kelvin) {
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < kObserver.size(); ++i) {
    const double power = radiance(kFirstMicrometres + kStepMicrometres * static_cast<double>(i), kelvin);
    sum += power * glm::dvec3(kObserver[i].x, kObserver[i].y, kObserver[i].z);
  }
  return sum;
}

// From Rec. 709's primaries and D65 (x = 0.3127, y = 0.3290), as IEC 61966-2-1 gives it, to seven digits.
glm::dvec3 rec709_from_xyz(const glm::dvec3& v) {
  return {3.2404542 * v.x - 1.5371385 * v.y - 0.4985314 * v.z,
          -0.9692660 * v.x + 1.8760108 * v.y + 0.0415560 * v.z,
          0.0556434 * v.x - 0.2040259 * v.y + 1.0572252 * v.z};
}

glm::dvec3 linear_color(double kelvin) {
  glm::dvec3 color = rec709_from_xyz(xyz_of_temperature(std::clamp(kelvin, kLeastKelvin, kMostKelvin)));
  for (int i = 0; i < 3; ++i) color[i] = std::max(color[i], 0.0);
  // The weights of layer lux.
  return color / image::luminance(color.x, color.y, color.z);
}

// Conversions as Lee and Rosco print them on their swatches.
constexpr std::array<Gel, 11> kGels = {{
    {"full_ctb", "colour temperature blue: 3200 K becomes 5700 K", 3200, 5700, 0},
    {"half_ctb", "3200 K becomes 4300 K", 3200, 4300, 0},
    {"quarter_ctb", "3200 K becomes 3600 K", 3200, 3600, 0},
    {"full_cto", "colour temperature orange: 6500 K becomes 3200 K", 6500, 3200, 0},
    {"half_cto", "6500 K becomes 3800 K", 6500, 3800, 0},
    {"quarter_cto", "6500 K becomes 4600 K", 6500, 4600, 0},
    {"nd_0.15", "neutral density: passes 71 %, half a stop less", 0, 0, 0.15},
    {"nd_0.3", "passes 50 %, one stop less", 0, 0, 0.3},
    {"nd_0.6", "passes 25 %, two stops less", 0, 0, 0.6},
    {"nd_0.9", "passes 13 %, three stops less", 0, 0, 0.9},
    {"nd_1.2", "passes 6 %, four stops less", 0, 0, 1.2},
}};

}  // namespace

glm::vec3 color_of_temperature(double kelvin) { return {linear_color(kelvin)}; }

std::span<const Gel> list_gels() { return kGels; }

glm::vec3 transmission(const Gel& gel) {
  if (gel.from_kelvin == 0) return glm::vec3(static_cast<float>(power(10, -gel.density)));
  const glm::dvec3 ratio = linear_color(gel.to_kelvin) / linear_color(gel.from_kelvin);
  return {ratio / std::max({ratio.x, ratio.y, ratio.z})};
}

}  // namespace laterna
