// Hard shadows without a map: every sample is held against the triangles that may stand between it and the light. No
// resolution, no bias.
#pragma once

#include <memory>
#include <vector>

#include "light/light_plan.h"
#include "shadow/caster_tree.h"
#include "shadow/exact_crossing.h"
#include "shadow/panes.h"
#include "shadow/shadow_technique.h"

namespace laterna::shadow {

struct ExactShadowTest {
  const frame::Frame* frame;
  const CasterTree* tree;
  light::LightRays light;
  std::uint32_t number;  ///< tells lights apart
};

/// Takes from `lit`, a bit for each sample by group, those that do not see the light. Which instruction set does it
/// cannot be seen.
using KeepLit = void (*)(const ExactShadowTest& test, const SurfaceSamples& samples,
                         std::span<std::uint16_t> lit);
KeepLit keep_lit_for(InstructionSet set);
/// Appends where the ways of the `wanted` samples to the light cross triangles of the tree, in any order.
using FindPanes = void (*)(const ExactShadowTest& test, const SurfaceSamples& samples,
                           std::span<const std::uint16_t> wanted, std::vector<PaneCrossing>& crossings);
FindPanes find_panes_for(InstructionSet set);

class ExactShadow final : public ShadowTechnique {
 public:
  /// `trees`: of casters that are in no other of them.
  ExactShadow(const light::PlannedLight& planned, const frame::Frame& frame,
              std::vector<std::shared_ptr<const CasterTree>> trees, InstructionSet set);
  double find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                      Arrival& arrival) const override;

 private:
  std::vector<std::shared_ptr<const CasterTree>> trees_;
  std::vector<ExactShadowTest> tests_;  // one for each tree
  InstructionSet set_;
};

/// The panes in the way, from a tree of blended casters.
class ExactPanes final : public PaneFinder {
 public:
  ExactPanes(const light::PlannedLight& planned, const frame::Frame& frame,
             std::shared_ptr<const CasterTree> blended, InstructionSet set);
  void find(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
            std::vector<PaneCrossing>& crossings) const override;

 private:
  std::shared_ptr<const CasterTree> tree_;
  ExactShadowTest test_;
  InstructionSet set_;
};

}  // namespace laterna::shadow
