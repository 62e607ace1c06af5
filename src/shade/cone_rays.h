// In which directions a rough mirror is looked at.
#pragma once

#include <array>
#include <glm/vec2.hpp>

#include "base/sample_sequence.h"

namespace laterna::shade {

inline constexpr int kConeRays = 48;
/// Places of the unit disc, the cone's section, of which each stands for the same share.
using ConeRays = std::array<glm::vec2, kConeRays>;

/// They fill the disc evenly: Vogel 1979, A better way to construct the sunflower head. Those of the pictures of a mean
/// are turned against each other and lie on other circles, so that what one leaves out the next one sees.
ConeRays cone_rays(SampleIndex sample);

}  // namespace laterna::shade
