#include "light/photograph_plan.h"

#include <algorithm>
#include <cmath>

namespace laterna::light {
namespace {

constexpr int kMapResolution = 2048;

}  // namespace

PhotographPlan make_photograph_plan(const frame::Frame& frame, ShadowTechnique visibility) {
  PhotographPlan plan;
  for (const frame::PlacedPhotograph& placed : frame.photographs) {
    const Photograph& photograph = *placed.photograph;
    Light& light = plan.lights.emplace_back();
    light.name = photograph.name;
    light.type = LightType::projector;
    light.projection = photograph.projection;
    light.aspect_from_slide = false;
    light.shadow.technique = visibility;
    light.shadow.resolution = kMapResolution;
    frame::PlacedLight& projector = plan.placed.emplace_back();
    projector.light = &light;
    projector.pose = photograph.pose;
    projector.view = {photograph.pose, photograph.projection};
    PlannedLight planned;
    planned.placed = &projector;
    planned.number = static_cast<std::uint32_t>(frame.lights.size() + plan.photographs.size());
    planned.technique = visibility;
    planned.settings = light.shadow;
    plan.photographs.push_back(visibility == ShadowTechnique::map ? with_shadow_map(std::move(planned), frame)
                                                                  : std::move(planned));
  }
  return plan;
}

ShadowView photograph_view(const frame::PlacedPhotograph& placed, int longest_side) {
  const double width = placed.picture->width(), height = placed.picture->height();
  const double scale = std::min(1.0, longest_side / std::max(width, height));
  const auto side = [&](double texels) {
    return std::max(1, static_cast<int>(std::floor(texels * scale + 0.5)));
  };
  return {{placed.photograph->pose, placed.photograph->projection}, side(width), side(height)};
}

}  // namespace laterna::light
