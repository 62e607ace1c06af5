#include "light/sun_view.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace laterna::light {
namespace {

// A sheet seen edge-on still has a width.
void widen(Range& range, double least) {
  if (range.length() >= least) return;
  const double middle = 0.5 * (range.low + range.high);
  range = {middle - 0.5 * least, middle + 0.5 * least};
}

}  // namespace

LightBox box_of_casters(const Pose& pose, const frame::Frame& frame) {
  LightBox box;
  double farthest = -std::numeric_limits<double>::infinity();
  const glm::dvec3 axes[3] = {pose.right_ws(), pose.up_ws(), pose.forward_ws()};
  Range* ranges[3] = {&box.x, &box.y, &box.depth};
  for (const Cluster& c : frame.clusters) {
    const glm::dvec3 low(c.low_ws[0], c.low_ws[1], c.low_ws[2]);
    const glm::dvec3 high(c.high_ws[0], c.high_ws[1], c.high_ws[2]);
    const glm::dvec3 centre = 0.5 * (low + high) - pose.position_ws;
    double middle[3], reach[3];
    for (int k = 0; k < 3; ++k) {
      middle[k] = glm::dot(axes[k], centre);
      reach[k] = glm::dot(glm::abs(axes[k]), 0.5 * (high - low));
    }
    farthest = std::max(farthest, middle[2] + reach[2]);
    if ((c.flags & kCastsShadow) == 0) continue;
    for (int k = 0; k < 3; ++k) ranges[k]->include(middle[k], reach[k]);
  }
  if (box.x.is_empty()) {
    box = {{-1, 1}, {-1, 1}, {0, 1}};
    farthest = 1;
  }
  const double largest = std::max({box.x.length(), box.y.length(), box.depth.length(), 1e-3});
  widen(box.x, 1e-3 * largest);
  widen(box.y, 1e-3 * largest);
  const double margin = 1e-3 * largest;
  box.depth.high = std::max(box.depth.high, farthest) + margin;
  box.depth.low -= margin;
  return box;
}

ShadowView fit_to_box(const Pose& pose, const LightBox& box, int resolution) {
  const double width = box.x.length();
  const double height = box.y.length();
  const double proportion = std::sqrt(width / height);
  const auto side = [&](double texels) {
    return std::clamp(static_cast<int>(std::ceil(texels)), 16, kMaxShadowResolution);
  };
  ShadowView shadow;
  shadow.width = side(resolution * proportion);
  shadow.height = side(resolution / proportion);
  // Two texels to spare on each side, so that filters at the rim find what is there.
  constexpr int kRim = 2;
  const double texel = std::max(width / (shadow.width - 2 * kRim), height / (shadow.height - 2 * kRim));
  const double x = 0.5 * (box.x.low + box.x.high);
  const double y = 0.5 * (box.y.low + box.y.high);
  shadow.view.pose = pose;
  shadow.view.projection = {true,
                            x - 0.5 * texel * shadow.width,
                            x + 0.5 * texel * shadow.width,
                            y - 0.5 * texel * shadow.height,
                            y + 0.5 * texel * shadow.height,
                            box.depth.low,
                            box.depth.high};
  return shadow;
}

double texel_of(const ShadowView& shadow) {
  const Projection& p = shadow.view.projection;
  return std::max((p.right - p.left) / shadow.width, (p.top - p.bottom) / shadow.height);
}

}  // namespace laterna::light
