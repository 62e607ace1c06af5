#include "reference/picture_probes.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace laterna::reference {

std::span<const float> values_of(const LayeredImage& image, const std::string& channel) {
  const Channel* found = image.find(channel);
  if (found == nullptr) throw std::runtime_error("no channel " + channel);
  return found->values;
}

std::span<const float> row_of(const LayeredImage& image, const std::string& channel, int y) {
  const auto width = static_cast<std::size_t>(image.width);
  return values_of(image, channel).subspan(static_cast<std::size_t>(y) * width, width);
}

std::vector<double> crossings(std::span<const float> values, double threshold) {
  std::vector<double> places;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    const double a = values[i] - threshold;
    const double b = values[i + 1] - threshold;
    if ((a < 0) == (b < 0)) continue;
    places.push_back(static_cast<double>(i) + 0.5 + a / (a - b));
  }
  return places;
}

double line_fit_residual(std::span<const glm::dvec2> points) {
  glm::dvec2 mean(0);
  for (const glm::dvec2 p : points) mean += p / static_cast<double>(points.size());
  double xx = 0;
  double xy = 0;
  double yy = 0;
  for (const glm::dvec2 p : points) {
    const glm::dvec2 d = p - mean;
    xx += d.x * d.x;
    xy += d.x * d.y;
    yy += d.y * d.y;
  }
  // The direction of largest variance; its normal measures the distance.
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  const glm::dvec2 normal(-std::sin(angle), std::cos(angle));
  double residual = 0;
  for (const glm::dvec2 p : points) residual = std::max(residual, std::abs(glm::dot(p - mean, normal)));
  return residual;
}

std::size_t count_different_pixels(const LayeredImage& a, const LayeredImage& b) {
  if (a.width != b.width || a.height != b.height) throw std::runtime_error("pictures of different sizes");
  std::vector<bool> differs(static_cast<std::size_t>(a.width) * static_cast<std::size_t>(a.height));
  for (const Channel& channel : a.channels) {
    const std::span<const float> other = values_of(b, channel.name);
    for (std::size_t i = 0; i < differs.size(); ++i) {
      if (std::bit_cast<std::uint32_t>(channel.values[i]) != std::bit_cast<std::uint32_t>(other[i]))
        differs[i] = true;
    }
  }
  std::size_t count = 0;
  for (const bool d : differs) count += d ? 1 : 0;
  return count;
}

double r_squared(std::span<const double> measured, std::span<const double> model) {
  double mean = 0;
  for (const double v : measured) mean += v / static_cast<double>(measured.size());
  double unexplained = 0;
  double all = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    unexplained += (measured[i] - model[i]) * (measured[i] - model[i]);
    all += (measured[i] - mean) * (measured[i] - mean);
  }
  return 1 - unexplained / all;
}

}  // namespace laterna::reference
