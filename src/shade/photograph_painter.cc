#include "shade/photograph_painter.h"

#include <algorithm>

namespace laterna::shade {

using shadow::kGroupSize;
using shadow::kMaxGroups;

namespace {

// Takes from `seen` the samples of which less than half comes through.
void keep_visible(const shadow::Arrival& arrival, std::span<std::uint16_t> seen) {
  for (std::size_t group = 0; group < seen.size(); ++group) {
    for (unsigned mask = seen[group]; mask != 0; mask &= mask - 1) {
      const auto k = static_cast<unsigned>(__builtin_ctz(mask));
      if (arrival.alpha[group * kGroupSize + k] >= 0.5F) continue;
      seen[group] = static_cast<std::uint16_t>(seen[group] & ~(1U << k));
    }
  }
}

}  // namespace

PhotographPainter::PhotographPainter(const PhotographJob& job, bool keeps_colors, InstructionSet set)
    : job_(job),
      find_faced_(find_faced_for(set)),
      add_photograph_(add_photograph_for(set)),
      take_photographs_(take_photographs_for(set)),
      find_bounds_(find_bounds_for(set)),
      sums_(std::make_unique<PhotographSums>()),
      arrival_(std::make_unique<shadow::Arrival>()),
      colors_(keeps_colors ? job.photographs.size() : 1),
      keeps_colors_(keeps_colors) {}

double PhotographPainter::paint(const shadow::SurfaceSamples& samples, SurfacePoints& points) {
  for (shadow::SampleArray<float>* sum : {&sums_->r, &sums_->g, &sums_->b, &sums_->weight, &sums_->seen})
    sum->fill(0);
  const frame::Bounds bounds = find_bounds_(samples);
  double drawing_ms = 0;
  for (std::size_t p = 0; p < job_.photographs.size(); ++p) {
    const ShaderPhotograph& photograph = job_.photographs[p];
    PhotographColor& color = colors_[keeps_colors_ ? p : 0];
    if (keeps_colors_) color.weight.fill(0);
    if (!photograph.reach.touches(bounds)) continue;
    std::array<std::uint16_t, kMaxGroups> bits{};
    const std::span<std::uint16_t> seen = std::span(bits).first(samples.group_count);
    find_faced_(photograph.bound, samples, seen);
    const auto is_empty = [](std::span<const std::uint16_t> groups) {
      return std::all_of(groups.begin(), groups.end(), [](std::uint16_t g) { return g == 0; });
    };
    if (is_empty(seen)) continue;
    if (photograph.visibility != nullptr) {
      drawing_ms += photograph.visibility->find_arrival(samples, seen, *arrival_);
      keep_visible(*arrival_, seen);
      if (is_empty(seen)) continue;
    }
    add_photograph_(photograph.bound, samples, points, seen, *sums_, color);
  }
  take_photographs_(*sums_, job_.unseen, samples.group_count, points);
  return drawing_ms;
}

}  // namespace laterna::shade
