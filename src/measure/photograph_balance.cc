// Gains that make photographs agree where they overlap.
#include <algorithm>
#include <cmath>
#include <map>

#include "base/elementary.h"
#include "laterna/measure.h"

namespace laterna {
namespace {

// Each photograph's own view is drawn with this longest side: what it sees is where pairs are compared.
constexpr int kLongestSide = 192;
// Linear values between which a sensor is neither dark nor full.
constexpr float kDarkest = 0.004F, kBrightest = 0.9F;
// Fewer common samples say nothing about a pair.
constexpr std::size_t kFewestSamples = 24;
// Of the largest weight: keeps the gains' mean at 1, and nothing else.
constexpr double kPrior = 1e-9;
constexpr int kMostIterations = 2000;

// log2 of the first photograph's value over the second's, per channel.
using Ratios = std::array<std::vector<float>, 3>;
using Pairs = std::map<std::pair<std::size_t, std::size_t>, Ratios>;

struct Equation {
  std::size_t first, second;
  double log_ratio, weight;
};

void collect(const LayeredImage& image, const std::vector<Photograph>& photographs, std::size_t own,
             Pairs& pairs) {
  constexpr std::array<const char*, 3> kRgb = {".R", ".G", ".B"};
  for (std::size_t other = 0; other < photographs.size(); ++other) {
    if (other == own) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const Channel* a = image.find("photo.color." + photographs[own].name + kRgb[c]);
      const Channel* b = image.find("photo.color." + photographs[other].name + kRgb[c]);
      std::vector<float>* ratios = nullptr;
      for (std::size_t i = 0; i < a->values.size(); ++i) {
        const float x = a->values[i], y = b->values[i];
        // NaN, where one does not see the surface, fails.
        if (!(x > kDarkest && x < kBrightest && y > kDarkest && y < kBrightest)) continue;
        if (ratios == nullptr) ratios = &pairs[std::minmax(own, other)][c];
        const double ratio = logarithm2(static_cast<double>(x) / static_cast<double>(y));
        ratios->push_back(static_cast<float>(own < other ? ratio : -ratio));
      }
    }
  }
}

// The median: surfaces that are not where the mesh says, and what has moved, do not count.
std::vector<Equation> equations_of(Pairs& pairs, std::size_t channel) {
  std::vector<Equation> equations;
  for (auto& [pair, ratios] : pairs) {
    std::vector<float>& of_channel = ratios[channel];
    if (of_channel.size() < kFewestSamples) continue;
    const auto middle = of_channel.begin() + static_cast<std::ptrdiff_t>(of_channel.size() / 2);
    std::nth_element(of_channel.begin(), middle, of_channel.end());
    equations.push_back(
        {pair.first, pair.second, *middle, std::sqrt(static_cast<double>(of_channel.size()))});
  }
  return equations;
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

// The least squares of x_first − x_second + log_ratio, by conjugate gradients.
std::vector<double> solve(const std::vector<Equation>& equations, std::size_t count) {
  double largest = 0;
  for (const Equation& e : equations) largest = std::max(largest, e.weight);
  std::vector<double> x(count, 0.0), residual(count, 0.0);
  for (const Equation& e : equations) {
    residual[e.first] -= e.weight * e.log_ratio;
    residual[e.second] += e.weight * e.log_ratio;
  }
  const auto multiply = [&](const std::vector<double>& v) {
    std::vector<double> product(count);
    for (std::size_t i = 0; i < count; ++i) product[i] = kPrior * largest * v[i];
    for (const Equation& e : equations) {
      const double difference = e.weight * (v[e.first] - v[e.second]);
      product[e.first] += difference;
      product[e.second] -= difference;
    }
    return product;
  };
  std::vector<double> direction = residual;
  double error = dot(residual, residual);
  const double enough = error * 1e-20;
  for (int i = 0; i < kMostIterations && error > enough; ++i) {
    const std::vector<double> product = multiply(direction);
    const double step = error / dot(direction, product);
    for (std::size_t k = 0; k < count; ++k) {
      x[k] += step * direction[k];
      residual[k] -= step * product[k];
    }
    const double before = error;
    error = dot(residual, residual);
    for (std::size_t k = 0; k < count; ++k) direction[k] = residual[k] + error / before * direction[k];
  }
  return x;
}

}  // namespace

Result<std::vector<glm::vec3>> balance_photographs(const Renderer& renderer, const Progress& progress) {
  const std::vector<Photograph>& photographs = renderer.scene().photographs;
  Pairs pairs;
  for (std::size_t i = 0; i < photographs.size(); ++i) {
    const View view{photographs[i].pose, photographs[i].projection};
    RenderSettings settings;
    const double aspect = view.projection.aspect();
    settings.width = std::max(1, static_cast<int>(kLongestSide * std::min(1.0, aspect)));
    settings.height = std::max(1, static_cast<int>(kLongestSide * std::min(1.0, 1 / aspect)));
    settings.layers = {Layer::photographs};
    const Result<LayeredImage> image = renderer.render(view, settings);
    if (!image) return tl::unexpected(image.error());
    collect(*image, photographs, i, pairs);
    if (progress && !progress(static_cast<double>(i + 1) / static_cast<double>(photographs.size())))
      return tl::unexpected(Error(Failure::cancelled, Diagnostic{{}, {}, "cancelled"}));
  }
  std::vector<glm::vec3> gains(photographs.size(), glm::vec3(1));
  for (int channel = 0; channel < 3; ++channel) {
    const std::vector<double> x =
        solve(equations_of(pairs, static_cast<std::size_t>(channel)), photographs.size());
    for (std::size_t i = 0; i < x.size(); ++i)
      gains[i][channel] = static_cast<float>(exponential2(std::clamp(x[i], -10.0, 10.0)));
  }
  return gains;
}

}  // namespace laterna
