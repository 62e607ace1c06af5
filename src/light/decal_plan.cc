#include "light/decal_plan.h"

#include "laterna/technique_choice.h"

namespace laterna::light {
namespace {

constexpr int kMapResolution = 2048;

}  // namespace

std::vector<PlannedLight> make_decal_plan(const frame::Frame& frame, ShadowTechnique of_picture) {
  std::vector<PlannedLight> plan;
  for (const frame::PlacedLight& placed : frame.decals) {
    PlannedLight planned;
    planned.placed = &placed;
    planned.number = static_cast<std::uint32_t>(frame.lights.size() + frame.photographs.size() + plan.size());
    planned.technique = technique_for(*placed.light, of_picture);
    planned.settings = placed.light->shadow;
    if (planned.settings.resolution == 0) planned.settings.resolution = kMapResolution;
    if (planned.technique == ShadowTechnique::map) {
      planned = with_shadow_map(std::move(planned), frame);
    } else if (planned.technique != ShadowTechnique::none &&
               planned.technique != ShadowTechnique::raytraced) {
      planned.technique = ShadowTechnique::exact;
    }
    plan.push_back(std::move(planned));
  }
  return plan;
}

}  // namespace laterna::light
