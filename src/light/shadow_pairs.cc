#include "light/shadow_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

namespace laterna::light {
namespace {

// Outlines that touch are told from those that overlap in spite of rounding.
constexpr double kTouching = 1 - 1e-12;
// Spans along an axis are compared with as much to spare.
constexpr double kSlack = 1e-12;

void append_pairs(std::span<const SphereOutline> outlines, std::uint32_t a, std::uint32_t b,
                  std::vector<ShadowPair>& pairs) {
  if (outlines[a].lies_before(outlines[b])) {
    pairs.push_back({a, b, true});
  } else if (outlines[b].lies_before(outlines[a])) {
    pairs.push_back({b, a, true});
  } else {
    pairs.push_back({a, b, false});
    pairs.push_back({b, a, false});
  }
}

std::vector<SphereOutline> outlines_of(std::span<const BoundingSphere> spheres, const glm::dvec4& light) {
  std::vector<SphereOutline> outlines;
  outlines.reserve(spheres.size());
  for (const BoundingSphere& sphere : spheres) outlines.emplace_back(sphere, light);
  return outlines;
}

void sort_pairs(std::vector<ShadowPair>& pairs) {
  std::sort(pairs.begin(), pairs.end(), [](const ShadowPair& a, const ShadowPair& b) {
    return a.occluder != b.occluder ? a.occluder < b.occluder : a.receiver < b.receiver;
  });
}

// The axes in the order in which the outlines' middles vary along them, most first.
std::array<int, 3> widest_axes(std::span<const SphereOutline> outlines) {
  glm::dvec3 sum(0);
  glm::dvec3 squares(0);
  for (const SphereOutline& outline : outlines) {
    for (int k = 0; k < 3; ++k) {
      const SphereOutline::Span span = outline.along(k);
      const double middle = 0.5 * (span.low + span.high);
      sum[k] += middle;
      squares[k] += middle * middle;
    }
  }
  const glm::dvec3 variance = squares - sum * sum / static_cast<double>(outlines.size());
  std::array<int, 3> axes = {0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](int i, int j) { return variance[i] > variance[j]; });
  return axes;
}

using Spans = std::vector<SphereOutline::Span>;

Spans spans_along(std::span<const SphereOutline> outlines, int axis) {
  Spans spans;
  spans.reserve(outlines.size());
  for (const SphereOutline& outline : outlines) spans.push_back(outline.along(axis));
  return spans;
}

// An axis cut into bands of equal width, as many as the root of what lies along it.
class Bands {
 public:
  explicit Bands(const Spans& spans)
      : count_(std::max<std::size_t>(1, static_cast<std::size_t>(std::sqrt(spans.size())))) {
    double high = spans[0].high;
    low_ = spans[0].low;
    for (const SphereOutline::Span& span : spans) {
      low_ = std::min(low_, span.low);
      high = std::max(high, span.high);
    }
    per_unit_ = high > low_ ? static_cast<double>(count_) / (high - low_) : 0;
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t band_of(double at) const {
    return std::min(static_cast<std::size_t>((at - low_) * per_unit_), count_ - 1);
  }

 private:
  std::size_t count_;
  double low_ = 0, per_unit_ = 0;
};

}  // namespace

SphereOutline::SphereOutline(const BoundingSphere& sphere, const glm::dvec4& light)
    : is_parallel_(light.w == 0), radius_(sphere.radius) {
  const glm::dvec3 toward(light);
  if (is_parallel_) {
    const glm::dvec3 normal = glm::normalize(toward);
    const double height = glm::dot(sphere.centre, normal);
    middle_ = sphere.centre - normal * height;
    // Signed distance grows toward the light; distance from it the other way.
    nearest_ = -height - radius_;
    farthest_ = -height + radius_;
    return;
  }
  const glm::dvec3 from_light = sphere.centre - toward / light.w;
  const double distance = glm::length(from_light);
  nearest_ = distance - radius_;
  farthest_ = distance + radius_;
  holds_light_ = distance <= radius_;
  if (holds_light_) return;
  middle_ = from_light / distance;
  sine_ = radius_ / distance;
  cosine_ = std::sqrt((1 - sine_) * (1 + sine_));
  half_cosine_ = std::sqrt(0.5 * (1 + cosine_));
  half_sine_ = 0.5 * sine_ / half_cosine_;
}

// Of angles φ < θ1 + θ2 are compared by their chords 2 sin(φ/2), which are precise for small angles as well.
bool SphereOutline::overlaps(const SphereOutline& other) const {
  if (holds_light_ || other.holds_light_) return true;
  const double apart = glm::distance(middle_, other.middle_);
  const double reach = is_parallel_ ? radius_ + other.radius_
                                    : 2 * (half_sine_ * other.half_cosine_ + half_cosine_ * other.half_sine_);
  return apart < reach * kTouching;
}

SphereOutline::Span SphereOutline::along(int axis) const {
  if (holds_light_) return {-1 - kSlack, 1 + kSlack};
  const double m = middle_[axis];
  if (is_parallel_) {
    const double slack = kSlack * (std::abs(m) + radius_);
    return {m - radius_ - slack, m + radius_ + slack};
  }
  // Of a cap of the unit sphere: cos(φ ± θ), or the pole where it lies in the cap.
  const double sine = std::sqrt(std::max(0.0, (1 - m) * (1 + m)));
  const double low = -m > cosine_ ? -1 : m * cosine_ - sine * sine_;
  const double high = m > cosine_ ? 1 : m * cosine_ + sine * sine_;
  return {low - kSlack, high + kSlack};
}

std::vector<ShadowPair> find_shadow_pairs(std::span<const BoundingSphere> spheres, const glm::dvec4& light) {
  const std::vector<SphereOutline> outlines = outlines_of(spheres, light);
  std::vector<ShadowPair> pairs;
  for (std::uint32_t a = 0; a < outlines.size(); ++a) {
    for (std::uint32_t b = a + 1; b < outlines.size(); ++b) {
      if (outlines[a].overlaps(outlines[b])) append_pairs(outlines, a, b, pairs);
    }
  }
  sort_pairs(pairs);
  return pairs;
}

std::vector<ShadowPair> sweep_shadow_pairs(std::span<const BoundingSphere> spheres, const glm::dvec4& light) {
  const std::vector<SphereOutline> outlines = outlines_of(spheres, light);
  if (outlines.empty()) return {};
  const std::array<int, 3> axes = widest_axes(outlines);
  const Spans spans = spans_along(outlines, axes[0]);
  const Spans across = spans_along(outlines, axes[1]);
  std::vector<std::uint32_t> order(outlines.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return spans[a].low != spans[b].low ? spans[a].low < spans[b].low : a < b;
  });
  const Bands bands(across);
  std::vector<std::vector<std::uint32_t>> open(bands.count());  // begun before, and not yet ended
  std::vector<ShadowPair> pairs;
  for (const std::uint32_t next : order) {
    const std::size_t first = bands.band_of(across[next].low);
    const std::size_t last = bands.band_of(across[next].high);
    for (std::size_t band = first; band <= last; ++band) {
      std::size_t kept = 0;
      for (const std::uint32_t other : open[band]) {
        if (spans[other].high < spans[next].low) continue;
        open[band][kept++] = other;
        // Two that share several bands are compared in the first.
        if (band != std::max(first, bands.band_of(across[other].low))) continue;
        if (outlines[other].overlaps(outlines[next]))
          append_pairs(outlines, std::min(other, next), std::max(other, next), pairs);
      }
      open[band].resize(kept);
      open[band].push_back(next);
    }
  }
  sort_pairs(pairs);
  return pairs;
}

}  // namespace laterna::light
