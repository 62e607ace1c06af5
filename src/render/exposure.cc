#include <algorithm>
#include <cmath>
#include <vector>

#include "base/elementary.h"
#include "image/luminance.h"
#include "laterna/render.h"

namespace laterna {

float automatic_exposure(const LayeredImage& image) {
  const Channel* r = image.find("R");
  const Channel* g = image.find("G");
  const Channel* b = image.find("B");
  const Channel* a = image.find("A");
  if (r == nullptr || g == nullptr || b == nullptr) return 1;
  const std::size_t pixels = r->values.size();
  if (g->values.size() != pixels || b->values.size() != pixels ||
      (a != nullptr && a->values.size() != pixels))
    return 1;
  constexpr double kMiddleGrey = 0.18;
  constexpr double kLeast = 1e-6;  // keeps black from deciding the mean
  // Share of the picture. In a dark room the mean is that of the dark, and what is lit would be lost.
  constexpr double kMayBeWhite = 0.01;
  double sum = 0;
  std::vector<float> brightest;
  for (std::size_t i = 0; i < pixels; ++i) {
    if (a != nullptr && a->values[i] <= 0) continue;
    const double luminance = image::luminance<double>(r->values[i], g->values[i], b->values[i]);
    if (!std::isfinite(luminance)) continue;
    sum += logarithm2(kLeast + std::max(luminance, 0.0));
    brightest.push_back(std::max({r->values[i], g->values[i], b->values[i]}));
  }
  if (brightest.empty()) return 1;
  const double mean = exponential2(sum / static_cast<double>(brightest.size()));
  if (mean <= 2 * kLeast) return 1;
  const auto white = brightest.begin() + static_cast<std::ptrdiff_t>(
                                             (1 - kMayBeWhite) * static_cast<double>(brightest.size() - 1));
  std::nth_element(brightest.begin(), white, brightest.end());
  return static_cast<float>(std::min(kMiddleGrey / mean, 1 / static_cast<double>(*white)));
}

float exposure_from_stops(double stops) { return static_cast<float>(exponential2(stops)); }

}  // namespace laterna
