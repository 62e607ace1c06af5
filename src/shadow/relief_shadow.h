// Shadows on surfaces with reliefs, whatever technique finds those of the rest.
#pragma once

#include <memory>

#include "frame/frame.h"
#include "laterna/instruction_set.h"
#include "light/light_plan.h"
#include "shadow/shadow_technique.h"

namespace laterna::shadow {

/// What finding the way of light into a relief needs to know.
struct ReliefLight {
  ReliefLight(const light::PlannedLight& planned, const raster::RasterView& camera);

  bool is_parallel;
  float position_ws[3];
  float to_light_ws[3];   ///< of parallel light
  bool stays_in_picture;  ///< the technique knows of nothing beyond the camera's picture
  // The camera, as RasterView has it.
  bool is_orthographic;
  float eye_ws[3], axis_ws[3], x_row[3], y_row[3], w_row[3], x_add, y_add, w_add;
  float direction_x[3], direction_y[3];
  float low_x, low_y, high_x, high_y;  // of the picture
};

/// Moves the samples, all of one surface, from its relief along their ways to the light to where these pass the plane of the
/// triangle: `entries`. Whatever else stands in the light's way stands before that, and the flat triangle, which is what maps
/// and trees of casters hold, stands in nobody's. Sets bits of `shaded` for those between which and there the relief is in the
/// way.
using FindReliefEntries = void (*)(const frame::Frame& frame, const frame::Surface& surface,
                                   const ReliefLight& light, const SurfaceSamples& samples,
                                   SurfaceSamples& entries, std::uint16_t* shaded);
FindReliefEntries find_relief_entries_for(InstructionSet set);

/// Asks a technique about where light enters reliefs, and finds which of their points lie in their own shadow.
class ShadowOnRelief final : public ShadowTechnique {
 public:
  ShadowOnRelief(std::unique_ptr<ShadowTechnique> technique, const light::PlannedLight& planned,
                 const frame::Frame& frame, const raster::RasterView& camera, InstructionSet set)
      : technique_(std::move(technique)),
        light_(planned, camera),
        frame_(frame),
        find_relief_entries_(find_relief_entries_for(set)) {}

  double find_arrival(const SurfaceSamples& samples, std::span<const std::uint16_t> wanted,
                      Arrival& arrival) const override;
  [[nodiscard]] DrawnForShadows drawn() const override { return technique_->drawn(); }

 private:
  double find_on_relief(const frame::Surface& surface, const SurfaceSamples& samples,
                        std::span<const std::uint16_t> wanted, Arrival& arrival) const;

  std::unique_ptr<ShadowTechnique> technique_;
  ReliefLight light_;
  const frame::Frame& frame_;
  FindReliefEntries find_relief_entries_;
};

}  // namespace laterna::shadow
