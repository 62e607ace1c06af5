// How surfaces answer light, and how attributes vary over a triangle.
#pragma once

#include <cstdint>

namespace laterna {

enum class ShadingModel : std::uint8_t {
  papers,  ///< base colour · (ambient + Σ slide · α): no n·l, no distance (Segal et al. 1992, section 3.1)
  phong,  ///< base colour · E (n·l) + k_s E (n·h)^p: Lambert and Blinn-Phong
  pbr,    ///< glTF 2.0 metallic-roughness: GGX, Smith, Schlick
};

enum class Interpolation : std::uint8_t {
  perspective,  ///< as attributes vary on the surface: equations 3 to 8 of Segal et al. 1992
  affine,       ///< linearly in the picture: deliberately wrong, to show "texture swimming"
};

enum class Passes : std::uint8_t {
  single,  ///< every visible sample shaded once, all lights together
  multi,  ///< the papers' frame-buffer algorithms, literally: the scene drawn again for each pass of each light
};

}  // namespace laterna
