// Environments as the glTF extension EXT_lights_image_based holds them: filtered already, for every roughness.
#pragma once

#include "laterna/render.h"

namespace laterna {

struct ImageBasedLightSettings {
  /// Side of the faces for roughness 0, a power of two from 32 to 4096. Each rougher level halves it, down to 16 for
  /// roughness 1.
  int face_size = 256;
};

/// Puts six faces for each of several roughnesses (Environment::specular_pictures) and nine harmonics of irradiance in the
/// place of the environment's picture: what write_scene() can carry, and what other programs read. Faces are PNG's 8 bits
/// with alpha as divisor (RGBD): light up to 255 times white, in steps of at most 1/128 of the brightest channel; what is brighter
/// is held there. What surfaces show of it changes by no more than these steps and the faces' texels.
/// Nothing is done where there is no environment, or where it is filtered already.
/// `options`: threads, instruction set, and where filtered environments are kept. Errors: the picture cannot be read or has
/// not the shape of its chart; bad_usage for another size.
Result<void> filter_environment(Scene& scene, const ImageBasedLightSettings& settings = {},
                                const RendererOptions& options = {});

}  // namespace laterna
