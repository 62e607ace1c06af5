// Shadow volumes: Crow, Shadow algorithms for computer graphics, 1977; counted from infinity to the sample, so that the
// camera may stand in a volume: Bilodeau and Songy 1999, Carmack 2000; with ends at infinity and no far plane: Everitt
// and Kilgard, Practical and robust stenciled shadow volumes for hardware-accelerated rendering, 2002.
#pragma once

#include <memory>
#include <vector>

#include "light/light_plan.h"
#include "shadow/shadow_technique.h"
#include "shadow/volume_bins.h"

namespace laterna::shadow {

class ShadowVolume final : public ShadowTechnique {
 public:
  ShadowVolume(const light::PlannedLight& planned, const frame::Frame& frame,
               const raster::RasterView& camera, const TaskPool& pool, InstructionSet set);

  double find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                      Arrival& arrival) const override;

  [[nodiscard]] const VolumeSurface& surface() const { return surface_; }
  [[nodiscard]] std::size_t memory_bytes() const { return surface_.memory_bytes() + bins_.memory_bytes(); }

 private:
  class Counter;

  const frame::Frame& frame_;
  light::LightRays light_;
  VolumeSurface surface_;
  Eye eye_;
  VolumeBins bins_;
  InstructionSet instruction_set_;
};

/// Samples whose lines of sight pass through one tile. In double, as wide as what they are compared with.
struct VolumeSamples {
  SampleArray<double> direction_x{}, direction_y{}, direction_w{};  // EyeDirection
  SampleArray<double> x_ws{}, y_ws{}, z_ws{};
  SampleArray<double> count{};                    // of volumes around the sample
  std::array<std::uint16_t, kMaxGroups> asked{};  // a bit each
  std::array<std::uint64_t, kMaxGroups> cells{};  // of the tile, that a group's asked samples lie in
  std::uint64_t all_cells = 0;

  /// What a sample must be asked about one by one: a facet whose edge its line of sight passes too closely, or a prism that
  /// it lies in.
  struct Pending {
    std::uint32_t index;
    std::uint16_t sample;
    bool is_prism;
  };
  std::vector<Pending> pending;
};

/// Adds to `count` what the lines of sight cross beyond their samples in the tile.
using CountCrossings = void (*)(const VolumeBins& bins, int tile, VolumeSamples& samples);
CountCrossings count_crossings_for(InstructionSet set);

}  // namespace laterna::shadow
