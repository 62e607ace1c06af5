// Light maps times colours: what any program shows of a surface that shines so.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "bake/baked_pages.h"
#include "bake/environment_irradiance.h"
#include "bake/luxel_receivers.h"
#include "bake/luxel_surfaces.h"
#include "frame/frame.h"

namespace laterna::bake {

struct SeenScene {
  const frame::Frame& frame;
  const trace::RayScene& rays;
  const LuxelSurfaces& surfaces;  ///< at the receivers of luxels
};

/// What falls on surfaces beside what their pages say, and how it is shown.
struct Showing {
  /// Both held back by pages' occlusion and by materials' occlusion textures.
  glm::vec3 ambient{0};                                ///< Scene::ambient
  const EnvironmentIrradiance* environment = nullptr;  ///< null: none
  ReceiverSettings receivers;                          ///< places in a luxel whose mean it shows
  float exposure = 0;  ///< factor on radiance; 0: automatic_exposure() of all luxels that are read
};

/// Puts in place of irradiance E, in every page, what is seen: reflectance · ((E + E of the environment) / π + ambient) + what
/// the surface gives off, times the exposure, in 8-bit sRGB. Returns the exposure. `triangles`: of each page.
float make_visible(const SeenScene& scene, std::span<const std::unique_ptr<PageTriangles>> triangles,
                   const Showing& showing, std::span<BakedPage> pages);

}  // namespace laterna::bake
