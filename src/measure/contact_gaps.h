// Light where a caster touches its receiver: shadows that come off their objects.
#pragma once

#include "measure/lit_pixels.h"

namespace laterna::measure {

/// The largest distance, in texels, from the nearest place where two surfaces touch at an angle, one of them darkening the
/// other, over falsely lit pixels without a break. Where the picture does not show what touches, a caster closer than a texel
/// and a pixel is as good. Pixels within kEdgeTexels of where a true shadow ends do not count: there every map is a little
/// off, touching or not. So shadows narrower than twice that are not looked at.
double largest_contact_gap(const LitPixels& pixels, const Mask& truth, const Mask& mask);
inline constexpr double kEdgeTexels = 1.5;

}  // namespace laterna::measure
