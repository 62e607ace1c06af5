// Light maps times colours: what any program shows of a surface that shines so.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "bake/baked_pages.h"
#include "bake/environment_irradiance.h"
#include "bake/luxel_receivers.h"
#include "bake/luxel_surfaces.h"
#include "base/task_pool.h"
#include "frame/frame.h"

namespace laterna::bake {

struct SeenScene {
  const frame::Frame& frame;
  const trace::RayScene& rays;
  const LuxelSurfaces& surfaces;  ///< at the receivers of luxels
  const TaskPool& pool;
};

/// What falls on surfaces beside what their pages say.
struct Showing {
  /// Both held back by materials' occlusion textures; by pages' occlusion where there is none.
  glm::vec3 ambient{0};                                ///< Scene::ambient
  const EnvironmentIrradiance* environment = nullptr;  ///< null: none
  ReceiverSettings receivers;                          ///< places in a luxel whose mean it shows
};

/// Puts in place of irradiance E, in every page, what is seen: reflectance · ((E + E of the environment) / π + ambient) + what
/// the surface gives off. `triangles`: of each page.
void show_surfaces(const SeenScene& scene, std::span<const std::unique_ptr<PageTriangles>> triangles,
                   const Showing& showing, std::span<BakedPage> pages);

/// What is seen, times the exposure, in 8-bit sRGB; occlusion, which is in it, goes. `exposure`: a factor; 0:
/// automatic_exposure() of all luxels that are read. Returns it.
float encode_pages(std::span<BakedPage> pages, float exposure);

}  // namespace laterna::bake
