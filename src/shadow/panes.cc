#include "shadow/panes.h"

#include <algorithm>
#include <array>

namespace laterna::shadow {
namespace {

// Samples to which some light comes past what is opaque.
std::array<std::uint16_t, kMaxGroups> find_lit(const SurfaceSamples& samples,
                                               std::span<const std::uint16_t> wanted,
                                               const Arrival& arrival) {
  std::array<std::uint16_t, kMaxGroups> lit{};
  for (std::size_t group = 0; group < samples.group_count; ++group) {
    for (std::size_t k = 0; k < kGroupSize; ++k) {
      const bool is_lit = (wanted[group] >> k & 1U) != 0 && arrival.alpha[group * kGroupSize + k] > 0;
      if (is_lit) lit[group] = static_cast<std::uint16_t>(lit[group] | 1U << k);
    }
  }
  return lit;
}

// Products of three roundings depend on their order, which must not depend on who found what first.
void sort_crossings(std::vector<PaneCrossing>& crossings) {
  std::sort(crossings.begin(), crossings.end(), [](const PaneCrossing& a, const PaneCrossing& b) {
    return a.sample != b.sample ? a.sample < b.sample : a.id < b.id;
  });
}

// Each channel its own.
void separate_channels(Arrival& arrival, std::size_t count) {
  if (arrival.is_tinted) return;
  arrival.is_tinted = true;
  for (SampleArray<float>* channel : {&arrival.r, &arrival.g, &arrival.b})
    std::copy_n(arrival.alpha.begin(), count, channel->begin());
}

}  // namespace

double ShadowThroughPanes::find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                                        Arrival& arrival) const {
  const double drawing_ms = opaque_->find_arrival(samples, wanted, arrival);
  std::vector<PaneCrossing> crossings;
  const auto lit = find_lit(samples, wanted, arrival);
  panes_->find(samples, std::span(lit).first(samples.group_count), crossings);
  if (crossings.empty()) return drawing_ms;
  sort_crossings(crossings);
  std::vector<PaneColor> colors(crossings.size());
  transmit_through_for(set_)(frame_, crossings, colors.data());
  separate_channels(arrival, samples.group_count * kGroupSize);
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    const std::size_t at = crossings[i].sample;
    arrival.r[at] *= colors[i].r;
    arrival.g[at] *= colors[i].g;
    arrival.b[at] *= colors[i].b;
    arrival.alpha[at] = (arrival.r[at] + arrival.g[at] + arrival.b[at]) * (1.0F / 3.0F);
  }
  return drawing_ms;
}

}  // namespace laterna::shadow
