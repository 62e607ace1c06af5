#include <algorithm>
#include <cmath>
#include <limits>

#include "base/refuse.h"
#include "laterna/measure.h"
#include "measure/depth_ramp.h"

namespace laterna {
namespace measure {

DepthRamp::DepthRamp(std::span<const float> depths) {
  for (const float z : depths) {
    if (!std::isfinite(z)) continue;
    nearest_ = std::min(nearest_, z);
    farthest_ = std::max(farthest_, z);
  }
}

float DepthRamp::grey(float depth) const {
  if (!std::isfinite(depth)) return kNothing;
  if (farthest_ <= nearest_) return kNearest;
  const float t = std::clamp((depth - nearest_) / (farthest_ - nearest_), 0.0F, 1.0F);
  return kNearest + (kFarthest - kNearest) * t;
}

}  // namespace measure

Result<LayeredImage> depth_picture(const LayeredImage& depth) {
  const Channel* z = depth.find("Z");
  if (z == nullptr) return refuse("a depth picture is made from a channel \"Z\"");
  const measure::DepthRamp ramp(z->values);
  LayeredImage picture;
  picture.width = depth.width;
  picture.height = depth.height;
  std::vector<float> grey(z->values.size());
  std::transform(z->values.begin(), z->values.end(), grey.begin(), [&](float d) { return ramp.grey(d); });
  for (const char* name : {"R", "G", "B"}) picture.channels.push_back({name, grey});
  return picture;
}

}  // namespace laterna
