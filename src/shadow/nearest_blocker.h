// How near to a sample a triangle may stand without shadowing it. One rule for all techniques that test triangles.
#pragma once

#include <cstddef>

#include "shadow/surface_samples.h"

namespace laterna::shadow {

/// Metres along the way to the light. The sample's own triangle is left out altogether; its neighbours must not be met at
/// the very start by rounding alone, nor because corners were snapped: at its rim a triangle may have been given samples
/// that lie on its plane a little beside it.
float nearest_blocker(const SurfaceSamples& samples, std::size_t sample);

}  // namespace laterna::shadow
