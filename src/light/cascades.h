// Cascades: shadow maps one behind the other along the camera's view, so that texels are fine where the picture is.
// Zhang, Sun, Xu and Lun, Parallel-split shadow maps for large-scale virtual environments, 2006.
#pragma once

#include <algorithm>
#include <vector>

#include "light/light_plan.h"
#include "light/sun_view.h"

namespace laterna::light {

/// The `count` + 1 distances that bound the slices: lambda × logarithmic + (1 − lambda) × uniform, the paper's practical
/// scheme. `near` is greater than 0 unless lambda is 0.
std::vector<double> find_splits(double near, double far, int count, double lambda);

/// The maps of a directional light for a camera, the finest first. Each holds the sphere around its slice of the camera's
/// frustum, which has one size however the camera turns, and lies on a raster of texels that is fixed to the light:
/// while the camera moves, a point of the scene keeps its place in its texel (Valient, Stable rendering of cascaded shadow
/// maps, 2008). What a map would hold beside the casters is cut off, and there are no maps coarser than one of the
/// whole scene. `camera` null: that one.
std::vector<ShadowView> cascade_views(const frame::PlacedLight& placed, const frame::Frame& frame,
                                      const ShadowSettings& settings, const View* camera);

/// Texels along the sides of a cascade that no sample asks for by itself: what a filter reads beyond it.
inline int cascade_rim(int kernel) { return 2 + kernel / 2; }
/// Within these, the band in which the next, coarser cascade takes over little by little, so that no seam is seen: texels.
inline float cascade_band(int width, int height) {
  return std::max(4.0F, static_cast<float>(std::max(width, height)) / 16);
}

}  // namespace laterna::light
