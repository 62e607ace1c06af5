// Deliberately wrong: slide coordinates iterated linearly over the screen instead of by equation 7.
#pragma once

#include "shade/illumination.h"

namespace laterna::shade {

/// Coordinates of the slide at the corners of each sample's triangle, divided there and interpolated linearly in the
/// picture. Triangles with a corner behind the camera or the lens are left to equation 7 (not `valid`).
void find_affine_slide_coordinates(const BoundLight& light, const PointSource& source,
                                   const shadow::SurfaceSamples& samples, SlideCoordinates& coordinates);

}  // namespace laterna::shade
