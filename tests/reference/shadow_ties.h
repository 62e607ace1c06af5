// Whether two techniques may differ at a pixel: because an edge of a shadow passes within a hair's breadth of its sample.
// Every triangle is tested in double precision, one after the other.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "reference/shapes.h"

namespace laterna::reference {

/// Pixels of two pictures of one scene at which a light's visibility differs.
struct ShadowMismatches {
  std::vector<glm::ivec2> pixels;
  std::size_t dark = 0;  ///< in the first picture, to see that there are shadows at all
  std::size_t seen = 0;  ///< pixels that show something
  /// Of `pixels`, those around which nothing changes within kTiePixels: true mistakes.
  std::vector<glm::ivec2> mistakes;
};
inline constexpr double kTiePixels = 1.0 / 128;

/// The scene's only light, drawn with both techniques, one sample per pixel.
ShadowMismatches compare_techniques(const Scene& scene, const View& camera, RenderSettings settings,
                                    ShadowTechnique technique, ShadowTechnique truth);

/// For messages.
std::string to_string(const ShadowMismatches& mismatches);

}  // namespace laterna::reference
