// Light through blended surfaces: stained glass, slides held in the beam, foliage with soft edges.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "frame/frame.h"
#include "shadow/shadow_technique.h"

namespace laterna::shadow {

/// Where the way from a sample to the light meets a blended triangle: weights b and c of its second and third corner.
struct PaneCrossing {
  std::uint32_t sample;  // index in SurfaceSamples
  TriangleId id;
  float b, c;
};

/// What a surface with this base colour and alpha lets through, channel by channel: 1 − alpha (1 − color). A pane that
/// covers to the share alpha, and where it covers passes its own colour (McGuire and Enderton, Colored stochastic shadow
/// maps, 2011, with the base colour as transmission). Alpha 1 lets nothing through: what is drawn as opaque casts a
/// shadow as what is opaque. Of surfaces with transmission (KHR_materials_transmission), see docs/materials.md.
struct PaneColor {
  float r, g, b;
};
/// Of each crossing, from the base colour at full texture size. Which instruction set does it cannot be seen.
using TransmitThrough = void (*)(const frame::Frame& frame, std::span<const PaneCrossing> crossings,
                                 PaneColor* colors);
TransmitThrough transmit_through_for(InstructionSet set);

/// Finds panes between samples and a light. Const calls may come from several threads at once.
class PaneFinder {
 public:
  virtual ~PaneFinder() = default;
  /// Appends the crossings of the `wanted` samples, in any order.
  virtual void find(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                    std::vector<PaneCrossing>& crossings) const = 0;
};

/// Any technique for what is opaque, and the product of all panes for what comes through.
class ShadowThroughPanes final : public ShadowTechnique {
 public:
  ShadowThroughPanes(std::unique_ptr<ShadowTechnique> opaque, std::unique_ptr<PaneFinder> panes,
                     const frame::Frame& frame, InstructionSet set)
      : opaque_(std::move(opaque)), panes_(std::move(panes)), frame_(frame), set_(set) {}
  double find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                      Arrival& arrival) const override;
  [[nodiscard]] DrawnForShadows drawn() const override { return opaque_->drawn(); }

 private:
  std::unique_ptr<ShadowTechnique> opaque_;
  std::unique_ptr<PaneFinder> panes_;
  const frame::Frame& frame_;
  InstructionSet set_;
};

}  // namespace laterna::shadow
