#include "shadow/exact_shadow.h"

#include <algorithm>

namespace laterna::shadow {

ExactShadow::ExactShadow(const light::PlannedLight& planned, const frame::Frame& frame,
                         std::vector<std::shared_ptr<const CasterTree>> trees, InstructionSet set)
    : trees_(std::move(trees)), set_(set) {
  for (const auto& tree : trees_)
    tests_.push_back({&frame, tree.get(), light::LightRays(*planned.placed), planned.number});
}

double ExactShadow::find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                                 Arrival& arrival) const {
  arrival.is_tinted = false;
  std::array<std::uint16_t, kMaxGroups> lit{};
  std::copy(wanted.begin(), wanted.end(), lit.begin());
  // A sample is dark where any caster stands in its way, so each tree takes from what those before it left lit.
  for (const ExactShadowTest& test : tests_)
    keep_lit_for(set_)(test, samples, std::span(lit).first(samples.group_count));
  for (std::size_t i = 0; i < samples.group_count * kGroupSize; ++i) {
    arrival.alpha[i] = static_cast<float>(lit[i / kGroupSize] >> (i % kGroupSize) & 1U);
  }
  return 0;
}

ExactPanes::ExactPanes(const light::PlannedLight& planned, const frame::Frame& frame,
                       std::shared_ptr<const CasterTree> blended, InstructionSet set)
    : tree_(std::move(blended)),
      test_{&frame, tree_.get(), light::LightRays(*planned.placed), planned.number},
      set_(set) {}

void ExactPanes::find(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                      std::vector<PaneCrossing>& crossings) const {
  find_panes_for(set_)(test_, samples, wanted, crossings);
}

}  // namespace laterna::shadow
