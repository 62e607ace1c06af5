// What a surface does with light at a luxel.
#pragma once

#include <glm/vec3.hpp>

#include "bake/luxel_receivers.h"
#include "frame/frame.h"

namespace laterna::bake {

struct MattSurface {
  glm::vec3 reflectance{0};  ///< of diffuse light, 0 … 1 per channel: base colour without what is metal
  glm::vec3 exitance{0};     ///< what it gives off by itself, π times its radiance
};

/// Textures are read at the level whose texels are about as large as a luxel of `luxel_side` metres.
MattSurface surface_at(const frame::Frame& frame, const Receiver& receiver, double luxel_side);

}  // namespace laterna::bake
