// The orthographic view of a directional light: as wide as what casts shadows, as deep as what receives them.
#pragma once

#include <limits>

#include "light/light_plan.h"

namespace laterna::light {

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void include(double centre, double reach) {
    low = std::min(low, centre - reach);
    high = std::max(high, centre + reach);
  }
  [[nodiscard]] bool is_empty() const { return low > high; }
  [[nodiscard]] double length() const { return high - low; }
};

/// A box along the axes of a light, in metres from its position.
struct LightBox {
  Range x, y, depth;
};

/// The smallest box around all that casts, and as deep as anything receives. What lies beside it is lit, so receivers
/// do not count for its width. A margin of depth is added.
LightBox box_of_casters(const Pose& pose, const frame::Frame& frame);

/// A map of about `resolution`² square texels on the box: its sides are shared out by the box's proportions.
ShadowView fit_to_box(const Pose& pose, const LightBox& box, int resolution);

/// The width of that map's texels.
double texel_of(const ShadowView& shadow);

}  // namespace laterna::light
