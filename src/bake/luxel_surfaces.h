// What surfaces do with light at luxels: as the shading of pictures finds it, layers and painted slides with it.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bake/luxel_receivers.h"
#include "frame/frame.h"
#include "light/light_plan.h"
#include "trace/ray_scene.h"

namespace laterna::bake {

struct MattSurface {
  glm::vec3 reflectance{
      0};  ///< of diffuse light, 0 … 1 per channel: base colour under its layers, without what is metal
  glm::vec3 exitance{0};   ///< what it gives off by itself, π times its radiance
  glm::vec3 normal_ws{0};  ///< unit, with normal maps, on the side that is asked for
  /// What the material's own occlusion texture leaves of light from all sides; unset: it has none.
  std::optional<float> openness;
};

/// Receivers are looked at squarely enough from one of six sides, along the world's axes, in pictures whose pixels are about
/// as large as what they stand for: so textures and slides are read as finely as can be shown. Reliefs are as flat as light
/// maps have them.
class LuxelSurfaces {
 public:
  /// `receiver_side`: metres of the square that a receiver stands for. The frame must outlive this, and `rays` be made of it.
  LuxelSurfaces(const frame::Frame& frame, const std::shared_ptr<const trace::RayScene>& rays,
                double receiver_side, InstructionSet set);
  ~LuxelSurfaces();
  LuxelSurfaces(const LuxelSurfaces&) = delete;
  LuxelSurfaces& operator=(const LuxelSurfaces&) = delete;

  /// One for each receiver, on its front or on its back; black for those on no triangle. Calls may come from several threads at once.
  [[nodiscard]] std::vector<MattSurface> find(std::span<const Receiver> receivers, bool of_back) const;

 private:
  class Side;
  class Batch;

  const frame::Frame& frame_;
  InstructionSet set_;
  std::vector<light::PlannedLight> decals_;
  std::array<std::unique_ptr<const Side>, 6> sides_;  // +X −X +Y −Y +Z −Z
};

}  // namespace laterna::bake
