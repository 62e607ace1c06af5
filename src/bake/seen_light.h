// Light maps times colours: what any program shows of a surface that shines so.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "bake/baked_pages.h"
#include "bake/luxel_receivers.h"
#include "frame/frame.h"

namespace laterna::bake {

/// What falls on surfaces beside what their pages say, and how it is shown.
struct Showing {
  glm::vec3 ambient{0};     ///< Scene::ambient; held back by pages' occlusion
  double luxel_side = 0.1;  ///< metres: textures are read at the level of such texels
  float exposure = 0;       ///< factor on radiance; 0: automatic_exposure() of all luxels that are read
};

/// Puts in place of irradiance E, in every page, what is seen: reflectance · (E / π + ambient) + what the surface gives off, times
/// the exposure, in 8-bit sRGB. Returns the exposure. `triangles`: of each page.
float make_visible(const frame::Frame& frame, std::span<const std::unique_ptr<PageTriangles>> triangles,
                   const Showing& showing, std::span<BakedPage> pages);

}  // namespace laterna::bake
