// What surfaces reflect onto each other, added to light maps.
#pragma once

#include <memory>
#include <span>

#include "bake/luxel_receivers.h"
#include "bake/luxel_surfaces.h"
#include "bake/radiosity.h"
#include "laterna/image.h"

namespace laterna::bake {

/// A page whose pictures hold direct light. `back`: null where none of its surfaces is seen from behind.
struct LitPage {
  const PageTriangles* triangles = nullptr;
  Image* front = nullptr;
  Image* back = nullptr;
};

struct BouncedLight {
  int bounces = 0;         ///< that were worked out
  std::size_t luxels = 0;  ///< both sides of surfaces counted
};

/// Adds to every luxel what reaches it from others. `luxel_side`: metres. `parts`: as of interreflect(). Errors: interreflect()'s.
Result<BouncedLight> add_bounced_light(const frame::Frame& frame, const trace::RayScene& rays,
                                       std::span<const LitPage> pages, const LuxelSurfaces& surfaces,
                                       double luxel_side, const RadiositySettings& settings,
                                       const TaskPool& pool, const Progress& progress,
                                       const PartFiles& parts);

}  // namespace laterna::bake
