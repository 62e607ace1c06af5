// Texture look-ups as OpenGL 4.6, section 8.14, and EXT_texture_filter_anisotropic define them: one sample at
// a time, in double, with integer texel indices.
#pragma once

#include <array>

#include "image/mip_chain.h"
#include "laterna/sampler.h"

namespace laterna::reference {

/// Coordinates and their change from one pixel to the next.
struct TextureProbe {
  double u = 0, v = 0, du_dx = 0, dv_dx = 0, du_dy = 0, dv_dy = 0;
};

struct TextureSample {
  std::array<double, 4> rgba;
  /// The choice of a texel, level or number of probes hangs on less than what single precision can tell.
  bool is_ambiguous = false;
};

TextureSample look_up(const image::MipChain& chain, const Sampler& sampler, int anisotropy,
                      const TextureProbe& probe);

}  // namespace laterna::reference
