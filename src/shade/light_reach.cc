#include "shade/light_reach.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace laterna::shade {
namespace {

// What rounding of positions and planes may amount to, as a share of the distances at work.
constexpr float kSlack = 1e-5F;

}  // namespace

LightReach::LightReach(const frame::PlacedLight& placed, ShadingModel model)
    : position_ws_(placed.pose.position_ws), range_squared_(std::numeric_limits<float>::infinity()) {
  const Light& light = *placed.light;
  if (light.attenuation == Attenuation::gltf_windowed && model != ShadingModel::papers &&
      light.type != LightType::directional && !placed.view.projection.is_orthographic) {
    const auto range = static_cast<float>(light.range);
    range_squared_ = range * range;
  }
  if (light.type != LightType::projector) return;
  // Slide coordinates x/w and y/w lie in [0, 1] where the light shines.
  const glm::dmat4 rows = glm::transpose(placed.view.image_from_world());
  // Out of focus, light falls beside the frame too: how far is left to the samples to find out.
  if (light.outside == Outside::black && light.aperture.radius == 0) {
    for (const int axis : {0, 1}) {
      add_halfspace(rows[axis]);
      add_halfspace(rows[3] - rows[axis]);
    }
  }
  if (!placed.view.projection.is_orthographic) add_halfspace(rows[3]);
}

void LightReach::add_halfspace(const glm::dvec4& plane) {
  const double length = glm::length(glm::dvec3(plane));
  if (length > 0) halfspaces_[static_cast<std::size_t>(halfspace_count_++)] = glm::vec4(plane / length);
}

bool LightReach::touches(const frame::Bounds& box) const {
  const glm::vec3 farthest = glm::max(glm::abs(box.low), glm::abs(box.high));
  const float size = std::max({farthest.x, farthest.y, farthest.z});
  for (int i = 0; i < halfspace_count_; ++i) {
    const glm::vec4& plane = halfspaces_[static_cast<std::size_t>(i)];
    float highest = plane.w;
    for (int axis = 0; axis < 3; ++axis)
      highest += plane[axis] * (plane[axis] > 0 ? box.high : box.low)[axis];
    if (highest < -kSlack * (4 * size + std::abs(plane.w))) return false;
  }
  const glm::vec3 nearest = glm::clamp(position_ws_, box.low, box.high) - position_ws_;
  return glm::dot(nearest, nearest) <= range_squared_ * (1 + 4 * kSlack);
}

}  // namespace laterna::shade
