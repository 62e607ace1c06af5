#include "render/idle_projectors.h"

#include <algorithm>

namespace laterna::render {
namespace {

// Whether a box lies wholly beyond one of the sides, the far plane or behind the lens, in clip space (M2, M3).
bool is_outside(const Cluster& box, const glm::dmat4& clip_from_world) {
  unsigned outside_all = ~0U;
  for (unsigned corner = 0; corner < 8; ++corner) {
    glm::dvec4 point(1);
    for (int axis = 0; axis < 3; ++axis) {
      const bool is_high = (corner >> static_cast<unsigned>(axis) & 1U) != 0;
      point[axis] = static_cast<double>(is_high ? box.high_ws[axis] : box.low_ws[axis]);
    }
    const glm::dvec4 clip = clip_from_world * point;
    const bool beyond[] = {clip.x<-clip.w, clip.x> clip.w, clip.y<-clip.w, clip.y> clip.w, clip.z > clip.w,
                           clip.w <= 0};
    unsigned outside = 0;
    for (unsigned plane = 0; plane < 6; ++plane) outside |= beyond[plane] ? 1U << plane : 0U;
    outside_all &= outside;
  }
  return outside_all != 0;
}

}  // namespace

std::vector<std::string> idle_projectors(const frame::Frame& frame) {
  std::vector<std::string> names;
  for (const frame::PlacedLight& placed : frame.lights) {
    const Light& light = *placed.light;
    if (light.type != LightType::projector || light.outside != Outside::black) continue;
    const glm::dmat4 clip_from_world = placed.view.clip_from_world();
    const bool is_idle = std::ranges::all_of(
        frame.clusters, [&](const Cluster& cluster) { return is_outside(cluster, clip_from_world); });
    if (is_idle) names.push_back(light.name);
  }
  return names;
}

}  // namespace laterna::render
